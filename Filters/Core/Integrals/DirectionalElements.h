// Element matrices split by direction. Weights for each patch and direction can then change the
// system without another pass over the triangles. [T §5.2, anisotropy]
#ifndef GridFEM_DirectionalElements_h
#define GridFEM_DirectionalElements_h

#include "Base/Job.h"
#include "Integrals/ElementMatrices.h"

namespace gridfem
{

/// The two stiffness parts add up to the stiffness of IntegrateElements. Each contains half of the
/// normal derivative's weight s. With weights w, the normal derivative therefore counts
/// s (w_0 + w_1) / 2.
struct DirectionalElements
{
  Array<ElementMatrix> mass;
  std::array<Array<ElementMatrix>, 2> stiffness; // ∫ <∇b_i, d> <∇b_j, d> for d along and across the
                                                 // direction
};

/// The weights of a patch. For the metric diag(α₁², α₂²) they are { α₁ α₂, { α₂ / α₁, α₁ / α₂ } }.
struct ElementWeights
{
  double mass = 1.0;
  std::array<double, 2> stiffness = { 1.0, 1.0 };
};

/// Integrates the element matrices of both directions. Cost and determinism are the same as for
/// IntegrateElements. Throws InvalidInput when there are fewer directions than source triangles.
/// @param direction  the first direction on each source triangle. Only its part in the triangle's
///   plane counts, not its length; the second direction is perpendicular. Without such a part, each
///   stiffness is half of the whole
DirectionalElements IntegrateElements(const GridFunctions& space, const QuadratureRule& rule,
  const std::vector<Vec3>& direction, const Job& job = {},
  double normalStabilization = DefaultNormalStabilization);

/// Computes the element matrices with these weights, one per patch. Throws InvalidInput when the
/// numbers of items differ, or when a weight is negative, infinite or NaN.
/// @param result  updated in place: the finest element matrices of a system, for UpdateOperators
void Weigh(const DirectionalElements& elements, const std::vector<ElementWeights>& weights,
  ElementMatrices& result, int threads = 0);

} // namespace gridfem

#endif
