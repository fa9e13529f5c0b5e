// A triangle mesh as CGAL's surface, for its distances.
#ifndef GridFEM_Benchmarks_CgalSurface_h
#define GridFEM_Benchmarks_CgalSurface_h

#include "Grid/TriangleMesh.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <vector>

namespace gridfem::benchmarks
{

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalSurface = CGAL::Surface_mesh<CgalKernel::Point_3>;

/// Fills an empty surface.
/// @return  the vertices of the mesh's points; empty if the mesh is no manifold
inline std::vector<CgalSurface::Vertex_index> FillSurface(
  const TriangleMesh& mesh, CgalSurface& surface)
{
  std::vector<CgalSurface::Vertex_index> vertex;
  for (const Vec3& point : mesh.points)
  {
    vertex.push_back(surface.add_vertex({ point[0], point[1], point[2] }));
  }
  for (const auto& corner : mesh.triangles)
  {
    if (surface.add_face(vertex[corner[0]], vertex[corner[1]], vertex[corner[2]]) ==
        CgalSurface::null_face())
    {
      return {};
    }
  }
  return vertex;
}

} // namespace gridfem::benchmarks

#endif
