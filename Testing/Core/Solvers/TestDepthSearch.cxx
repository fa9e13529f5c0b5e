// The depth for a wanted error, with invented errors.
#include "Solvers/DepthSearch.h"

#include "Grid/Grid.h"
#include "Meshes.h"

#include "Solvers/MemoryEstimate.h"

#include <gtest/gtest.h>

#ifdef __linux__
#include "MemoryLimit.h"
#endif

#include <cmath>
#include <vector>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

SolutionAccuracy Errors(double discretization, bool isTrusted)
{
  SolutionAccuracy errors;
  errors.discretization = discretization;
  errors.isTrusted = isTrusted;
  return errors;
}

/// The depths that are tried if the error is known at every depth.
template<class ErrorsAt>
std::vector<int> DepthsTried(double wanted, ErrorsAt&& errorsAt)
{
  const TriangleMesh mesh = GeodesicSphere(4);
  std::vector<int> tried;
  DepthSearch search;
  while (tried.empty() || tried.back() != search.Depth())
  {
    tried.push_back(search.Depth());
    search.Judge(mesh, errorsAt(search.Depth()), wanted, FunctionKind::Grid);
  }
  EXPECT_TRUE(search.IsFound());
  return tried;
}

} // namespace

TEST(DepthSearch, GoesToTheDepthOfAnErrorOfSecondOrderAtOnce)
{
  const auto errors = [](int depth) { return Errors(std::pow(0.25, depth), true); };
  EXPECT_EQ(DepthsTried(0.01, errors), std::vector<int>({ 5 }));
  EXPECT_EQ(DepthsTried(std::pow(0.25, 7), errors), std::vector<int>({ 5, 7 }));
}

TEST(DepthSearch, GoesInStepsWhereMuchIsWanted)
{
  const auto errors = [](int depth) { return Errors(depth < 7 ? 0.5 : 1e-6, true); };
  EXPECT_EQ(DepthsTried(1e-5, errors), std::vector<int>({ 5, 7 }));
}

TEST(DepthSearch, TakesAnErrorThatIsNotTrustedTwiceOnly)
{
  const auto errors = [](int) { return Errors(1e-4, false); };
  EXPECT_EQ(DepthsTried(0.01, errors), std::vector<int>({ 5, 6 }));
}

TEST(DepthSearch, GoesOnStepByStepWhereNothingIsKnown)
{
  const auto errors = [](int depth) { return depth < 7 ? SolutionAccuracy{} : Errors(1e-4, true); };
  EXPECT_EQ(DepthsTried(0.01, errors), std::vector<int>({ 5, 6, 7 }));
}

TEST(DepthSearch, EndsWhereTheErrorDoesNotFall)
{
  const std::vector<int> tried = DepthsTried(1e-3, [](int) { return Errors(0.5, true); });
  EXPECT_LE(tried.back(), MaximumDepth);
  for (std::size_t i = 1; i < tried.size(); ++i)
  {
    EXPECT_GT(tried[i], tried[i - 1]);
  }
}

/// An error that no level confirms counts only if the depth before had a small error, too.
TEST(DepthSearch, ReachesAnErrorThatIsTrustedOrSmallTwice)
{
  const TriangleMesh mesh = GeodesicSphere(4);
  const auto isReached = [&](double first, double second, bool isTrusted)
  {
    DepthSearch search;
    search.Judge(mesh, Errors(first, isTrusted), 0.01, FunctionKind::Grid);
    if (!search.IsFound())
    {
      EXPECT_FALSE(search.IsReached());
      search.Judge(mesh, Errors(second, isTrusted), 0.01, FunctionKind::Grid);
    }
    return search.IsReached();
  };
  EXPECT_TRUE(isReached(0.005, 0.005, true));
  EXPECT_TRUE(isReached(0.02, 0.005, true));
  EXPECT_TRUE(isReached(0.005, 0.004, false));
  EXPECT_FALSE(isReached(0.02, 0.005, false));
  EXPECT_FALSE(isReached(std::nan(""), 0.005, false));
}

#ifdef __linux__
/// Returns the depth after this depth if a process may take `room` bytes.
int DepthWithin(double room, const TriangleMesh& mesh, FunctionKind kind)
{
  const MemoryLimit limit(room);
  DepthSearch search;
  search.Judge(mesh, Errors(std::pow(0.25, 5), true), std::pow(0.25, 7), kind);
  return search.Depth();
}

TEST(DepthSearch, GoesOnlyWhereFunctionsOfItsKindFitIntoMemory)
{
  const TriangleMesh mesh = GeodesicSphere(4);
  const auto bytesAt = [&](int depth, FunctionKind kind)
  {
    const MemoryEstimate grid = EstimateMemory(mesh, depth);
    return grid.bytes +
           (kind == FunctionKind::SmoothGrid ? EstimateSmoothMemory(grid.functions) : 0.0);
  };
  const double room = std::sqrt(
    bytesAt(7, FunctionKind::Grid) * bytesAt(7, FunctionKind::SmoothGrid)); // between the two
  ASSERT_GT(room, 1.2 * bytesAt(7, FunctionKind::Grid));
  ASSERT_LT(room, bytesAt(7, FunctionKind::SmoothGrid) / 1.2);
  EXPECT_EQ(DepthWithin(room, mesh, FunctionKind::Grid), 7);
  EXPECT_LT(DepthWithin(room, mesh, FunctionKind::SmoothGrid), 7);
}

/// A depth on the way fits, although the depth that the errors ask for does not.
TEST(DepthSearch, GoesAsNearToTheDepthOfModesAsFitsIntoMemory)
{
  const TriangleMesh mesh = GeodesicSphere(4);
  const double room = std::sqrt(EstimateMemory(mesh, 8).bytes * EstimateMemory(mesh, 9).bytes);
  const MemoryLimit limit(room);
  EXPECT_EQ(NextDepthForModes(mesh, { 0.9 }, true, 7, 1e-3, FunctionKind::Grid), 8);
  EXPECT_EQ(NextDepthForModes(mesh, { 0.9 }, true, 8, 1e-3, FunctionKind::Grid), 8);
}
#endif

TEST(DepthSearch, FindsModesBetweenItsBounds)
{
  const TriangleMesh mesh = GeodesicSphere(10);
  int last = MinimumDepth;
  for (const double accuracy : { 0.1, 0.01, 0.001 })
  {
    const int first = FirstDepthForModes(mesh, 20, accuracy, FunctionKind::Grid);
    EXPECT_GE(first, last);
    last = first;
    const auto next = [&](const std::vector<double>& errors, bool isConfirmed)
    { return NextDepthForModes(mesh, errors, isConfirmed, first, accuracy, FunctionKind::Grid); };
    EXPECT_EQ(next({ 0.5 * accuracy, accuracy }, true), first);
    EXPECT_EQ(next({ 0.5 * accuracy, accuracy }, false), first + 1);
    EXPECT_EQ(next({ 4.0 * accuracy }, true), first + 1);
    EXPECT_EQ(next({ 1e4 * accuracy }, true), first + 2) << "errors of coarse grids say little";
  }
}
