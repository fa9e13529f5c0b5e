#include "Shape/CutGraph.h"

#include "Base/UnionFind.h"
#include "Grid/TriangleArea.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace gridfem
{
namespace
{

/// Fewer leave thin parts of a surface that is nearly closed thousands of times smaller than the
/// rest of the map.
constexpr int LeastCutsOfClosed = 8;

/// A surface is nearly closed if its boundary is at most this part of a circle around its area.
/// Half the circle surrounds a cap of a sphere whose conformal map has a fourth of the scale in its
/// middle. A surface that is cut anyway has less to lose by more cuts.
constexpr double ShortUncut = 0.5;
constexpr double ShortCut = 0.75;

constexpr double NotReached = std::numeric_limits<double>::infinity();

/// Vertices and boundary loops as nodes, with the edges between them.
class CutSearch
{
public:
  CutSearch(const ConnectedTriangles& triangles, const std::vector<Vec3>& points)
    : triangles_(triangles), points_(points), node_(NumberVertices(triangles))
  {
    std::vector<Index> joined(node_.count); // the node of each vertex
    std::iota(joined.begin(), joined.end(), 0);
    for (const std::vector<HalfEdge>& loop : BoundaryLoops(triangles))
    {
      loops_.push_back(node_.ofCorner[loop.front()]);
      for (const HalfEdge h : loop)
      {
        joined[node_.ofCorner[h]] = loops_.back();
      }
    }
    for (Index& node : node_.ofCorner)
    {
      node = joined[node];
    }
    begin_.assign(node_.count + 1, 0);
    for (HalfEdge h = 0; h < this->Count(); ++h)
    {
      ++begin_[this->From(h) + 1];
    }
    for (Index node = 0; node < node_.count; ++node)
    {
      begin_[node + 1] += begin_[node];
    }
    std::vector<Index> next = begin_;
    leaving_.resize(triangles.twin.size());
    for (HalfEdge h = 0; h < this->Count(); ++h)
    {
      leaving_[next[this->From(h)]++] = h;
    }
  }

  std::vector<HalfEdge> Find(bool hasHandles, int extraCuts)
  {
    const Index farthest = this->MeasureFrom(loops_.empty() ? 0 : loops_.front());
    if (hasHandles) // loops around a handle are short if they begin there
    {
      this->MeasureFrom(this->From(this->EdgesAroundHandles().back()));
    }
    else if (loops_.empty())
    {
      this->MeasureFrom(farthest);
    }
    for (const Index loop : loops_)
    {
      this->CutFrom(loop);
    }
    if (hasHandles)
    {
      for (const HalfEdge h : this->EdgesAroundHandles())
      {
        this->CutFrom(this->From(h));
        this->CutFrom(this->To(h));
        cuts_.push_back(h);
      }
    }
    const int extra = this->IsNearlyClosed() ? std::max(extraCuts, LeastCutsOfClosed) : extraCuts;
    for (int k = 0; k < extra; ++k)
    {
      this->CutFrom(this->MeasureFromCuts());
    }
    return std::move(cuts_);
  }

private:
  HalfEdge Count() const { return static_cast<HalfEdge>(triangles_.twin.size()); }
  Index From(HalfEdge h) const { return node_.ofCorner[h]; }
  Index To(HalfEdge h) const { return node_.ofCorner[ConnectedTriangles::Next(h)]; }
  double LengthOf(HalfEdge h) const
  {
    return (points_[triangles_.From(h)] - points_[triangles_.To(h)]).norm();
  }

  /// Both sides of all cuts belong to the boundary.
  bool IsNearlyClosed() const
  {
    double length = 0.0;
    for (HalfEdge h = 0; h < this->Count(); ++h)
    {
      length += triangles_.twin[h] < 0 ? this->LengthOf(h) : 0.0;
    }
    for (const HalfEdge h : cuts_)
    {
      length += 2.0 * this->LengthOf(h);
    }
    double area = 0.0;
    for (const auto& c : triangles_.places)
    {
      area += 0.5 * AreaVector(points_, { c[0], c[1], c[2] }).norm();
    }
    const double circle = std::sqrt(4.0 * double(EIGEN_PI) * area);
    return length <= (cuts_.empty() ? ShortUncut : ShortCut) * circle;
  }

  /// Makes a node the only one on cuts. Returns the farthest from it.
  Index MeasureFrom(Index node)
  {
    isOnCut_.assign(node_.count, 0);
    isOnCut_[node] = 1;
    return this->MeasureFromCuts();
  }

  /// Finds shortest paths from all nodes on cuts to all nodes (Dijkstra). Returns the farthest.
  Index MeasureFromCuts()
  {
    using Waiting = std::pair<double, Index>;
    std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> queue;
    length_.assign(node_.count, NotReached);
    reachedBy_.assign(node_.count, -1);
    for (Index node = 0; node < node_.count; ++node)
    {
      if (isOnCut_[node])
      {
        length_[node] = 0.0;
        queue.emplace(0.0, node);
      }
    }
    Index last = 0;
    while (!queue.empty())
    {
      const auto [length, node] = queue.top();
      queue.pop();
      if (length > length_[node])
      {
        continue;
      }
      last = length > length_[last] || length_[last] == NotReached ? node : last;
      for (Index k = begin_[node]; k < begin_[node + 1]; ++k)
      {
        this->Reach(leaving_[k], this->To(leaving_[k]), queue);
        const HalfEdge before = ConnectedTriangles::Previous(leaving_[k]); // ends at the node
        this->Reach(before, this->From(before), queue);
      }
    }
    return last;
  }

  template<class Queue>
  void Reach(HalfEdge h, Index node, Queue& queue)
  {
    const Index from = this->From(h) == node ? this->To(h) : this->From(h);
    const double length = length_[from] + this->LengthOf(h);
    if (triangles_.twin[h] >= 0 && length < length_[node])
    {
      length_[node] = length;
      reachedBy_[node] = h;
      queue.emplace(length, node);
    }
  }

  /// Cuts along the path from a node to the nodes that are on cuts already.
  void CutFrom(Index node)
  {
    while (!isOnCut_[node])
    {
      isOnCut_[node] = 1;
      const HalfEdge h = reachedBy_[node];
      cuts_.push_back(h);
      node = this->From(h) == node ? this->To(h) : this->From(h);
    }
  }

  /// Edges between two paths of the tree, two for each handle.
  std::vector<HalfEdge> EdgesAroundHandles() const
  {
    std::vector<char> isInTree(triangles_.twin.size(), 0);
    for (const HalfEdge h : reachedBy_)
    {
      if (h >= 0)
      {
        isInTree[h] = isInTree[triangles_.twin[h]] = 1;
      }
    }
    std::vector<std::pair<double, HalfEdge>> edges; // longest loops first
    for (HalfEdge h = 0; h < this->Count(); ++h)
    {
      if (triangles_.twin[h] > h && !isInTree[h])
      {
        edges.emplace_back(-(length_[this->From(h)] + length_[this->To(h)] + this->LengthOf(h)), h);
      }
    }
    std::sort(edges.begin(), edges.end());
    UnionFind sets(triangles_.Count());
    std::vector<HalfEdge> around;
    for (const auto& [length, h] : edges)
    {
      if (sets.Find(h / 3) == sets.Find(triangles_.twin[h] / 3))
      {
        around.push_back(h);
      }
      sets.Unite(h / 3, triangles_.twin[h] / 3);
    }
    return around;
  }

  const ConnectedTriangles& triangles_;
  const std::vector<Vec3>& points_;
  VertexNumbers node_;       // vertices, with those of a loop joined
  std::vector<Index> loops_; // their nodes
  std::vector<Index> begin_; // of the half edges that leave a node
  std::vector<HalfEdge> leaving_;
  std::vector<char> isOnCut_;
  std::vector<double> length_;
  std::vector<HalfEdge> reachedBy_;
  std::vector<HalfEdge> cuts_;
};

} // namespace

std::vector<HalfEdge> FindCuts(const ConnectedTriangles& triangles, const std::vector<Vec3>& points,
  bool hasHandles, int extraCuts)
{
  return CutSearch(triangles, points).Find(hasHandles, extraCuts);
}

} // namespace gridfem
