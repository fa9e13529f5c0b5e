#include "PolyhedralDistances.h"

#include "CgalSurface.h"

#include <CGAL/Surface_mesh_shortest_path.h>

#include <limits>
#include <numeric>

namespace gridfem::benchmarks
{

namespace
{

using Paths = CGAL::Surface_mesh_shortest_path<
  CGAL::Surface_mesh_shortest_path_traits<CgalKernel, CgalSurface>>;

} // namespace

std::vector<double> PolyhedralDistances(
  const TriangleMesh& mesh, Id source, const std::vector<Id>& targets)
{
  CgalSurface surface;
  const std::vector<CgalSurface::Vertex_index> vertex = FillSurface(mesh, surface);
  if (vertex.empty())
  {
    return {};
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
