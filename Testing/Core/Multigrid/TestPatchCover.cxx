// Subsets of patches that reach every unknown, and cycles that use them.
#include "Base/Errors.h"
#include "Krylov/ConjugateGradients.h"
#include "Multigrid/PatchCover.h"
#include "SampledHierarchy.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gridfem
{
namespace
{

using testing::RandomVectors;

std::vector<int> PatchesPerUnknown(const PatchOrder& order, Index unknowns)
{
  std::vector<int> count(unknowns, 0);
  for (const auto& group : order.dof)
  {
    for (const Index unknown : group)
    {
      count[std::max(unknown, 0)] += unknown >= 0 ? 1 : 0;
    }
  }
  return count;
}

TEST(PatchCover, ReachesEveryUnknownOftenEnoughInTheSameOrder)
{
  const auto levels = testing::SampledHierarchy(testing::TiltedPlane(5, 3.3, 0.7), 5, 5, 1.0, 1.0);
  const PatchOrder& all = levels.front().order;
  const Index unknowns = levels.front().A.rows;
  const std::vector<int> most = PatchesPerUnknown(all, unknowns);
  for (const int times : { 1, 2, 3, 100 })
  {
    const PatchOrder cover = CoverUnknowns(all, unknowns, times);
    const std::vector<int> count = PatchesPerUnknown(cover, unknowns);
    for (Index i = 0; i < unknowns; ++i)
    {
      EXPECT_GE(count[i], std::min(times, most[i]));
    }
    ASSERT_EQ(cover.blockBegin.size(), all.blockBegin.size());
    EXPECT_EQ(cover.colourBegin, all.colourBegin);
    for (std::size_t block = 0; block + 1 < all.blockBegin.size(); ++block)
    {
      auto next = all.dof.begin() + all.blockBegin[block];
      const auto end = all.dof.begin() + all.blockBegin[block + 1];
      for (Id patch = cover.blockBegin[block]; patch < cover.blockBegin[block + 1]; ++patch)
      {
        next = std::find(next, end, cover.dof[patch]);
        ASSERT_NE(next++, end);
      }
    }
  }
  EXPECT_EQ(CoverUnknowns(all, unknowns, 100).dof, all.dof);
  // Eight functions per patch and four patches per function: once takes at least a quarter.
  EXPECT_LT(2 * CoverUnknowns(all, unknowns, 1).dof.size(), all.dof.size());
  EXPECT_THROW(CoverUnknowns(all, unknowns, 0), InvalidInput);
  EXPECT_THROW(CoverUnknowns(all, 3, 1), InvalidInput);
}

TEST(PatchCover, CyclesWithACoverConverge)
{
  const auto iterations = [](int coverage)
  {
    MultigridOptions options;
    options.coverage = coverage;
    const Multigrid multigrid(
      testing::SampledHierarchy(testing::TiltedPlane(5, 3.3, 0.02), 5, 1, 1e-3, 1.0), options);
    MultiVector b;
    Multiply(multigrid.Matrix(), RandomVectors(multigrid.Matrix().rows, 1), b);
    MultiVector x = MultiVector::Zero(b.rows(), 1);
    const SolveReport report = SolveConjugateGradients(multigrid, b, x, SolveOptions());
    EXPECT_TRUE(report.converged);
    return report.iterations;
  };
  // Half of the work for at most two and a half times the iterations: measured 1.5 to 2.4 times on
  // spheres, cubes and machine parts.
  EXPECT_LE(iterations(1), 2.5 * iterations(0));
  EXPECT_LE(iterations(3), 1.3 * iterations(0));
}

} // namespace
} // namespace gridfem
