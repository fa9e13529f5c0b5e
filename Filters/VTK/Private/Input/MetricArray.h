// Reads a metric on the surface from an array of tensors.
#ifndef GridFEM_MetricArray_h
#define GridFEM_MetricArray_h

#include "Input/InputArray.h"

#include "Integrals/TriangleMetric.h"

namespace gridfem
{

/// Reads tensors of six components (XX, YY, ZZ, XY, YZ, XZ) or nine (row by row) at points or
/// cells. A triangle takes the mean of tensors at points. Throws InvalidInput for another number of
/// components. A tensor must be finite, symmetric, and positive definite in the planes of its
/// triangles (PlaneTensor::IsMetric). Otherwise InvalidInput names the first such point or cell of
/// the surface.
TriangleMetric ReadMetric(const InputArray& input, const InputMesh& mesh);

} // namespace gridfem

#endif
