#include "Grid/PointTree.h"

#include <algorithm>
#include <numeric>

namespace gridfem
{

namespace
{

constexpr Index PointsPerLeaf = 8;

} // namespace

PointTree::PointTree(const std::vector<Vec3>& points) : points_(points.size())
{
  std::iota(points_.begin(), points_.end(), Index{ 0 });
  if (!points.empty())
  {
    this->Build(points, 0, static_cast<Index>(points.size()));
  }
}

void PointTree::Build(const std::vector<Vec3>& points, Index begin, Index end)
{
  Node node{ points[points_[begin]], points[points_[begin]], 0, begin, begin };
  for (Index k = begin; k < end; ++k)
  {
    node.low = node.low.cwiseMin(points[points_[k]]);
    node.high = node.high.cwiseMax(points[points_[k]]);
  }
  const std::size_t own = nodes_.size();
  const bool isLeaf = end - begin <= PointsPerLeaf;
  node.end = isLeaf ? end : begin;
  nodes_.push_back(node);
  if (!isLeaf)
  {
    int axis = 0;
    (node.high - node.low).maxCoeff(&axis);
    const Index middle = begin + (end - begin) / 2;
    std::nth_element(points_.begin() + begin, points_.begin() + middle, points_.begin() + end,
      [&](Index a, Index b) { return points[a][axis] < points[b][axis]; });
    this->Build(points, begin, middle);
    this->Build(points, middle, end);
  }
  nodes_[own].next = nodes_.size();
}

/// Whether the segment meets the box, made larger by the distance.
bool PointTree::Touches(const Node& box, const Vec3& from, const Vec3& to, double distance)
{
  double enter = 0.0;
  double leave = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = box.low[axis] - distance;
    const double high = box.high[axis] + distance;
    const double step = to[axis] - from[axis];
    if (step == 0.0)
    {
      if (from[axis] < low || from[axis] > high)
      {
        return false;
      }
      continue;
    }
    const double atLow = (low - from[axis]) / step;
    const double atHigh = (high - from[axis]) / step;
    enter = std::max(enter, std::min(atLow, atHigh));
    leave = std::min(leave, std::max(atLow, atHigh));
  }
  return enter <= leave;
}

} // namespace gridfem
