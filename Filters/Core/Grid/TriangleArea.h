// Area and orientation of a triangle.
#ifndef GridFEM_TriangleArea_h
#define GridFEM_TriangleArea_h

#include "Grid/TriangleMesh.h"

namespace gridfem
{

/// Returns the normal vector whose length is twice the area.
inline Vec3 AreaVector(const std::vector<Vec3>& points, const std::array<Id, 3>& corner)
{
  return (points[corner[1]] - points[corner[0]]).cross(points[corner[2]] - points[corner[0]]);
}

inline double AreaOf(const TriangleMesh& mesh, Id triangle)
{
  return 0.5 * AreaVector(mesh.points, mesh.triangles[triangle]).norm();
}

} // namespace gridfem

#endif
