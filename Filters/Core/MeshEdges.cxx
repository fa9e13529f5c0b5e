#include "MeshEdges.h"

#include "Errors.h"
#include "Grouping.h"
#include "Parallel.h"

#include <algorithm>
#include <utility>

namespace gridfem
{

namespace
{

/// Lower ends per bucket: its sides are sorted in cache.
constexpr Index PointsPerBucket = 512;

/// Ranges of triangles that the partition treats in parallel: few, because each counts all buckets.
constexpr Id MostRanges = 64;
constexpr Id SmallestRange = Id{ 1 } << 14;

/// One side of an edge: the triangle's edge from a corner to the next.
struct Side
{
  Index low; // lower end of the edge
  Index high;
  Index side; // 3 triangle + edge
};

/// Finds the edges bucket by bucket: one partition of the sides by lower end, then sorts in cache.
class EdgeFinder
{
public:
  EdgeFinder(
    const std::vector<std::array<Id, 3>>& triangles, const Array<Index>& pointClass, int threads)
    : triangles_(triangles), pointClass_(pointClass), threads_(threads),
      buckets_((static_cast<Index>(pointClass.size()) + PointsPerBucket - 1) / PointsPerBucket)
  {
  }

  void Find(MeshEdges& edges);

private:
  void Partition();
  void SortBucket(Index bucket);
  void FillBucket(Index bucket, MeshEdges& edges) const;

  /// Whether a side is the first of its edge. Only inside sorted buckets.
  bool IsFirst(Index k, Index bucketBegin) const
  {
    return k == bucketBegin || sides_[k].low != sides_[k - 1].low ||
           sides_[k].high != sides_[k - 1].high;
  }

