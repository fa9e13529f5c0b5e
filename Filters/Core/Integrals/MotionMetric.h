// Tracks a moving surface on the functions of its first shape. It computes the metric of the moved
// mesh on the original triangles, and maps vectors between the two meshes. [T §5.1, (5.5)]
#ifndef GridFEM_MotionMetric_h
#define GridFEM_MotionMetric_h

#include "Integrals/TriangleMetric.h"

#include <optional>

namespace gridfem
{

/// Returns g = JᵀJ for the linear map J of every triangle to its moved triangle. Returns nothing if
/// some g is no metric (PlaneTensor::IsMetric), because a triangle lost or gained area or a point
/// is not finite. Throws InvalidInput when the meshes do not have the same triangles. Cost
/// O(triangles).
std::optional<TriangleMetric> MetricOfMotion(const TriangleMesh& mesh, const TriangleMesh& moved);

/// Returns Jᵀ s: vectors of the moved surface as linear forms on the mesh, as TriangleMetric
/// expects them.
/// @param s  on the moved mesh, 3 C columns
/// @return   on triangles, or on corners if s is on points
Field PullBack(const TriangleMesh& mesh, const TriangleMesh& moved, const Field& s);

} // namespace gridfem

#endif
