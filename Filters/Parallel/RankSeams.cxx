#include "Parallel/RankSeams.h"

#include "Grid/KeepOdd.h"

#include <algorithm>
#include <array>

namespace gridfem
{

namespace
{

/// Collective. The edges that are open on all ranks together. Every edge is counted by one rank.
std::vector<OpenEdge> OpenEdgesOfAll(const Communicator& ranks, const std::vector<OpenEdge>& own)
{
  std::vector<std::vector<OpenEdge>> sent(ranks.Size());
  ranks.Together(
    [&]
    {
      for (const OpenEdge& edge : own)
      {
        const std::uint64_t hash = HashPlace(edge[0]) ^ (HashPlace(edge[1]) >> 1);
        sent[(hash >> 8) % static_cast<std::uint64_t>(ranks.Size())].push_back(edge);
      }
    });
  sent = ranks.Exchange(sent);
  std::vector<OpenEdge> counted;
  ranks.Together(
    [&]
    {
      for (const std::vector<OpenEdge>& edges : sent)
      {
        counted.insert(counted.end(), edges.begin(), edges.end());
      }
      KeepOdd(counted);
    });
  counted = ranks.Gather(counted);
  ranks.Together([&] { std::sort(counted.begin(), counted.end()); });
  return counted;
}

/// Collective. The longest side of the box around the points that triangles use.
double LongestSide(const Communicator& ranks, const TriangleMesh& own, int threads)
{
  std::array<double, 6> extremes; // largest of -x, -y, -z, x, y and z
  ranks.Together(
    [&]
    {
      const Bounds bounds = BoundsOf(own.points, UsedPoints(own, threads), threads);
      for (int axis = 0; axis < 3; ++axis)
      {
        extremes[axis] = -bounds.low[axis];
        extremes[3 + axis] = bounds.high[axis];
      }
    });
  ranks.Maximum(extremes.data(), 6);
  double longest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    longest = std::max(longest, extremes[axis] + extremes[3 + axis]);
  }
  return longest;
}

} // namespace

Seams FindSeams(const Communicator& ranks, const TriangleMesh& own, int threads)
{
  std::vector<OpenEdge> open;
  ranks.Together([&] { open = FindOpenEdges(own, threads); });
  open = OpenEdgesOfAll(ranks, open);
  if (open.empty())
  {
    return {};
  }
  std::vector<double> shortest;
  ranks.Together([&] { shortest = ShortestSides(own, NumberEnds(open), threads); });
  ranks.Minimum(shortest.data(), static_cast<Id>(shortest.size()));
  const double longest = LongestSide(ranks, own, threads);
  Seams seams;
  ranks.Together([&] { seams = FindSeams(open, shortest, longest, threads); });
  return seams;
}

} // namespace gridfem
