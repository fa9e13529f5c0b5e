#include "Distance/StarRoute.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <unordered_map>
#include <utility>

namespace gridfem
{
namespace
{

/// An edge that a way around a place has reached.
struct ReachedSpoke
{
  double angle;
  Index triangle; // crossed last
  Index from;     // the edge before it; None: the way starts here
};

using ReachedSpokes = std::unordered_map<Index, ReachedSpoke>;
using WaitingSpoke = std::pair<double, Index>;
using SpokeQueue =
  std::priority_queue<WaitingSpoke, std::vector<WaitingSpoke>, std::greater<WaitingSpoke>>;

/// The other edge of a triangle that ends at a place.
Index OtherSpoke(const PathGraph& graph, Index triangle, Index place, Index edge)
{
  const std::array<Index, 3> corner = graph.CornersOf(triangle);
  const int k = corner[0] == place ? 0 : corner[1] == place ? 1 : 2;
  const auto& ofTriangle = graph.Edges().EdgesOf(triangle);
  return ofTriangle[k] == edge ? ofTriangle[(k + 2) % 3] : ofTriangle[k];
}

void AddRouteTo(Index edge, const ReachedSpokes& reached, StarRoute& route)
{
  for (Index spoke = edge; spoke != EdgeGraph::None;)
  {
    const ReachedSpoke& at = reached.at(spoke);
    route.edges.push_back(spoke);
    if (at.from != EdgeGraph::None)
    {
      route.triangles.push_back(at.triangle);
    }
    spoke = at.from;
  }
  std::reverse(route.edges.begin(), route.edges.end());
  std::reverse(route.triangles.begin(), route.triangles.end());
}

} // namespace

StarDirection DirectionToward(
  const PathGraph& graph, Index triangle, Index place, const Vec3& point)
{
  const std::array<Index, 3> corner = graph.CornersOf(triangle);
  const int k = corner[0] == place ? 0 : corner[1] == place ? 1 : 2;
  const auto& edges = graph.Edges().EdgesOf(triangle);
  const Vec3 direction = point - graph.At(place);
  const auto angleTo = [&](Index end)
  {
    const Vec3 along = graph.At(end) - graph.At(place);
    return std::atan2(direction.cross(along).norm(), direction.dot(along));
  };
  return { triangle, { { { edges[k], angleTo(corner[(k + 1) % 3]) },
                       { edges[(k + 2) % 3], angleTo(corner[(k + 2) % 3]) } } } };
}

StarRoute RouteAround(const PathGraph& graph, Index place, const StarDirection& from,
  const StarDirection& to, double below)
{
  StarRoute route;
  if (from.triangle == to.triangle)
  {
    return route;
  }
  ReachedSpokes reached;
  SpokeQueue queue;
  const auto reach = [&](Index edge, double angle, Index triangle, Index before)
  {
    const auto [at, isNew] = reached.try_emplace(edge, ReachedSpoke{ angle, triangle, before });
    if (isNew || angle < at->second.angle)
    {
      at->second = { angle, triangle, before };
      queue.emplace(angle, edge);
    }
  };
  for (const StarDirection::Spoke& spoke : from.spokes)
  {
    reach(spoke.edge, spoke.angle, from.triangle, EdgeGraph::None);
  }
  Index last = EdgeGraph::None;
  while (!queue.empty() && queue.top().first < std::min(below, route.angle))
  {
    const double angle = queue.top().first;
    const Index edge = queue.top().second;
    queue.pop();
    if (angle > reached.at(edge).angle)
    {
      continue;
    }
    for (const StarDirection::Spoke& spoke : to.spokes)
    {
      if (spoke.edge == edge && angle + spoke.angle < route.angle)
      {
        route.angle = angle + spoke.angle;
        last = edge;
      }
    }
    graph.Edges().ForSides(edge,
      [&](Index, Id side)
      {
        const auto triangle = static_cast<Index>(side);
        if (triangle != from.triangle && triangle != to.triangle)
        {
          reach(OtherSpoke(graph, triangle, place, edge), angle + graph.AngleAt(triangle, place),
            triangle, edge);
        }
      });
  }
  AddRouteTo(last, reached, route);
  return route;
}

} // namespace gridfem
