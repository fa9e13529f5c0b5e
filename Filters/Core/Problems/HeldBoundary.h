// A boundary that stays where it is while the surface moves by its mean curvature.
#ifndef GridFEM_HeldBoundary_h
#define GridFEM_HeldBoundary_h

#include "Problems/RowPenalty.h"
#include "Spaces/FiniteElementSpace.h"

#include <vector>

namespace gridfem
{

/// What edges that stay at X₀ add to a step (M + δL) X⁺ = M X of the flow, after Nitsche:
/// δ ∮ (β (X⁺ - X₀) - ν) b, with the outward conormal ν of the surface as it is, which is the
/// derivative of its embedding there. So a surface that has come to rest lies on its boundary
/// whatever β is. Values on a grid that were held exactly along a curve would be held beside it,
/// too: a function there has no freedom to bend.
class HeldBoundary
{
public:
  /// @param mesh      what the space was made from
  /// @param edges     of the mesh
  /// @param timeStep  δ, squared units of length of the space
  HeldBoundary(const FiniteElementSpace& space, const TriangleMesh& mesh,
    std::vector<TriangleEdge> edges, double timeStep, int threads);

  /// δβ ∮ u b
  const RowPenalty& Penalty() const { return penalty_; }

  /// δ ∮ (β (X₀ - shift) + ν) b: rows = functions, three columns.
  /// @param points  of the mesh as they are, world units, for ν
  /// @param shift   coefficients of functions that are taken out of X: functions x 3
  MultiVector Load(const std::vector<Vec3>& points, const std::vector<std::array<Id, 3>>& triangles,
    const MultiVector& shift, int threads) const;

private:
  std::vector<TriangleEdge> edges_;
  std::vector<Index> edgeOfRow_;
  MultiVector place_; // X₀ of each row, in units of length from the origin
  RowPenalty penalty_;
};

} // namespace gridfem

#endif
