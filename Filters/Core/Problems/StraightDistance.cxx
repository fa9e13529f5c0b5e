#include "Problems/StraightDistance.h"

#include "Base/Parallel.h"
#include "Base/RadixSort.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

bool AreAllSources(const std::array<Id, 3>& corner, const std::vector<char>& isSource)
{
  return isSource[corner[0]] && isSource[corner[1]] && isSource[corner[2]];
}

/// Adds the sources that are corners of a triangle outside of all regions.
void AppendPoints(
  const TriangleMesh& mesh, const std::vector<char>& isSource, std::vector<Segment>& rim)
{
  std::vector<char> isOnRim(isSource.size(), 0);
  for (const auto& corner : mesh.triangles)
  {
    const bool isInside = AreAllSources(corner, isSource);
    for (const Id point : corner)
    {
      isOnRim[point] = isOnRim[point] || (isSource[point] && !isInside);
    }
  }
  for (std::size_t point = 0; point < isOnRim.size(); ++point)
  {
    if (isOnRim[point])
    {
      rim.push_back({ mesh.points[point], mesh.points[point] });
    }
  }
}

/// Adds the edges of regions that belong to one triangle, or to a triangle outside as well.
void AppendEdges(const TriangleMesh& mesh, const std::vector<char>& isSource, int threads,
  std::vector<Segment>& rim)
{
  int bits = 1;
  while ((std::size_t(1) << bits) < mesh.points.size())
  {
    ++bits;
  }
  const auto visit = [&](Id begin, Id end, auto&& add)
  {
    for (Id t = begin; t < end; ++t)
    {
      const auto& corner = mesh.triangles[t];
      for (int k = 0; k < 3; ++k)
      {
        const auto [low, high] = std::minmax({ corner[k], corner[(k + 1) % 3] });
        if (isSource[low] && isSource[high])
        {
          add((std::uint64_t(low) << bits) | std::uint64_t(high),
            AreAllSources(corner, isSource) ? 1 : 0);
        }
      }
    }
  };
  const Array<SortEntry> sides =
    SortByKey(static_cast<Id>(mesh.triangles.size()), 2 * bits, threads, visit);
  for (std::size_t first = 0; first < sides.size();)
  {
    std::size_t inside = 0;
    std::size_t last = first;
    for (; last < sides.size() && sides[last].key == sides[first].key; ++last)
    {
      inside += sides[last].item;
    }
    const std::uint64_t key = sides[first].key;
    if (inside > 0 && (last - first == 1 || inside < last - first))
    {
      rim.push_back(
        { mesh.points[key >> bits], mesh.points[key & ((std::uint64_t(1) << bits) - 1)] });
    }
    first = last;
  }
}

} // namespace

double DistanceFromSegment(const Segment& segment, const Vec3& place)
{
  return std::sqrt(SquaredDistanceOfSegment(segment, place));
}

SegmentTree::SegmentTree(std::vector<Segment> segments) : segments_(std::move(segments))
{
  if (!segments_.empty())
  {
    this->Build(0, static_cast<Index>(segments_.size()));
  }
}

/// Makes the box of these segments and halves them at the middle of its longest side.
/// @return  the number of the box
Index SegmentTree::Build(Index begin, Index end)
{
  const auto number = static_cast<Index>(boxes_.size());
  Box box{ segments_[begin][0], segments_[begin][0], begin, end, 0 };
  for (Index k = begin; k < end; ++k)
  {
    box.low = box.low.cwiseMin(segments_[k][0]).cwiseMin(segments_[k][1]);
    box.high = box.high.cwiseMax(segments_[k][0]).cwiseMax(segments_[k][1]);
  }
  boxes_.push_back(box);
  if (end - begin > MostPerBox)
  {
    int axis = 0;
    (box.high - box.low).maxCoeff(&axis);
    const Index middle = begin + (end - begin) / 2;
    std::nth_element(segments_.begin() + begin, segments_.begin() + middle, segments_.begin() + end,
      [axis](const Segment& a, const Segment& b)
      { return a[0][axis] + a[1][axis] < b[0][axis] + b[1][axis]; });
    this->Build(begin, middle);
    const Index second = this->Build(middle, end);
    boxes_[number].secondChild = second;
  }
  return number;
}

double SegmentTree::DistanceFrom(const Vec3& place) const
{
  double least = std::numeric_limits<double>::infinity();
  std::array<Index, 64> waiting; // one box per halving of fewer than 2^31 segments
  std::size_t count = 0;
  if (!boxes_.empty())
  {
    waiting[count++] = 0;
  }
  while (count > 0)
  {
    const Index number = waiting[--count];
    const Box& box = boxes_[number];
    if (SquaredDistanceOfBox(box.low, box.high, place) >= least)
    {
      continue;
    }
    if (box.secondChild == 0)
    {
      for (Index k = box.begin; k < box.end; ++k)
      {
        least = std::min(least, SquaredDistanceOfSegment(segments_[k], place));
      }
      continue;
    }
    const Box& first = boxes_[number + 1];
    const Box& second = boxes_[box.secondChild];
    const bool isFirstNearer = SquaredDistanceOfBox(first.low, first.high, place) <=
                               SquaredDistanceOfBox(second.low, second.high, place);
    waiting[count++] = isFirstNearer ? box.secondChild : number + 1;
    waiting[count++] = isFirstNearer ? number + 1 : box.secondChild; // the next one
  }
  return std::sqrt(least);
}

std::vector<double> DistancesThroughSpace(
  const TriangleMesh& mesh, std::vector<Segment> segments, int threads)
{
  std::vector<double> distance(mesh.points.size(), 0.0);
  if (segments.empty())
  {
    return distance;
  }
  const SegmentTree tree(std::move(segments));
  ParallelRanges(static_cast<Id>(distance.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id point = begin; point < end; ++point)
      {
        distance[point] = tree.DistanceFrom(mesh.points[point]);
      }
    });
  return distance;
}

std::vector<Segment> RimOfSources(
  const TriangleMesh& mesh, const std::vector<char>& isSource, int threads)
{
  std::vector<Segment> rim;
  AppendPoints(mesh, isSource, rim);
  AppendEdges(mesh, isSource, threads, rim);
  return rim;
}

} // namespace gridfem
