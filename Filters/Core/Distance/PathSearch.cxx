#include "Distance/PathSearch.h"

#include "Base/SortEachOnce.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace gridfem
{

PathSearch::PathSearch(const PathGraph& graph) : graph_(graph)
{
}

Vec3 PathSearch::At(Node node) const
{
  const Id places = graph_.NumberOfPlaces();
  if (node < places)
  {
    return graph_.At(static_cast<Index>(node));
  }
  const auto edge = static_cast<Index>(node - places);
  return 0.5 * (graph_.At(graph_.Edges().Low(edge)) + graph_.At(graph_.Edges().High(edge)));
}

void PathSearch::Reach(Node node, Node from, double length)
{
  if (!isDone_[node] && length < length_[node])
  {
    length_[node] = length;
    from_[node] = from;
    const double rest = goal_ ? (this->At(node) - *goal_).norm() : 0.0;
    queue_.emplace_back(length + rest, node);
    std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
  }
}

void PathSearch::ReachAround(Node node)
{
  const Id places = graph_.NumberOfPlaces();
  const Vec3 at = this->At(node);
  const auto reach = [&](Node next)
  { this->Reach(next, node, length_[node] + (this->At(next) - at).norm()); };
  if (node < places)
  {
    const auto place = static_cast<Index>(node);
    graph_.ForTrianglesAt(place,
      [&](Index triangle)
      {
        const std::array<Index, 3> corner = graph_.CornersOf(triangle);
        const int k = corner[0] == place ? 0 : corner[1] == place ? 1 : 2;
        reach(corner[(k + 1) % 3]);
        reach(corner[(k + 2) % 3]);
        reach(places + graph_.Edges().EdgesOf(triangle)[(k + 1) % 3]);
      });
    return;
  }
  const auto edge = static_cast<Index>(node - places);
  graph_.Edges().ForSides(edge,
    [&](Index, Id triangle)
    {
      reach(graph_.ApexOf(static_cast<Index>(triangle), edge));
      for (const Index other : graph_.Edges().EdgesOf(triangle))
      {
        reach(places + other); // the edge itself is done
      }
    });
}

void PathSearch::From(
  const std::vector<Index>& sources, const std::vector<Index>& targets, const Job& job)
{
  const auto nodes = static_cast<std::size_t>(graph_.NumberOfPlaces() + graph_.Edges().Count());
  length_.assign(nodes, std::numeric_limits<double>::infinity());
  from_.assign(nodes, -1);
  isDone_.assign(nodes, 0);
  queue_.clear();
  goal_ = targets.size() == 1 ? &graph_.At(targets.front()) : nullptr;
  std::vector<Index> wanted = targets;
  SortEachOnce(wanted);
  std::size_t missing = targets.empty() ? nodes : wanted.size();
  for (const Index source : sources)
  {
    this->Reach(source, -1, 0.0);
  }
  for (std::size_t done = 0; !queue_.empty() && missing > 0;)
  {
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
    const Node node = queue_.back().second;
    queue_.pop_back();
    if (isDone_[node])
    {
      continue;
    }
    isDone_[node] = 1;
    if (++done % 65536 == 0)
    {
      job.Check(static_cast<double>(done) / static_cast<double>(nodes));
    }
    if (node < graph_.NumberOfPlaces() &&
        std::binary_search(wanted.begin(), wanted.end(), static_cast<Index>(node)))
    {
      --missing;
    }
    this->ReachAround(node);
  }
  job.Check(1.0);
}

std::vector<PathSearch::Node> PathSearch::WayTo(Index place) const
{
  std::vector<Node> way;
  if (isDone_[place])
  {
    for (Node node = place; node >= 0; node = from_[node])
    {
      way.push_back(node);
    }
    std::reverse(way.begin(), way.end());
  }
  return way;
}

Index PathSearch::Farthest() const
{
  constexpr double Rounding = 1e-9;
  double largest = 0.0;
  const Id places = graph_.NumberOfPlaces();
  for (Id place = 0; place < places; ++place)
  {
    largest = isDone_[place] ? std::fmax(largest, length_[place]) : largest;
  }
  Index farthest = 0;
  while (!isDone_[farthest] || length_[farthest] < (1.0 - Rounding) * largest)
  {
    ++farthest;
  }
  return farthest;
}

} // namespace gridfem
