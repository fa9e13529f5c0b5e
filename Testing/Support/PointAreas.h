// The surface shared out among its points: weights of norms.
#ifndef GridFEM_Testing_PointAreas_h
#define GridFEM_Testing_PointAreas_h

#include "Grid/TriangleArea.h"

namespace gridfem::testing
{

/// Parts of the area that belong to the points.
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