  const std::vector<std::array<Id, 3>>& triangles_;
  const Array<Index>& pointClass_;
  const int threads_;
  const Index buckets_;
  Array<Side> sides_;
  std::vector<Index> bucketBegin_; // into sides_
  std::vector<Index> edgeBegin_;   // first edge of each bucket
};

/// A stable counting sort of the sides by bucket, ranges of triangles in parallel.
void EdgeFinder::Partition()
{
  const Id triangles = static_cast<Id>(triangles_.size());
  const Id size = std::max(SmallestRange, (triangles + MostRanges - 1) / MostRanges);
  const Id ranges = (triangles + size - 1) / size;
  std::vector<Index> next(ranges * buckets_, 0);
  const auto forSides = [&](const auto& visit)
  {
    ParallelBlocks(ranges, threads_,
      [&](Id range)
      {
        Index* ofBucket = next.data() + range * buckets_;
        const Id end = std::min(triangles, (range + 1) * size);
        for (Id t = range * size; t < end; ++t)
        {
          const std::array<Index, 3> corner{ pointClass_[triangles_[t][0]],
            pointClass_[triangles_[t][1]], pointClass_[triangles_[t][2]] };
          for (int k = 0; k < 3; ++k)
          {
            const auto [low, high] = std::minmax(corner[k], corner[k == 2 ? 0 : k + 1]);
            visit(
              Side{ low, high, static_cast<Index>(3 * t + k) }, ofBucket[low / PointsPerBucket]);
          }
        }
      });
  };
  forSides([](const Side&, Index& count) { ++count; });
  bucketBegin_.resize(buckets_ + 1);
  ScanGroups(next, ranges, bucketBegin_);
  sides_.resize(bucketBegin_.back());
  forSides([&](const Side& side, Index& place) { sides_[place++] = side; });
}

/// Sorts by the higher end; sides of one edge keep their order.
void SortByHighEnd(Side* begin, Side* end)
{
  constexpr std::ptrdiff_t Few = 32;
  const auto isLess = [](const Side& a, const Side& b) { return a.high < b.high; };
  if (end - begin > Few)
  {
    std::stable_sort(begin, end, isLess);
    return;
  }
  for (Side* next = begin; next < end; ++next)
  {
    const Side side = *next;
    Side* place = next;
    for (; place > begin && isLess(side, place[-1]); --place)
    {
      *place = place[-1];
    }
    *place = side;
  }
}

/// Sorts the sides of a bucket by edge and counts its edges.
void EdgeFinder::SortBucket(Index bucket)
{
  const Index bucketBegin = bucketBegin_[bucket];
  const Index bucketEnd = bucketBegin_[bucket + 1];
  const Index firstPoint = bucket * PointsPerBucket;
  std::array<Index, PointsPerBucket + 1> begin{};
  for (Index k = bucketBegin; k < bucketEnd; ++k)
  {
    ++begin[sides_[k].low - firstPoint + 1];
  }
  for (Index point = 0; point < PointsPerBucket; ++point)
  {
    begin[point + 1] += begin[point];
  }
  const std::vector<Side> unsorted(sides_.begin() + bucketBegin, sides_.begin() + bucketEnd);
  std::array<Index, PointsPerBucket + 1> next = begin;
  for (const Side& side : unsorted)
  {
    sides_[bucketBegin + next[side.low - firstPoint]++] = side;
  }
  Side* sides = sides_.data() + bucketBegin;
  for (Index point = 0; point < PointsPerBucket; ++point)
  {
    SortByHighEnd(sides + begin[point], sides + begin[point + 1]);
  }
  for (Index k = bucketBegin; k < bucketEnd; ++k)
  {
    edgeBegin_[bucket] += this->IsFirst(k, bucketBegin) ? 1 : 0;
  }
}

void EdgeFinder::FillBucket(Index bucket, MeshEdges& edges) const
{
  Index edge = edgeBegin_[bucket] - 1;
  for (Index k = bucketBegin_[bucket]; k < bucketBegin_[bucket + 1]; ++k)
  {
    const auto [low, high, side] = sides_[k];
    if (this->IsFirst(k, bucketBegin_[bucket]))
    {
      ++edge;
      edges.ends[edge] = { low, high };
      edges.sideBegin[edge] = k;
    }
    edges.side[k] = side;
    edges.ofTriangle[side / 3][side % 3] = edge;
  }
}

void EdgeFinder::Find(MeshEdges& edges)
{
  this->Partition();
  edgeBegin_.assign(buckets_ + 1, 0);
  ParallelBlocks(
    buckets_, threads_, [&](Id bucket) { this->SortBucket(static_cast<Index>(bucket)); });
  const Index count = ExclusiveScan(edgeBegin_);
  edges.ofTriangle.resize(triangles_.size());
  edges.ends.resize(count);
  edges.sideBegin.resize(count + 1);
  edges.side.resize(sides_.size());
  ParallelBlocks(
    buckets_, threads_, [&](Id bucket) { this->FillBucket(static_cast<Index>(bucket), edges); });
  edges.sideBegin[count] = static_cast<Index>(sides_.size());
}

} // namespace

MeshEdges BuildMeshEdges(const std::vector<std::array<Id, 3>>& triangles,
  const Array<Index>& pointClass, const Array<Vec3>& position, int threads)
{
  RequireIndices(3.0 * static_cast<double>(triangles.size()), "sides of triangles");
  MeshEdges edges;
  EdgeFinder(triangles, pointClass, threads).Find(edges);
  const Index count = edges.NumberOfEdges();
  edges.cutBegin.resize(count + 1);
  const double cuts = ParallelSum(count, threads, 0.0,
    [&](Id begin, Id end)
    {
      double sum = 0.0;
      for (Id e = begin; e < end; ++e)
      {
        const Vec3& a = position[edges.ends[e][0]];
        const Vec3& b = position[edges.ends[e][1]];
        edges.cutBegin[e] = PlanesBetween(a[0], b[0]).count + PlanesBetween(a[1], b[1]).count +
                            PlanesBetween(a[2], b[2]).count;
        sum += edges.cutBegin[e];
      }
      return sum;
    });
  RequireIndices(cuts, "cut points");
  edges.cutBegin[count] = 0;
  ExclusiveScan(edges.cutBegin);
  return edges;
}

} // namespace gridfem
