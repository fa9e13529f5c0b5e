// The depth for a wanted error, with invented errors.
#include "Solvers/DepthSearch.h"

#include "Grid/Grid.h"
#include "Meshes.h"

#include <gtest/gtest.h>

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
    search.Judge(mesh, errorsAt(search.Depth()), wanted);
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
  }
}
