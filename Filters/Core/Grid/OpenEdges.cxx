#include "Grid/OpenEdges.h"

#include "Base/Errors.h"
#include "Base/Parallel.h"
#include "Base/PerThreadLists.h"
#include "Grid/KeepOdd.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridfem
{

namespace
{

/// An edge by the numbers of its ends.
struct NumberedEdge
{
  Index low;
  Index high;

  bool operator==(const NumberedEdge& other) const
  {
    return low == other.low && high == other.high;
  }
  bool operator<(const NumberedEdge& other) const
  {
    return low != other.low ? low < other.low : high < other.high;
  }
};

std::uint64_t HashEdge(std::uint64_t low, std::uint64_t high)
{
  std::uint64_t hash = low * 0x9e3779b97f4a7c15u + high * 0xd1b54a32d192ed03u;
  hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9u;
  hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebu;
  return hash ^ (hash >> 31);
}

/// Returns the hashes of the sides of a triangle, identified by the ids of their ends. A side
/// without two ends has none.
std::array<std::uint64_t, 3> HashesOfSides(const std::array<Id, 3>& corner)
{
  std::array<std::uint64_t, 3> hash;
  for (int k = 0; k < 3; ++k)
  {
    const Id from = corner[k];
    const Id to = corner[k == 2 ? 0 : k + 1];
    hash[k] = from == to ? 0
                         : HashEdge(static_cast<std::uint64_t>(std::min(from, to)),
                             static_cast<std::uint64_t>(std::max(from, to)));
  }
  return hash;
}

struct Parity
{
  std::uint64_t bits = 0;
  void operator+=(const Parity& other) { bits ^= other.bits; }
};

/// Whether the hashes of all sides cancel, as those of a closed surface do.
bool AreAllPaired(const TriangleMesh& mesh, int threads)
{
  return ParallelSum(static_cast<Id>(mesh.triangles.size()), threads, Parity(),
           [&](Id begin, Id end)
           {
             Parity part;
             for (Id t = begin; t < end; ++t)
             {
               const auto hash = HashesOfSides(mesh.triangles[t]);
               part.bits ^= hash[0] ^ hash[1] ^ hash[2];
             }
             return part;
           })
           .bits == 0;
}

/// Whether the hashes of the sides cancel if coincident points count as one.
bool AreAllPaired(const Array<NumberedEdge>& sides, const TriangleMesh& mesh, int threads)
{
  return ParallelSum(static_cast<Id>(sides.size()), threads, Parity(),
           [&](Id begin, Id end)
           {
             Parity part;
             for (Id k = begin; k < end; ++k)
             {
               const std::uint64_t a = HashPlace(PlaceOf(mesh.points[sides[k].low]));
               const std::uint64_t b = HashPlace(PlaceOf(mesh.points[sides[k].high]));
               part.bits ^= a == b ? 0 : HashEdge(std::min(a, b), std::max(a, b));
             }
             return part;
           })
           .bits == 0;
}

/// Marks the ends of edges that an odd number of triangles share. Edges are identified by the ids
/// of their ends.
std::vector<char> EndsOfUnpaired(const TriangleMesh& mesh, int threads)
{
  std::vector<std::uint64_t> parity(mesh.points.size(), 0);
  ParallelRanges(static_cast<Id>(mesh.triangles.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id t = begin; t < end; ++t)
      {
        const auto hash = HashesOfSides(mesh.triangles[t]);
        for (int k = 0; k < 3; ++k)
        {
          const std::uint64_t ofCorner = hash[k] ^ hash[k == 0 ? 2 : k - 1];
#pragma omp atomic
          parity[mesh.triangles[t][k]] ^= ofCorner;
        }
      }
    });
  std::vector<char> isEnd(parity.size());
  std::transform(
    parity.begin(), parity.end(), isEnd.begin(), [](std::uint64_t bits) { return bits != 0; });
  return isEnd;
}

/// Returns the sides with two marked ends, once for each triangle of a side. Their ends are ids of
/// points, in no order.
Array<NumberedEdge> SidesBetween(
  const std::vector<char>& isEnd, const TriangleMesh& mesh, int threads)
{
  RequireIndices(static_cast<double>(mesh.points.size()), "points");
  Array<NumberedEdge> sides;
  AppendRanges(static_cast<Id>(mesh.triangles.size()), threads, sides,
    [&](Id begin, Id end, Array<NumberedEdge>& list)
    {
      for (Id t = begin; t < end; ++t)
      {
        const auto& corner = mesh.triangles[t];
        for (int k = 0; k < 3; ++k)
        {
          const Id from = corner[k];
          const Id to = corner[k == 2 ? 0 : k + 1];
          if (isEnd[from] && isEnd[to])
          {
            list.push_back({ static_cast<Index>(from), static_cast<Index>(to) });
          }
        }
      }
    });
  return sides;
}

bool FitsFloat(const Vec3& point)
{
  return point.cast<float>().cast<double>() == point;
}

/// Returns the length of a side, or infinity if rounding alone could have made it. Coordinates that
/// fit single precision were probably rounded to it.
double LengthOf(const Vec3& a, const Vec3& b)
{
  const double unit = FitsFloat(a) && FitsFloat(b) ? std::numeric_limits<float>::epsilon()
                                                   : std::numeric_limits<double>::epsilon();
  const double rounding = 4.0 * unit * a.cwiseAbs().cwiseMax(b.cwiseAbs()).maxCoeff();
  const double length = (b - a).stableNorm();
  return length > rounding ? length : std::numeric_limits<double>::infinity();
}

} // namespace

