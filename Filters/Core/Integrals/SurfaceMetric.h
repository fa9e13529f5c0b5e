// Integrals in another metric than the metric of the mesh, on the same clipped triangles. A moving
// surface is tracked without clipping it again. [T §5.1, (5.5), (5.6)]
#ifndef GridFEM_SurfaceMetric_h
#define GridFEM_SurfaceMetric_h

#include "Base/Job.h"
#include "Integrals/ElementMatrices.h"

namespace gridfem
{

/// A metric at one sample: the first fundamental form in an orthonormal basis (see TangentBasis) of
/// the plane of the sample's triangle. (1, 0, 1) is the metric of the mesh itself.
struct FundamentalForm
{
  double E;
  double F;
  double G;
};

/// One metric per sample, numbered as in QuadratureSamples.h, with 24 bytes per sample. The 25
/// numbers of the thesis that a metric depends on are computed again from the triangles, which is
/// faster than reading them.
using SampleMetric = Array<FundamentalForm>;

/// Returns the metric of an embedding whose coordinates are grid functions: g = dXᵀ dX. [T (5.5)]
/// Throws InvalidInput for an embedding of another shape.
/// @param embedding  functions x 3 coefficients, grid units
SampleMetric MetricOfEmbedding(const GridFunctions& space, const QuadratureRule& rule,
  const MultiVector& embedding, const Job& job = {});

/// Returns the metric of the mesh with moved points. On each triangle, it is the metric of the
/// linear map to the moved triangle; 0 on source triangles without area. Throws InvalidInput when
/// the meshes differ in more than positions.
SampleMetric MetricOfMesh(const GridFunctions& space, const QuadratureRule& rule,
  const TriangleMesh& mesh, const TriangleMesh& moved, const Job& job = {});

/// Integrates element matrices in a metric: mass b_i b_j √|g|, stiffness <∇b_i, g⁻¹ ∇b_j> √|g|.
/// [T (5.6)] The normal derivative is taken and integrated on the mesh for every metric. It only
/// serves to determine all functions. It does not scale, just like the stiffness of a scaled
/// surface.
/// Cost and determinism are the same as for IntegrateElements. Throws InvalidInput unless there is
/// one metric per sample of the rule.
/// @param result  updated in place: the finest element matrices of a system, for UpdateOperators
/// @return  number of samples on triangles with area that contribute nothing, because their metric
///   is singular. Such a metric is not positive definite, not finite, stretches one direction 1e7
///   times as much as the other, or has a determinant outside 1e-300 .. 1e300
Id IntegrateElements(const GridFunctions& space, const QuadratureRule& rule,
  const SampleMetric& metric, ElementMatrices& result, const Job& job = {},
  double normalStabilization = DefaultNormalStabilization, ElementParts parts = ElementParts::Both);

} // namespace gridfem

#endif
