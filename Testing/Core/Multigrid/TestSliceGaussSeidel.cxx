// Gauss-Seidel over slabs of slices equals successive sweeps [T Fig. 4.3].
#include "Base/Errors.h"
#include "Multigrid/Multigrid.h"
#include "SampledHierarchy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

using testing::RandomValues;

/// A plane that crosses all slices.
MultigridLevel SteepPlane()
{
  return std::move(
    testing::SampledHierarchy(testing::TiltedPlane(6, 3.3, 0.9), 6, 6, 0.1, 1.0).front());
}

/// Whether a slice waits until the slabs are done, in sweep `sweep` (0, 1, ...).
bool IsLeftOut(Index slice, const std::vector<Index>& boundaries, int sweep)
{
  return std::any_of(boundaries.begin(), boundaries.end(),
    [&](Index boundary) { return slice >= boundary - sweep - 1 && slice < boundary + sweep; });
}

/// One plain sweep over all unknowns, slice by slice, starting with the slabs' slices.
std::unique_ptr<Smoother> SequentialSweep(
  const MultigridLevel& level, const std::vector<Index>& boundaries, int sweep)
{
  const std::vector<Index>& slice = level.order.slice;
  std::vector<Index> unknowns(slice.size());
  for (std::size_t i = 0; i < unknowns.size(); ++i)
  {
    unknowns[i] = static_cast<Index>(i);
  }
  std::stable_sort(unknowns.begin(), unknowns.end(),
    [&](Index i, Index j)
    {
      return std::pair(IsLeftOut(slice[i], boundaries, sweep), slice[i]) <
             std::pair(IsLeftOut(slice[j], boundaries, sweep), slice[j]);
    });
  PatchOrder order;
  order.dof.size = 1;
  order.dof.unknown = unknowns;
  order.blockBegin = { 0, static_cast<Id>(unknowns.size()) };
  order.colorBegin = { 0, 1 };
  return MakeGaussSeidel(level.A, order);
}

class SliceGaussSeidel : public ::testing::TestWithParam<int>
{
};

TEST_P(SliceGaussSeidel, EqualsSequentialSweepsBitForBit)
{
  const int sweeps = GetParam();
  const MultigridLevel level = SteepPlane();
  const auto smoother = MakeSliceGaussSeidel(level.A, level.order, sweeps);
  const std::vector<Index> boundaries = SlabBoundaries(level.order.slice, sweeps);
  ASSERT_GE(boundaries.size(), 2u);
  const MultiVector b = RandomValues(level.A.rows, 2, 1);
  MultiVector forward = RandomValues(level.A.rows, 2, 2);
  MultiVector backward = forward;
  const MultiVector start = forward;
  for (int sweep = 0; sweep < sweeps; ++sweep)
  {
    SequentialSweep(level, boundaries, sweep)
      ->Sweep(level.A, b, forward, SweepDirection::Forward, 1);
    SequentialSweep(level, boundaries, sweeps - 1 - sweep)
      ->Sweep(level.A, b, backward, SweepDirection::Backward, 1);
  }
  for (const int threads : { 1, 2, 3 })
  {
    MultiVector x = start;
    smoother->Sweep(level.A, b, x, SweepDirection::Forward, threads);
    EXPECT_EQ(x, forward);
    x = start;
    smoother->Sweep(level.A, b, x, SweepDirection::Backward, threads);
    EXPECT_EQ(x, backward);
  }
}

INSTANTIATE_TEST_SUITE_P(Sweeps, SliceGaussSeidel, ::testing::Values(1, 2, 3, 5));

TEST(SliceGaussSeidelSlabs, SlabsAreHighEnough)
{
  const MultigridLevel level = SteepPlane();
  const auto [lowest, highest] =
    std::minmax_element(level.order.slice.begin(), level.order.slice.end());
  for (const int sweeps : { 1, 4, 20, 1000 })
  {
    std::vector<Index> begin = SlabBoundaries(level.order.slice, sweeps);
    begin.insert(begin.begin(), *lowest);
    begin.push_back(*highest + 1);
    for (std::size_t k = 1; k < begin.size() && begin.size() > 2; ++k)
    {
      EXPECT_GE(begin[k] - begin[k - 1], 2 * sweeps);
    }
  }
  EXPECT_TRUE(SlabBoundaries({}, 1).empty());
}

TEST(SliceGaussSeidelSlabs, CyclesAsTheColoredOneDoes)
{
  MultigridOptions options;
  options.preSweeps = options.postSweeps = 1;
  options.sweepsPerSynchronization = 2;
  options.smoother = SmootherType::SliceGaussSeidel;
  const Multigrid multigrid(
    testing::SampledHierarchy(testing::SolidCube(4), 4, 1, 0.1, 1.0), options);
  const SparseMatrix& A = multigrid.Matrix();
  MultiVector x = RandomValues(A.rows, 1);
  const MultiVector zero = MultiVector::Zero(A.rows, 1);
  const auto energy = [&]
  {
    MultiVector Ax;
    Multiply(A, x, Ax);
    return std::sqrt(x.cwiseProduct(Ax).sum());
  };
  for (int cycle = 0; cycle < 5; ++cycle)
  {
    const double before = energy();
    multigrid.Cycle(zero, x);
    EXPECT_LT(energy(), 0.4 * before); // the bound of TestMultigrid for two colored sweeps
  }
}

TEST(SliceGaussSeidelSlabs, BrokenInputIsRefused)
{
  MultigridLevel level = SteepPlane();
  EXPECT_THROW(MakeSliceGaussSeidel(level.A, level.order, 0), InvalidInput);
  level.order.slice[0] += 5;
  EXPECT_THROW(MakeSliceGaussSeidel(level.A, level.order, 1), InvalidInput);
  level.order.slice.clear();
  EXPECT_THROW(MakeSliceGaussSeidel(level.A, level.order, 1), InvalidInput);
}

} // namespace
} // namespace gridfem
