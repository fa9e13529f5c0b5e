// Element matrices split by direction, so that weights for each patch and direction change the
// system without a look at the triangles. [T §5.2, anisotropy]
#ifndef GridFEM_DirectionalElements_h
#define GridFEM_DirectionalElements_h

#include "Base/Job.h"
#include "Integrals/ElementMatrices.h"

namespace gridfem
{

/// The two parts add up to the stiffness of IntegrateElements. Each has half of the weight of the
/// normal derivative: with weights w it counts s (w_0 + w_1) / 2.
struct DirectionalElements
{
  Array<ElementMatrix> mass;
  std::array<Array<ElementMatrix>, 2> stiffness; // ∫ <∇b_i, d> <∇b_j, d>; along and across
};

/// The weights of a patch. In the metric diag(α₁², α₂²): { α₁ α₂, { α₂ / α₁, α₁ / α₂ } }.
struct ElementWeights
{
  double mass = 1.0;
  std::array<double, 2> stiffness = { 1.0, 1.0 };
};

/// @param direction  the first direction on each source triangle; its part in the triangle's plane
///                   counts, its length does not. The second is across it. Where nothing is left
///                   both parts are half of the stiffness.
/// Throws InvalidInput when there are fewer directions than source triangles. Cost and determinism
/// as IntegrateElements.
DirectionalElements IntegrateElements(const GridFunctions& space, const QuadratureRule& rule,
  const std::vector<Vec3>& direction, const Job& job = {},
  double normalStabilization = DefaultNormalStabilization);

/// The element matrices with these weights, one per patch. Throws InvalidInput when the numbers
/// differ or a weight is negative, infinite or not a number.
/// @param result  for UpdateOperators: the finest element matrices of a system, in place
void Weigh(const DirectionalElements& elements, const std::vector<ElementWeights>& weights,
  ElementMatrices& result, int threads = 0);

} // namespace gridfem

#endif
