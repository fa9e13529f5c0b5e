// If memory runs out on one rank alone, the computation ends on all ranks. Whichever of its
// allocations fails, no rank waits forever, and all ranks name the rank.
#include "Pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// Smaller allocations are lists with an entry per rank or level, or texts.
constexpr std::size_t SmallestFailure = 2048;

constexpr long Never = -1;

/// Allocations of this process until one fails.
long untilFailure = Never;
long allocations = 0;

} // namespace

/// Replaces the operator of the standard library, also for allocations in Core and Parallel. It is
/// not inline, because the compiler would complain that `free` does not belong to `new`.
[[gnu::noinline]] void* operator new(std::size_t size)
{
  if (size >= SmallestFailure)
  {
    ++allocations;
    if (untilFailure != Never && untilFailure-- == 0)
    {
      untilFailure = Never;
      throw std::bad_alloc();
    }
  }
  if (void* memory = std::malloc(std::max<std::size_t>(size, 1)))
  {
    return memory;
  }
  throw std::bad_alloc();
}

[[gnu::noinline]] void operator delete(void* memory) noexcept
{
  std::free(memory);
}

[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}

namespace
{

MultiVector ValuesAt(const std::vector<Vec3>& points)
{
  MultiVector values(static_cast<Id>(points.size()), 1);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    values(static_cast<Id>(k), 0) = std::sin(5.0 * points[k][0]) + points[k][1];
  }
  return values;
}

SolveReport Solve(const Communicator& ranks, const TriangleMesh& own, bool hasHats)
{
  const RankSurface surface(ranks, own, Options(4), hasHats);
  PoissonOptions poisson;
  poisson.screeningWeight = 0.05;
  poisson.multigrid.threads = 1;
  poisson.solve.tolerance = 1e-3; // two iterations: later ones allocate the same as the second
  const PoissonSolution solution = SolveScreened(surface.Levels(), ValuesAt(own.points), poisson);
  surface.Levels().ValuesAtPoints(solution.coefficients);
  return solution.report;
}

} // namespace

class RankFailures : public ::testing::TestWithParam<bool>
{
};

TEST_P(RankFailures, AnyAllocationOfOneRankFailsOnAll)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const int failing = ranks.Size() - 1;
  const TriangleMesh mesh = Surfaces().front().mesh;
  const TriangleMesh own =
    PartOf(mesh, Deal(mesh, Dealing::Contiguous, ranks.Size()), ranks.Rank());
  const auto solve = [&] { return Solve(ranks, own, GetParam()); };
  solve();
  allocations = 0;
  ASSERT_TRUE(solve().converged);
  auto most = static_cast<double>(ranks.Rank() == failing ? allocations : 0);
  ranks.Maximum(&most, 1);
  ASSERT_GT(most, 100.0);
  for (long k = 0; k < static_cast<long>(most); ++k)
  {
    SCOPED_TRACE("allocation " + std::to_string(k) + " of " + std::to_string(long(most)));
    untilFailure = ranks.Rank() == failing ? k : Never;
    int failed = -1;
    try
    {
      ranks.Guard(solve);
    }
    catch (const RankFailure& failure)
    {
      failed = failure.rank;
    }
    EXPECT_EQ(failed, failing);
    untilFailure = Never;
  }
  EXPECT_TRUE(solve().converged);
}

INSTANTIATE_TEST_SUITE_P(Spaces, RankFailures, ::testing::Bool(),
  [](const auto& hasHats) { return hasHats.param ? "Hats" : "Grid"; });
