#include "Parallel/RankMemory.h"

#include "Solvers/MemoryEstimate.h"
#include "Solvers/Requirements.h"

#include <string>

namespace gridfem
{

namespace
{

/// Memory of a rank relative to Core's estimate for the same triangles. The transfer of triangles
/// to their ranks takes memory, too. A torus of 2.9 million took 1.2 times as much on one rank, and
/// 1.5 times on each of two.
constexpr double OfRank = 1.5;

/// A rank may get more than its share of the surface, and the surface around it.
constexpr double MostOfShare = 1.5;

/// Collective. Bytes for a rank's triangles.
double BytesOf(
  const Communicator& ranks, const TriangleMesh& triangles, const Grid& grid, bool hasHats)
{
  double bytes = 0.0;
  ranks.Together(
    [&]
    {
      const MemoryEstimate estimate = EstimateMemory(triangles, grid);
      bytes = OfRank *
              (estimate.bytes + (hasHats ? EstimateHatMemory(triangles, estimate.functions) : 0.0));
    });
  return bytes;
}

} // namespace

bool FitsMemory(const Communicator& ranks, const TriangleMesh& own, const Grid& grid, bool hasHats)
{
  double bytes = BytesOf(ranks, own, grid, hasHats);
  ranks.Sum(&bytes, 1);
  bytes *= MostOfShare / ranks.Size();
  double lacking = bytes > MemoryOfProcess() ? 1.0 : 0.0;
  lacking += ranks.SumOfMachine(bytes) > MemoryOfMachine() ? 1.0 : 0.0;
  ranks.Maximum(&lacking, 1);
  return lacking == 0.0;
}

void RequireMemory(const Communicator& ranks, const MemoryNeed& own)
{
  MemoryNeed ofMachine = own;
  ofMachine.bytes = ranks.SumOfMachine(own.bytes);
  ranks.Together(
    [&]
    {
      RequireMemory(ofMachine, MemoryOfMachine(), " on this machine");
      RequireMemory(own, MemoryOfProcess(), " on this rank");
    });
}

void RequireMemory(
  const Communicator& ranks, const TriangleMesh& received, const Grid& grid, bool hasHats)
{
  RequireMemory(ranks, { BytesOf(ranks, received, grid, hasHats),
                         "Depth " + std::to_string(grid.depth), CoarserGrid });
}

} // namespace gridfem
