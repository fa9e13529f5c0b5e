// A boundary that stays in place while the surface moves by its mean curvature.
#ifndef GridFEM_HeldBoundary_h
#define GridFEM_HeldBoundary_h

#include "Equations/RowPenalty.h"
#include "Spaces/FiniteElementSpace.h"

#include <vector>

namespace gridfem
{

/// Terms of a step (M + δL) X⁺ = M X of the flow that keep edges at X₀, after Nitsche: δ ∮ (β (X⁺ -
/// X₀) - ν) b. The outward conormal ν of the current surface is the derivative of its embedding
/// there, so a surface at rest lies on its boundary for any β.
/// Values on a grid that were held exactly along a curve would also be held next to it, because a
/// function has no freedom to bend there.
class HeldBoundary
{
public:
  /// @param mesh      the mesh that the space was made from
  /// @param edges     edges of the mesh
  /// @param timeStep  δ, squared units of length of the space
  HeldBoundary(const FiniteElementSpace& space, const TriangleMesh& mesh,
    std::vector<TriangleEdge> edges, double timeStep, int threads);

  /// The penalty δβ ∮ u b.
  const RowPenalty& Penalty() const { return penalty_; }

  /// The load δ ∮ (β (X₀ - shift) + ν) b: rows = functions, three columns.
  /// @param points  current points of the mesh, world units, for ν
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
