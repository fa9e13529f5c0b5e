#include "Grid/SegmentTree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace gridfem
{
namespace
{

constexpr Index MostPerBox = 8;

double SquaredDistanceOfSegment(const Segment& segment, const Vec3& place)
{
  const Vec3 along = segment[1] - segment[0];
  const double square = along.squaredNorm();
  const double t =
    square > 0.0 ? std::clamp((place - segment[0]).dot(along) / square, 0.0, 1.0) : 0.0;
  return (place - segment[0] - t * along).squaredNorm();
}

double SquaredDistanceOfBox(const Vec3& low, const Vec3& high, const Vec3& place)
{
  return (low - place).cwiseMax(place - high).cwiseMax(0.0).squaredNorm();
}

std::vector<Segment> SegmentsAt(const std::vector<Vec3>& points)
{
  std::vector<Segment> segments;
  segments.reserve(points.size());
  for (const Vec3& point : points)
  {
    segments.push_back({ point, point });
  }
  return segments;
}

} // namespace

double DistanceFromSegment(const Segment& segment, const Vec3& place)
{
  return std::sqrt(SquaredDistanceOfSegment(segment, place));
}

SegmentTree::SegmentTree(std::vector<Segment> segments)
  : segments_(std::move(segments)), order_(segments_.size())
{
  std::iota(order_.begin(), order_.end(), Index{ 0 });
  if (!segments_.empty())
  {
    this->Build(0, static_cast<Index>(segments_.size()));
  }
}

SegmentTree::SegmentTree(const std::vector<Vec3>& points) : SegmentTree(SegmentsAt(points))
{
}

/// Makes the box of these segments, and divides the segments at the middle of its longest side.
void SegmentTree::Build(Index begin, Index end)
{
  const std::size_t own = boxes_.size();
  const Segment& first = segments_[order_[begin]];
  Box box{ first[0], first[0], begin, end, 0, end - begin <= MostPerBox };
  for (Index k = begin; k < end; ++k)
  {
    const Segment& segment = segments_[order_[k]];
    box.low = box.low.cwiseMin(segment[0]).cwiseMin(segment[1]);
    box.high = box.high.cwiseMax(segment[0]).cwiseMax(segment[1]);
  }
  boxes_.push_back(box);
  if (!box.isLeaf)
  {
    int axis = 0;
    (box.high - box.low).maxCoeff(&axis);
    const Index middle = begin + (end - begin) / 2;
    const auto sumOfEnds = [&](Index k) { return segments_[k][0][axis] + segments_[k][1][axis]; };
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
      [&](Index a, Index b) { return sumOfEnds(a) < sumOfEnds(b); });
    this->Build(begin, middle);
    this->Build(middle, end);
  }
  boxes_[own].next = boxes_.size();
}

double SegmentTree::DistanceFrom(const Vec3& place) const
{
  double least = std::numeric_limits<double>::infinity();
  std::array<std::size_t, 64> waiting; // one box per halving of fewer than 2^31 segments
  std::size_t count = 0;
  if (!boxes_.empty())
  {
    waiting[count++] = 0;
  }
  while (count > 0)
  {
    const std::size_t number = waiting[--count];
    const Box& box = boxes_[number];
    if (SquaredDistanceOfBox(box.low, box.high, place) >= least)
    {
      continue;
    }
    for (Index k = box.begin; box.isLeaf && k < box.end; ++k)
    {
      least = std::min(least, SquaredDistanceOfSegment(segments_[order_[k]], place));
    }
    if (box.isLeaf)
    {
      continue;
    }
    std::size_t farther = boxes_[number + 1].next; // the second half
    std::size_t nearer = number + 1;
    const auto distanceOf = [&](const Box& half)
    { return SquaredDistanceOfBox(half.low, half.high, place); };
    if (distanceOf(boxes_[farther]) < distanceOf(boxes_[nearer]))
    {
      std::swap(nearer, farther);
    }
    waiting[count++] = farther;
    waiting[count++] = nearer; // the next one
  }
  return std::sqrt(least);
}

/// Whether the line meets the box, made larger by the distance.
bool SegmentTree::Touches(const Box& box, const Segment& line, double distance)
{
  double enter = 0.0;
  double leave = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double from = line[0][axis];
    const double low = box.low[axis] - distance;
    const double high = box.high[axis] + distance;
    const double step = line[1][axis] - from;
    if (step == 0.0)
    {
      if (from < low || from > high)
      {
        return false;
      }
      continue;
    }
    const double atLow = (low - from) / step;
    const double atHigh = (high - from) / step;
    enter = std::max(enter, std::min(atLow, atHigh));
    leave = std::min(leave, std::max(atLow, atHigh));
  }
  return enter <= leave;
}

} // namespace gridfem
