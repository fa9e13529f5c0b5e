// A metric on the surface, given as an array of tensors.
#ifndef GridFEM_MetricArray_h
#define GridFEM_MetricArray_h

#include "InputArray.h"

#include "Integrals/TriangleMetric.h"

namespace gridfem
{

/// Tensors of six components (XX, YY, ZZ, XY, YZ, XZ) or nine (row by row) at points or cells; of
/// those at points the means over the triangles count. Throws InvalidInput for another number of
/// components, and naming the first point or cell of the surface whose tensor is not finite, not
/// symmetric, or not positive definite in the planes of its triangles (PlaneTensor::IsMetric).
TriangleMetric ReadMetric(const InputArray& input, const InputMesh& mesh);

} // namespace gridfem

#endif
