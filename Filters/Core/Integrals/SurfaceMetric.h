// Integrals in another metric than that of the mesh, on the same clipped triangles: a surface that
// moves is tracked without clipping it again. [T §5.1, (5.5), (5.6)]
#ifndef GridFEM_SurfaceMetric_h
#define GridFEM_SurfaceMetric_h

#include "Base/Job.h"
#include "Integrals/ElementMatrices.h"

namespace gridfem
{

/// A metric at one sample: the first fundamental form in an orthonormal basis of the plane of the
/// sample's triangle (see TangentBasis). (1, 0, 1) is the metric of the mesh itself.
struct FundamentalForm
{
  double E;
  double F;
  double G;
};

/// One per sample, numbered as in PieceSamples.h. 24 bytes a sample: what a metric depends on (25
/// numbers in the thesis) is computed again from the triangles, which is faster than to read it.
using SampleMetric = Array<FundamentalForm>;

/// The metric of an embedding whose coordinates are grid functions: g = dXᵀ dX. [T (5.5)]
/// @param embedding  functions x 3 coefficients, grid units. Throws InvalidInput for another shape.
SampleMetric MetricOfEmbedding(const GridFunctions& space, const QuadratureRule& rule,
  const MultiVector& embedding, const Job& job = {});

/// The metric of the mesh with moved points: on every triangle that of the linear map to where it
/// has gone. Throws InvalidInput when the meshes differ in more than positions; 0 on source
/// triangles without an area.
SampleMetric MetricOfMesh(const GridFunctions& space, const QuadratureRule& rule,
  const TriangleMesh& mesh, const TriangleMesh& moved, const Job& job = {});

/// Element matrices in a metric: mass b_i b_j √|g|, stiffness <∇b_i, g⁻¹ ∇b_j> √|g|. [T (5.6)]
/// The normal derivative is that of the mesh, integrated over the mesh, whatever the metric: it is
/// there to make functions known and does not scale, as the stiffness of a scaled surface does not.
/// Cost and determinism as IntegrateElements. Throws InvalidInput when there is not one metric per
/// sample of the rule.
/// @param result  for UpdateOperators: the finest element matrices of a system, in place
/// @return  number of samples on triangles with an area whose metric is not positive definite, not
///          finite, or stretches one direction 1e7 times as much as the other, or whose determinant
///          is not between 1e-300 and 1e300: they contribute nothing
Id IntegrateElements(const GridFunctions& space, const QuadratureRule& rule,
  const SampleMetric& metric, ElementMatrices& result, const Job& job = {},
  double normalStabilization = DefaultNormalStabilization, ElementParts parts = ElementParts::Both);

} // namespace gridfem

#endif
