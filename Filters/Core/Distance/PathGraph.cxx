#include "Distance/PathGraph.h"

#include <cmath>
#include <numeric>
#include <utility>

namespace gridfem
{
namespace
{

Array<Index> PlacesForPaths(const TriangleMesh& mesh, bool weld, int threads)
{
  if (weld)
  {
    return WeldCoincidentPoints(mesh.points, UsedPoints(mesh, threads), threads);
  }
  Array<Index> place(mesh.points.size());
  std::iota(place.begin(), place.end(), Index{ 0 });
  return place;
}

Groups CornersByPlace(const TriangleMesh& mesh, const Array<Index>& place, int threads)
{
  Array<Index> ofCorner(3 * mesh.triangles.size());
  for (std::size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle)
  {
    for (int k = 0; k < 3; ++k)
    {
      ofCorner[3 * triangle + k] = place[mesh.triangles[triangle][k]];
    }
  }
  return GroupItems(ofCorner, static_cast<Id>(place.size()), threads);
}

} // namespace

PathGraph::PathGraph(
  std::shared_ptr<const TriangleMesh> mesh, bool weldCoincidentPoints, int threads)
  : mesh_(std::move(mesh)), place_(PlacesForPaths(*mesh_, weldCoincidentPoints, threads)),
    edges_(*mesh_, place_), corners_(CornersByPlace(*mesh_, place_, threads))
{
}

std::array<Index, 3> PathGraph::CornersOf(Index triangle) const
{
  const auto& corner = mesh_->triangles[triangle];
  return { place_[corner[0]], place_[corner[1]], place_[corner[2]] };
}

Index PathGraph::ApexOf(Index triangle, Index edge) const
{
  const auto& ofTriangle = edges_.EdgesOf(triangle);
  const std::array<Index, 3> corner = this->CornersOf(triangle);
  return edge == ofTriangle[0] ? corner[2] : edge == ofTriangle[1] ? corner[0] : corner[1];
}

Index PathGraph::EdgeOf(Index triangle, Index a, Index b) const
{
  const std::array<Index, 3> corner = this->CornersOf(triangle);
  const int apex = corner[0] != a && corner[0] != b ? 0 : corner[1] != a && corner[1] != b ? 1 : 2;
  return edges_.EdgesOf(triangle)[(apex + 1) % 3];
}

double PathGraph::AngleAt(Index triangle, Index place) const
{
  const std::array<Index, 3> corner = this->CornersOf(triangle);
  const int k = corner[0] == place ? 0 : corner[1] == place ? 1 : 2;
  const Vec3 a = this->At(corner[(k + 1) % 3]) - this->At(place);
  const Vec3 b = this->At(corner[(k + 2) % 3]) - this->At(place);
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

} // namespace gridfem
