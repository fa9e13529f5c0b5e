#include "Grid/MeshEdges.h"

#include "Base/Errors.h"
#include "Base/Grouping.h"
#include "Base/Parallel.h"
#include "Base/PerThreadLists.h"

#include <algorithm>
#include <utility>

namespace gridfem
{

namespace
{

/// Number of lower ends per bucket. The sides of a bucket fit the cache while they are sorted.
constexpr Index PointsPerBucket = 512;

/// Most ranges of triangles that the partition processes in parallel. There are few, because each
/// range counts all buckets.
constexpr Id MostEdgeRanges = 64;
constexpr Id SmallestRange = Id{ 1 } << 14;

/// One side of an edge, from a corner of the triangle to the next.
struct Side
{
  Index low; // lower end of the edge
  Index high;
  Index side; // 3 triangle + edge
};

/// First the space that a bucket's edges need, later the positions where it begins.
struct Places
{
  double cuts = 0.0;
  double pairs = 0.0;
  double manySided = 0.0; // places of stretches
};

/// Finds the edges bucket by bucket. It partitions the sides by their lower end, then sorts each
/// bucket in the cache.
class EdgeFinder
{
public:
  EdgeFinder(const std::vector<std::array<Id, 3>>& triangles, const Array<Index>& pointClass,
    const Array<Vec3>& position, int threads)
    : triangles_(triangles), pointClass_(pointClass), position_(position), threads_(threads),
      buckets_((static_cast<Index>(pointClass.size()) + PointsPerBucket - 1) / PointsPerBucket)
  {
  }

  MeshEdges Find();

private:
  /// Replaces the number of cuts for an edge without length.
  static constexpr Index NoLength = -1;

  void Partition();
  void SortBucket(Index bucket);
  void MeasureBucket(Index bucket);
  void ScanPlaces(MeshEdges& edges);
  void FillBucket(Index bucket, MeshEdges& edges, Array<ManySidedEdge>& manySided) const;
  Index CutsOf(const Side& side) const;

  const std::vector<std::array<Id, 3>>& triangles_;
  const Array<Index>& pointClass_;
  const Array<Vec3>& position_;
  const int threads_;
  const Index buckets_;
  Array<Side> sides_;
  std::vector<Index> bucketBegin_; // into sides_
  std::vector<Places> places_;     // per bucket
};

/// Stable counting sort of the sides by bucket, with ranges of triangles in parallel.
void EdgeFinder::Partition()
{
  const Id triangles = static_cast<Id>(triangles_.size());
  const Id size = std::max(SmallestRange, (triangles + MostEdgeRanges - 1) / MostEdgeRanges);
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

/// Sorts by the higher end. Sides of one edge keep their order.
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

/// Sorts the sides of a bucket by edge.
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
}

Index EdgeFinder::CutsOf(const Side& side) const
{
  if (side.low == side.high)
  {
    return NoLength;
  }
  const Vec3& a = position_[side.low];
  const Vec3& b = position_[side.high];
  return PlanesBetween(a[0], b[0]).count + PlanesBetween(a[1], b[1]).count +
         PlanesBetween(a[2], b[2]).count;
}

/// Counts the space that the edges of a sorted bucket need. In the first side of an edge, it
/// overwrites `low` by the number of cuts and `high` by the number of sides. Looking up the
/// positions takes most of the time, so they are not looked up again.
void EdgeFinder::MeasureBucket(Index bucket)
{
  Places& places = places_[bucket];
  const Index end = bucketBegin_[bucket + 1];
  for (Index k = bucketBegin_[bucket]; k < end;)
  {
    Index next = k + 1;
    while (next < end && sides_[next].low == sides_[k].low && sides_[next].high == sides_[k].high)
    {
      ++next;
    }
    const Index cuts = this->CutsOf(sides_[k]);
    const Index sides = next - k;
    if (cuts != NoLength)
    {
      places.cuts += cuts;
      (sides <= 2 ? places.pairs : places.manySided) += (sides <= 2 ? 1.0 : sides) * (cuts + 1.0);
    }
    sides_[k].low = cuts;
    sides_[k].high = sides;
    k = next;
  }
}

void EdgeFinder::ScanPlaces(MeshEdges& edges)
{
  Places sum;
  for (Places& places : places_)
  {
    const Places here = std::exchange(places, sum);
    sum.cuts += here.cuts;
    sum.pairs += here.pairs;
    sum.manySided += here.manySided;
  }
  RequireIndices(sum.cuts, "cut points");
  RequireIndices(2.0 * sum.pairs + sum.manySided, "stretches of edges");
  edges.numberOfCuts = static_cast<Index>(sum.cuts);
  edges.numberOfPairs = static_cast<Index>(sum.pairs);
  edges.numberOfPlaces = static_cast<Index>(2.0 * sum.pairs + sum.manySided);
}

/// @param manySided  receives the bucket's edges with more than two sides
void EdgeFinder::FillBucket(Index bucket, MeshEdges& edges, Array<ManySidedEdge>& manySided) const
{
  auto cut = static_cast<Index>(places_[bucket].cuts);
  auto pair = static_cast<Index>(places_[bucket].pairs);
  Index many = 2 * edges.numberOfPairs + static_cast<Index>(places_[bucket].manySided);
  for (Index k = bucketBegin_[bucket]; k < bucketBegin_[bucket + 1];)
  {
    const Index cuts = sides_[k].low;
    const Index sides = sides_[k].high;
    const bool isPair = sides <= 2;
    const Index begin = isPair ? 2 * pair : many;
    const Index step = isPair ? 1 : cuts + 1;
    for (Index j = 0; j < sides; ++j)
    {
      const Index side = sides_[k + j].side;
      EdgeSide& place = edges.ofTriangle[side / 3][side % 3];
      place.cut = j == 0 ? cut : ~cut;
      place.stretch = cuts == NoLength ? EdgeSide::None : begin + j * step;
    }
    k += sides;
    if (cuts == NoLength)
    {
      continue;
    }
    cut += cuts;
    pair += isPair ? cuts + 1 : 0;
    if (!isPair)
    {
      manySided.emplace_back(begin, sides, cuts + 1);
      many += sides * (cuts + 1);
    }
  }
}

MeshEdges EdgeFinder::Find()
{
  this->Partition();
  places_.resize(buckets_);
  ParallelBlocks(buckets_, threads_,
    [&](Id bucket)
    {
      this->SortBucket(static_cast<Index>(bucket));
      this->MeasureBucket(static_cast<Index>(bucket));
    });
  MeshEdges edges;
  this->ScanPlaces(edges);
  edges.ofTriangle.resize(triangles_.size());
  PerThreadLists<ManySidedEdge> manySided(buckets_, threads_);
  ParallelBlocks(buckets_, threads_,
    [&](Id bucket, int thread)
    {
      manySided.Make(bucket, thread,
        [&](Array<ManySidedEdge>& list)
        { this->FillBucket(static_cast<Index>(bucket), edges, list); });
    });
  manySided.AppendTo(edges.manySided, threads_);
  return edges;
}

} // namespace

MeshEdges BuildMeshEdges(const std::vector<std::array<Id, 3>>& triangles,
  const Array<Index>& pointClass, const Array<Vec3>& position, int threads)
{
  RequireIndices(3.0 * static_cast<double>(triangles.size()), "sides of triangles");
  return EdgeFinder(triangles, pointClass, position, threads).Find();
}

} // namespace gridfem
