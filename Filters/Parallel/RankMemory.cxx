#include "Parallel/RankMemory.h"

#include "Problems/MemoryEstimate.h"
#include "Problems/Requirements.h"

#include <string>

namespace gridfem
{

namespace
{

/// Of what Core takes for the same triangles: the way of triangles to their ranks takes room, too.
/// A torus of 2.9 million took 1.2 times as much on one rank, 1.5 times on each of two.
constexpr double OfRank = 1.5;

} // namespace

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
  MemoryNeed own{ 0.0, "Depth " + std::to_string(grid.depth), CoarserGrid };
  ranks.Together(
    [&]
    {
      const MemoryEstimate estimate = EstimateMemory(received, grid);
      own.bytes = OfRank * (estimate.bytes +
                             (hasHats ? EstimateHatMemory(received, estimate.functions) : 0.0));
    });
  RequireMemory(ranks, own);
}

} // namespace gridfem
