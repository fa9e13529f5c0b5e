// Distributes the area of a surface over its points, as weights of norms.
#ifndef GridFEM_Testing_PointAreas_h
#define GridFEM_Testing_PointAreas_h

#include "Grid/TriangleArea.h"

namespace gridfem::testing
{

/// Returns the part of the area that belongs to each point.
inline Eigen::VectorXd AreasOfPoints(const TriangleMesh& mesh)
{
  Eigen::VectorXd area = Eigen::VectorXd::Zero(static_cast<Id>(mesh.points.size()));
  for (const auto& corner : mesh.triangles)
  {
    for (const Id point : corner)
    {
      area[point] += AreaVector(mesh.points, corner).norm() / 6.0;
    }
  }
  return area;
}

} // namespace gridfem::testing

#endif