std::vector<OpenEdge> FindOpenEdges(const TriangleMesh& mesh, int threads)
{
  if (AreAllPaired(mesh, threads))
  {
    return {};
  }
  Validate(mesh, threads);
  // Edges that are open once coincident points count as one are among those that are open before.
  const std::vector<char> isEnd = EndsOfUnpaired(mesh, threads);
  const Array<NumberedEdge> sides = SidesBetween(isEnd, mesh, threads);
  if (AreAllPaired(sides, mesh, threads))
  {
    return {};
  }
  const Array<Index> pointClass = WeldCoincidentPoints(mesh.points, isEnd, threads);
  std::vector<NumberedEdge> odd;
  for (const NumberedEdge& side : sides)
  {
    const auto [low, high] = std::minmax(pointClass[side.low], pointClass[side.high]);
    if (low != high)
    {
      odd.push_back({ low, high });
    }
  }
  KeepOdd(odd);
  std::vector<OpenEdge> open;
  open.reserve(odd.size());
  for (const auto& [low, high] : odd)
  {
    OpenEdge edge{ PlaceOf(mesh.points[low]), PlaceOf(mesh.points[high]) };
    if (edge[1] < edge[0])
    {
      std::swap(edge[0], edge[1]);
    }
    open.push_back(edge);
  }
  std::sort(open.begin(), open.end());
  return open;
}

PlaceNumbers NumberEnds(const std::vector<OpenEdge>& edges)
{
  std::vector<Place> places;
  places.reserve(2 * edges.size());
  for (const OpenEdge& edge : edges)
  {
    places.insert(places.end(), edge.begin(), edge.end());
  }
  return PlaceNumbers(std::move(places));
}

std::vector<double> ShortestSides(const TriangleMesh& mesh, const PlaceNumbers& places, int threads)
{
  const std::vector<Index> number = places.OfPoints(mesh.points, threads);
  const auto isPlace = [&](Id point) { return number[point] != PlaceNumbers::None; };
  Array<Id> around; // triangles with a corner at a place
  AppendRanges(static_cast<Id>(mesh.triangles.size()), threads, around,
    [&](Id begin, Id end, Array<Id>& list)
    {
      for (Id t = begin; t < end; ++t)
      {
        const auto& corner = mesh.triangles[t];
        if (std::any_of(corner.begin(), corner.end(), isPlace))
        {
          list.push_back(t);
        }
      }
    });
  std::vector<double> shortest(places.Count(), std::numeric_limits<double>::infinity());
  for (const Id t : around)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Id from = mesh.triangles[t][k];
      const Id to = mesh.triangles[t][k == 2 ? 0 : k + 1];
      const double length = LengthOf(mesh.points[from], mesh.points[to]);
      for (const Id end : { from, to })
      {
        if (isPlace(end))
        {
          shortest[number[end]] = std::min(shortest[number[end]], length);
        }
      }
    }
  }
  return shortest;
}

} // namespace gridfem
