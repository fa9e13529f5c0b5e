#include "Grid/Seams.h"

#include "Base/Grouping.h"
#include "Base/Parallel.h"
#include "Base/UnionFind.h"
#include "Grid/KeepOdd.h"
#include "Grid/SegmentTree.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{

namespace
{

class SeamFinder
{
public:
  SeamFinder(const std::vector<OpenEdge>& open, const std::vector<double>& shortest,
    double longestSide, int threads);

  Seams Find();

private:
  using Edge = std::array<Index, 2>; // ascending

  void JoinEnds(Seams& seams);
  void ListEdgesOfEnds();
  std::vector<Index> NodesOf(const Edge& edge, const SegmentTree& tree) const;
  bool IsNode(const Edge& edge, Index point, double within) const;
  void DivideEdges(Seams& seams) const;

  const int threads_;
  std::vector<Place> places_; // ascending, each once
  // The rest has a unit of length of its own, so that squares stay in the range of numbers.
  std::vector<Vec3> points_; // of the places
  std::vector<double> tolerance_;
  std::vector<Edge> edges_; // ascending, each once
  Groups edgesOfEnd_; // by the point: 2 e for the first end of edge e, and 2 e + 1 for its second
};

SeamFinder::SeamFinder(const std::vector<OpenEdge>& open, const std::vector<double>& shortest,
  double longestSide, int threads)
  : threads_(threads)
{
  const PlaceNumbers numbers = NumberEnds(open);
  places_ = numbers.Places();
  for (const Place& place : places_)
  {
    points_.emplace_back((PointAt(place) - PointAt(places_[0])) / longestSide);
  }
  for (const double side : shortest)
  {
    tolerance_.push_back(std::min(SeamTolerance, SeamShare * (side / longestSide)));
  }
  for (const OpenEdge& edge : open)
  {
    edges_.push_back({ numbers.Of(edge[0]), numbers.Of(edge[1]) });
  }
}

/// Joins ends that coincide except for rounding, at the lowest of their places.
void SeamFinder::JoinEnds(Seams& seams)
{
  const SegmentTree tree(points_);
  UnionFind sets(static_cast<Id>(points_.size()));
  ParallelRanges(static_cast<Id>(points_.size()), threads_,
    [&](Id begin, Id end)
    {
      for (auto a = static_cast<Index>(begin); a < end; ++a)
      {
        tree.ForEachNear({ points_[a], points_[a] }, tolerance_[a],
          [&](Index b)
          {
            const double within = std::min(tolerance_[a], tolerance_[b]);
            if (a < b && (points_[a] - points_[b]).norm() <= within)
            {
              sets.Unite(a, b);
            }
          });
      }
    });
  for (Index point = 0; point < static_cast<Index>(points_.size()); ++point)
  {
    const Index lowest = sets.Find(point);
    if (lowest != point)
    {
      seams.moves.push_back({ places_[point], places_[lowest] });
      tolerance_[lowest] = std::min(tolerance_[lowest], tolerance_[point]);
    }
  }
  for (Edge& edge : edges_)
  {
    const Index a = sets.Find(edge[0]);
    const Index b = sets.Find(edge[1]);
    edge = { std::min(a, b), std::max(a, b) };
  }
  edges_.erase(std::remove_if(
                 edges_.begin(), edges_.end(), [](const Edge& edge) { return edge[0] == edge[1]; }),
    edges_.end());
  KeepOdd(edges_);
}

void SeamFinder::ListEdgesOfEnds()
{
  Array<Index> end; // two per edge
  end.reserve(2 * edges_.size());
  for (const Edge& edge : edges_)
  {
    end.push_back(edge[0]);
    end.push_back(edge[1]);
  }
  edgesOfEnd_ = GroupItems(end, static_cast<Id>(points_.size()), threads_);
}

/// Whether an edge from a point within `edge` runs along it.
bool SeamFinder::IsNode(const Edge& edge, Index point, double within) const
{
  const Vec3& from = points_[edge[0]];
  const Vec3& to = points_[edge[1]];
  const Vec3& node = points_[point];
  const Vec3 along = (to - from).normalized();
  for (Index k = edgesOfEnd_.begin[point]; k < edgesOfEnd_.begin[point + 1]; ++k)
  {
    const Index end = edgesOfEnd_.item[k];
    const Vec3& other = points_[edges_[end / 2][1 - end % 2]];
    const double step = (other - node).dot(along);
    const Vec3& last = step > 0.0 ? to : from;
    const bool isLonger = std::abs(step) > std::abs((last - node).dot(along));
    if (std::abs(step) > within && (isLonger ? DistanceFromSegment({ node, other }, last)
                                             : DistanceFromSegment({ from, to }, other)) <= within)
    {
      return true;
    }
  }
  return false;
}

/// Returns the points that divide an edge, in order from its first end.
std::vector<Index> SeamFinder::NodesOf(const Edge& edge, const SegmentTree& tree) const
{
  const Vec3& from = points_[edge[0]];
  const Vec3& to = points_[edge[1]];
  const double length = (to - from).norm();
  const double ofEdge = std::min({ tolerance_[edge[0]], tolerance_[edge[1]], SeamShare * length });
  std::vector<Index> nodes;
  tree.ForEachNear({ from, to }, ofEdge,
    [&](Index point)
    {
      const double within = std::min(ofEdge, tolerance_[point]);
      const double part = (points_[point] - from).dot(to - from) / length;
      if (point != edge[0] && point != edge[1] && part > within && part < length - within &&
          DistanceFromSegment({ from, to }, points_[point]) <= within &&
          this->IsNode(edge, point, within))
      {
        nodes.push_back(point);
      }
    });
  std::sort(nodes.begin(), nodes.end(),
    [&](Index a, Index b)
    {
      const double ofA = (points_[a] - from).dot(to - from);
      const double ofB = (points_[b] - from).dot(to - from);
      return ofA != ofB ? ofA < ofB : a < b;
    });
  return nodes;
}

void SeamFinder::DivideEdges(Seams& seams) const
{
  const SegmentTree tree(points_);
  std::vector<std::vector<Index>> nodes(edges_.size());
  ParallelRanges(static_cast<Id>(edges_.size()), threads_,
    [&](Id begin, Id end)
    {
      for (Id edge = begin; edge < end; ++edge)
      {
        nodes[edge] = this->NodesOf(edges_[edge], tree);
      }
    });
  for (std::size_t edge = 0; edge < edges_.size(); ++edge)
  {
    if (nodes[edge].empty())
    {
      continue;
    }
    Seams::Division division;
    division.ends = { places_[edges_[edge][0]], places_[edges_[edge][1]] };
    for (const Index node : nodes[edge])
    {
      division.nodes.push_back(places_[node]);
    }
    seams.divisions.push_back(std::move(division));
  }
}

Seams SeamFinder::Find()
{
  Seams seams;
  this->JoinEnds(seams);
  this->ListEdgesOfEnds();
  this->DivideEdges(seams);
  return seams;
}

} // namespace

Seams FindSeams(const std::vector<OpenEdge>& open, const std::vector<double>& shortest,
  double longestSide, int threads)
{
  if (open.empty() || !(longestSide > 0.0) || std::isinf(longestSide))
  {
    return {};
  }
  return SeamFinder(open, shortest, longestSide, threads).Find();
}

} // namespace gridfem
