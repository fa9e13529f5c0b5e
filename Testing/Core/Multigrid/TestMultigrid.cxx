// The cycle alone, on matrices without a mesh.
#include "Base/Errors.h"
#include "Dense.h"
#include "Krylov/ConjugateGradients.h"
#include "Largest.h"
#include "SampledHierarchy.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gridfem
{
namespace
{

using testing::Dense;
using testing::DenseSolution;
using testing::RandomValues;
using testing::RelativeDifference;

Multigrid Make(const std::vector<testing::Sample>& samples, int depth,
  const MultigridOptions& options, double mass = 1.0, double stiffness = 1.0, int coarsestDepth = 1)
{
  return Multigrid(
    testing::SampledHierarchy(samples, depth, coarsestDepth, mass, stiffness), options);
}

MultiVector Applied(const SparseMatrix& A, const MultiVector& x)
{
  MultiVector y;
  Multiply(A, x, y);
  return y;
}

/// Energy norm of the error after each cycle, from a random error with A x = 0.
std::vector<double> ErrorHistory(const Multigrid& multigrid, int cycles)
{
  const SparseMatrix& A = multigrid.Matrix();
  MultiVector x = RandomValues(A.rows, 1);
  const MultiVector b = MultiVector::Zero(A.rows, 1);
  std::vector<double> history;
  for (int cycle = 0; cycle <= cycles; ++cycle)
  {
    const double energy = x.cwiseProduct(Applied(A, x)).sum();
    history.push_back(std::sqrt(energy < 0.0 ? 0.0 : energy)); // below 0 by rounding; NaN stays
    multigrid.Cycle(b, x);
  }
  return history;
}

double WorstReduction(const Multigrid& multigrid)
{
  const std::vector<double> history = ErrorHistory(multigrid, 8);
  const double rounding =
    1e-7 * history.front(); // the root of the energy's rounding, with a margin
  double worst = 0.0;
  for (std::size_t i = 1; i < history.size() && !(history[i - 1] <= rounding); ++i)
  {
    worst = gridfem::testing::Larger(worst, history[i] / history[i - 1]);
  }
  return worst;
}

TEST(Multigrid, LevelsObeyTheGalerkinIdentity)
{
  for (const auto& samples : { testing::SolidCube(3), testing::TiltedPlane(3, 0.4, 0.6) })
  {
    const Multigrid multigrid = Make(samples, 3, {}, 0.3, 1.0);
    for (std::size_t l = 0; l + 1 < multigrid.Levels().size(); ++l)
    {
      const MultigridLevel& level = multigrid.Levels()[l];
      const Eigen::MatrixXd P = Dense(level.prolongation);
      EXPECT_EQ(Dense(level.restriction), P.transpose());
      const Eigen::MatrixXd coarse = Dense(multigrid.Levels()[l + 1].A);
      EXPECT_LT(
        (P.transpose() * Dense(level.A) * P - coarse).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
        1e-13 * coarse.cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
    }
  }
}

TEST(Multigrid, OneLevelIsADirectSolve)
{
  const Multigrid multigrid = Make(testing::SolidCube(2), 2, {}, 1.0, 1.0, 2);
  const MultiVector exact = RandomValues(multigrid.Matrix().rows, 2);
  MultiVector x;
  multigrid.Precondition(Applied(multigrid.Matrix(), exact), x);
  // The condition number is below 1e3.
  EXPECT_LT(RelativeDifference(x, exact), 1e-12);
}

TEST(Multigrid, TwoLevelsReproduceTheTextbook)
{
  MultigridOptions options;
  options.smoother = SmootherType::GaussSeidel;
  options.preSweeps = 2;
  options.postSweeps = 1;
  const Multigrid multigrid = Make(testing::SolidCube(2), 2, options);
  const MultigridLevel& fine = multigrid.Levels()[0];
  const MultiVector b = RandomValues(fine.A.rows, 1, 1);
  MultiVector x = RandomValues(fine.A.rows, 1, 2);
  MultiVector expected = x;
  fine.smoother->Sweep(fine.A, b, expected, SweepDirection::Forward, 1);
  fine.smoother->Sweep(fine.A, b, expected, SweepDirection::Forward, 1);
  const Eigen::MatrixXd P = Dense(fine.prolongation);
  const Eigen::MatrixXd residual = b - Applied(fine.A, expected);
  expected += P * DenseSolution(Dense(multigrid.Levels()[1].A), P.transpose() * residual);
  fine.smoother->Sweep(fine.A, b, expected, SweepDirection::Backward, 1);
  multigrid.Cycle(b, x);
  EXPECT_LT(RelativeDifference(x, expected), 1e-13);
}

TEST(Multigrid, NestedIterationReproducesTheTextbook)
{
  const Multigrid multigrid = Make(testing::SolidCube(3), 3, {});
  ASSERT_EQ(multigrid.Levels().size(), 3u);
  const Eigen::MatrixXd P0 = Dense(multigrid.Levels()[0].prolongation);
  const Eigen::MatrixXd P1 = Dense(multigrid.Levels()[1].prolongation);
  const MultiVector b = RandomValues(multigrid.Matrix().rows, 2);
  const MultiVector load = P0.transpose() * b;
  MultiVector middle = P1 * DenseSolution(Dense(multigrid.Levels()[2].A), P1.transpose() * load);
  auto levels = testing::SampledHierarchy(testing::SolidCube(3), 3, 1, 1.0, 1.0);
  levels.erase(levels.begin());
  Multigrid(std::move(levels), {}).Cycle(load, middle);
  MultiVector x;
  multigrid.NestedIteration(b, x);
  EXPECT_LT(RelativeDifference(x, P0 * middle), 1e-13);

  const Multigrid direct = Make(testing::SolidCube(2), 2, {}, 1.0, 1.0, 2);
  const MultiVector exact = RandomValues(direct.Matrix().rows, 1);
  direct.NestedIteration(Applied(direct.Matrix(), exact), x);
  EXPECT_LT(RelativeDifference(x, exact), 1e-12);
  EXPECT_THROW(direct.NestedIteration(MultiVector::Zero(3, 1), x), InvalidInput);
}

struct Variant
{
  CycleType cycle;
  SmootherType smoother;
  int sweeps;
};

class Variants : public ::testing::TestWithParam<Variant>
{
protected:
  static MultigridOptions Options(int threads = 1)
  {
    MultigridOptions options;
    options.cycle = GetParam().cycle;
    options.smoother = GetParam().smoother;
    options.preSweeps = options.postSweeps = GetParam().sweeps;
    options.threads = threads;
    return options;
  }

  /// Single precision is used if the numbers allow it, as they do here.
  static bool IsSingle() { return GetParam().smoother == SmootherType::Patch; }
};

TEST_P(Variants, PreconditionerIsSymmetric)
{
  for (const double mass : { 0.0, 0.01 })
  {
    const Multigrid multigrid = Make(testing::TiltedPlane(5, 2.3, 0.7), 5, Options(), mass);
    const MultiVector a = RandomValues(multigrid.Matrix().rows, 1, 1);
    const MultiVector b = RandomValues(multigrid.Matrix().rows, 1, 2);
    MultiVector Ba;
    MultiVector Bb;
    multigrid.Precondition(a, Ba);
    multigrid.Precondition(b, Bb);
    // The worst rounding comes from local inverses of 1e10 times 1e-16, and only in directions of
    // little weight. In single precision it is 6e-8 of each number.
    EXPECT_LT(std::abs(b.cwiseProduct(Ba).sum() - a.cwiseProduct(Bb).sum()),
      (IsSingle() ? 1e-7 : 1e-9) * b.norm() * Ba.norm());
    EXPECT_GT(a.cwiseProduct(Ba).sum(), 0.0);
  }
}

TEST_P(Variants, PreconditionerIsACycleFromZero)
{
  const Multigrid multigrid = Make(testing::SolidCube(3), 3, Options());
  const MultiVector b = RandomValues(multigrid.Matrix().rows, 3);
  MultiVector x = MultiVector::Zero(b.rows(), b.cols());
  MultiVector Bb = RandomValues(2, 1); // its previous contents must not matter
  multigrid.Cycle(b, x);
  multigrid.Precondition(b, Bb);
  EXPECT_EQ(x, Bb);
}

TEST_P(Variants, ThreadsDoNotChangeABit)
{
  const auto samples = testing::TiltedPlane(6, 2.3, 0.7);
  const Multigrid one = Make(samples, 6, Options(1));
  const Multigrid two = Make(samples, 6, Options(2));
  for (const int width : { 1, 3 })
  {
    const MultiVector b = RandomValues(one.Matrix().rows, width);
    MultiVector x1;
    MultiVector x2;
    one.Precondition(b, x1);
    two.Precondition(b, x2);
    EXPECT_EQ(x1, x2);
  }
}

TEST_P(Variants, ColumnsDoNotSeeEachOther)
{
  const Multigrid multigrid = Make(testing::SolidCube(3), 3, Options());
  for (const int width : { 2, 4, 9 })
  {
    const MultiVector b = RandomValues(multigrid.Matrix().rows, width);
    MultiVector together;
    multigrid.Precondition(b, together);
    for (Id c = 0; c < width; ++c)
    {
      MultiVector alone;
      multigrid.Precondition(b.col(c), alone);
      // Sums in another order, a few hundred operations deep.
      EXPECT_LT(RelativeDifference(together.col(c), alone), IsSingle() ? 1e-6 : 1e-12);
    }
  }
}

TEST_P(Variants, ReductionDoesNotDependOnTheSize)
{
  const double small = WorstReduction(Make(testing::SolidCube(2), 2, Options(), 1e-3));
  const double large = WorstReduction(Make(testing::SolidCube(4), 4, Options(), 1e-3));
  EXPECT_LT(small, 0.4);
  EXPECT_LT(large, 0.4);
}

TEST_P(Variants, SingularSystemsConvergeToo)
{
  // Pure Neumann problem: the energy does not see constants.
  EXPECT_LT(WorstReduction(Make(testing::SolidCube(4), 4, Options(0), 0.0)), 0.4);
}

TEST_P(Variants, ZeroRowsAreHarmless)
{
  const Multigrid multigrid = Make(testing::FlatSquare(5), 5, Options(), 1e-3);
  EXPECT_LT(WorstReduction(multigrid), 0.4);
}

TEST_P(Variants, MassMatricesConverge)
{
  EXPECT_LT(WorstReduction(Make(testing::SolidCube(4), 4, Options(), 1.0, 0.0)), 0.4);
}

INSTANTIATE_TEST_SUITE_P(All, Variants,
  ::testing::Values(Variant{ CycleType::V, SmootherType::Patch, 1 },
    Variant{ CycleType::W, SmootherType::Patch, 1 },
    Variant{ CycleType::V, SmootherType::GaussSeidel, 2 },
    Variant{ CycleType::W, SmootherType::GaussSeidel, 2 }),
  [](const auto& test)
  {
    return std::string(test.param.cycle == CycleType::V ? "V" : "W") +
           (test.param.smoother == SmootherType::Patch ? "Patch" : "GaussSeidel");
  });

TEST(Multigrid, PatchesBeatGaussSeidelOnATiltedPlane)
{
  // The reason for the patch smoother: functions on a surface are nearly dependent.
  MultigridOptions options;
  const auto samples = testing::TiltedPlane(6, 2.37, 0.02);
  const std::vector<double> patch = ErrorHistory(Make(samples, 6, options, 1e-3), 10);
  options.smoother = SmootherType::GaussSeidel;
  const std::vector<double> gaussSeidel = ErrorHistory(Make(samples, 6, options, 1e-3), 10);
  EXPECT_LT(10.0 * patch.back() / patch.front(), gaussSeidel.back() / gaussSeidel.front());
}

TEST(Multigrid, UpdateEqualsANewHierarchy)
{
  const auto samples = testing::TiltedPlane(5, 1.3, 0.7);
  Multigrid updated = Make(samples, 5, {}, 1.0);
  const Multigrid fresh = Make(samples, 5, {}, 0.01);
  updated.Update([&](std::size_t l, SparseMatrix& A) { A = fresh.Levels()[l].A; });
  const MultiVector b = RandomValues(fresh.Matrix().rows, 2);
  MultiVector x;
  MultiVector y;
  updated.Precondition(b, x);
  fresh.Precondition(b, y);
  EXPECT_EQ(x, y);
}

TEST(Multigrid, NoSweepsAtAllIsTheCoarseCorrection)
{
  MultigridOptions options;
  options.preSweeps = options.postSweeps = 0;
  const Multigrid multigrid = Make(testing::SolidCube(2), 2, options);
  const Eigen::MatrixXd P = Dense(multigrid.Levels()[0].prolongation);
  const MultiVector b = RandomValues(multigrid.Matrix().rows, 1);
  MultiVector x;
  multigrid.Precondition(b, x);
  const MultiVector expected = P * DenseSolution(Dense(multigrid.Levels()[1].A), P.transpose() * b);
  EXPECT_LT(RelativeDifference(x, expected), 1e-13);
}

TEST(Multigrid, BrokenInputIsRefused)
{
  EXPECT_THROW(Multigrid({}, {}), InvalidInput);
  MultigridOptions options;
  options.preSweeps = -1;
  EXPECT_THROW(Make(testing::SolidCube(1), 1, options), InvalidInput);
  auto levels = testing::SampledHierarchy(testing::SolidCube(2), 2, 1, 1.0, 1.0);
  SparseMatrix narrow = levels[0].prolongation;
  narrow.columns -= 1;
  levels[0].prolongation = narrow;
  EXPECT_THROW(Multigrid(std::move(levels), {}), InvalidInput);
  const Multigrid multigrid = Make(testing::SolidCube(1), 1, {});
  MultiVector x(3, 1);
  EXPECT_THROW(multigrid.Precondition(MultiVector::Zero(3, 1), x), InvalidInput);
  EXPECT_THROW(multigrid.Cycle(MultiVector::Zero(27, 1), x), InvalidInput);
}

} // namespace
} // namespace gridfem
