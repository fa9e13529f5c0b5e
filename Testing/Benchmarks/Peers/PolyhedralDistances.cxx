#include "PolyhedralDistances.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <limits>
#include <numeric>

namespace gridfem::benchmarks
{

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Paths =
  CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Surface>>;

} // namespace

std::vector<double> PolyhedralDistances(
  const TriangleMesh& mesh, Id source, const std::vector<Id>& targets)
{
  Surface surface;
  std::vector<Surface::Vertex_index> vertex;
  for (const Vec3& point : mesh.points)
  {
    vertex.push_back(surface.add_vertex({ point[0], point[1], point[2] }));
  }
  for (const auto& corner : mesh.triangles)
  {
    if (surface.add_face(vertex[corner[0]], vertex[corner[1]], vertex[corner[2]]) ==
        Surface::null_face())
    {
      return {};
    }
  }
  Paths paths(surface);
  paths.add_source_point(vertex[source]);
  std::vector<double> distance;
  for (const Id target : targets)
  {
    const double found = paths.shortest_distance_to_source_points(vertex[target]).first;
    distance.push_back(found < 0.0 ? std::numeric_limits<double>::infinity() : found);
  }
  return distance;
}

std::vector<double> PolyhedralDistances(const TriangleMesh& mesh, Id source)
{
  std::vector<Id> all(mesh.points.size());
  std::iota(all.begin(), all.end(), Id(0));
  return PolyhedralDistances(mesh, source, all);
}

} // namespace gridfem::benchmarks
