#include "Parallel/RankMemory.h"

#include "Problems/MemoryEstimate.h"

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>

namespace gridfem
{

namespace
{

/// Of what Core takes for the same triangles: the way of triangles to their ranks takes room, too.
/// A torus of 2.9 million took 1.2 times as much on one rank, 1.5 times on each of two.
constexpr double OfRank = 1.5;

/// Bytes that the limit of this process leaves.
double RoomOfProcess()
{
#ifdef __linux__
  rlimit limit{};
  double pages = 0.0;
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
      std::ifstream("/proc/self/statm") >> pages)
  {
    return double(limit.rlim_cur) - pages * double(sysconf(_SC_PAGESIZE));
  }
#endif
  return std::numeric_limits<double>::infinity();
}

void RequireBytes(double bytes, double available, const Grid& grid, const char* who)
{
  if (bytes <= available)
  {
    return;
  }
  constexpr double GB = 1e9;
  std::ostringstream message;
  message << std::setprecision(3) << "Depth " << grid.depth << " needs about " << bytes / GB
          << " GB of memory on " << who << ", but only " << available / GB
          << " GB are free. Every step down in Depth takes a quarter of the memory.";
  throw InvalidInput(message.str());
}

} // namespace

void RequireMemory(
  const Communicator& ranks, const TriangleMesh& received, const Grid& grid, bool hasHats)
{
  double bytes = 0.0;
  ranks.Together(
    [&]
    {
      const MemoryEstimate estimate = EstimateMemory(received, grid);
      bytes = OfRank *
              (estimate.bytes + (hasHats ? EstimateHatMemory(received, estimate.functions) : 0.0));
    });
  const double ofMachine = ranks.SumOfMachine(bytes);
  ranks.Together(
    [&]
    {
      const double available = AvailableMemory();
      if (available > 0.0)
      {
        RequireBytes(ofMachine, available, grid, "this machine");
      }
      RequireBytes(bytes, RoomOfProcess(), grid, "this rank");
    });
}

} // namespace gridfem
