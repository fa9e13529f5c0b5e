// The metric of a mesh whose points have moved, on the triangles of the mesh as it was, and what
// the motion makes of vectors: so a surface that moves is tracked on the functions of its first
// shape. [T §5.1, (5.5)]
#ifndef GridFEM_MotionMetric_h
#define GridFEM_MotionMetric_h

#include "Integrals/TriangleMetric.h"

#include <optional>

namespace gridfem
{

/// g = JᵀJ of the linear map J of every triangle to where it has gone. Nothing where that is no
/// metric (PlaneTensor::IsMetric): where a triangle has lost its area, gained one, or a point is
/// not finite. Throws InvalidInput when the meshes have not the same triangles. Cost O(triangles).
std::optional<TriangleMetric> MetricOfMotion(const TriangleMesh& mesh, const TriangleMesh& moved);

/// Jᵀ s: vectors of the moved surface as linear forms on the mesh, as TriangleMetric wants them.
/// @param s  on the moved mesh, 3 C columns
/// @return   on triangles, or on corners where s is on points
Field PullBack(const TriangleMesh& mesh, const TriangleMesh& moved, const Field& s);

} // namespace gridfem

#endif
