// Hierarchies in single precision against hierarchies in double precision, and the choice between
// the two.
#include "Algebra/BlockVectors.h"
#include "ApplyRows.h"
#include "Base/Errors.h"
#include "Base/Parallel.h"
#include "Discretization.h"
#include "Krylov/Lobpcg.h"
#include "Meshes.h"
#include "Spectrum/Spectrum.h"
#include "Spectrum/SpectrumCycle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

namespace gridfem
{
namespace
{

using namespace gridfem::testing;
using gridfem::testing::Apply; // beside the overload below

constexpr double Shift = 0.01;

using SingleMultigrid = BasicMultigrid<float>;

constexpr MultigridOptions Standard{ CycleType::V };

template<class Hierarchy, class = void>
constexpr bool HasCycle = false;

template<class Hierarchy>
constexpr bool HasCycle<Hierarchy,
  std::void_t<decltype(&Hierarchy::Cycle), decltype(&Hierarchy::InDoublePrecision)>> = true;

static_assert(HasCycle<Multigrid> && !HasCycle<SingleMultigrid>);

SingleMultigrid MakeSingle(const Discretization& on, const MultigridOptions& options = Standard)
{
  return SingleMultigrid(
    BuildMultigridLevels(ViewOf(on.space, on.system), Shift, 1.0, options), options);
}

SingleMultigrid MakeSingle(const Discretization& on, int threads)
{
  MultigridOptions options = Standard;
  options.threads = threads;
  return MakeSingle(on, options);
}

Multigrid MakeDouble(const Discretization& on, const MultigridOptions& options = Standard)
{
  return BuildMultigrid(ViewOf(on.space, on.system), Shift, 1.0, options);
}

/// W cycles, and more or fewer sweeps.
std::vector<MultigridOptions> OtherCycles()
{
  std::vector<MultigridOptions> all(3, Standard);
  all[0].cycle = CycleType::W;
  all[1].preSweeps = all[1].postSweeps = 2;
  all[2].preSweeps = all[2].postSweeps = 0;
  return all;
}

template<class Real>
ResidualMeasures Apply(
  const SingleMultigrid& cycle, std::size_t level, const Vectors<Real>& r, Vectors<Real>& z)
{
  return Apply<Real>(CyclePreconditioner<Real>(cycle, level), r, z);
}

/// A box whose faces lie between planes of the grid.
TriangleMesh TiltedBox(double degrees)
{
  return Transform(
    Box(1, { 0, 0, 0 }, { 1.0, 0.83, 0.41 }), { 1, 1, 1 }, degrees * std::acos(-1.0) / 180.0);
}

TEST(SingleMultigrid, IsTheDoubleOneUpToSinglePrecision)
{
  const Discretization on = Discretize(Torus(64, 32, 1.0, 0.4), 5);
  const SingleMultigrid single = MakeSingle(on);
  const Multigrid multigrid = MakeDouble(on);
  EXPECT_TRUE(single.IsReliable());
  for (const std::size_t level : { 0, 1 })
  {
    for (const Id columns : { 1, 16, 17, 32 })
    {
      const MultiVector r = RandomColumns(on.space.levels[level].numberOfFunctions, columns);
      MultiVector z;
      MultiVector reference;
      const ResidualMeasures mine = Apply(single, level, r, z);
      const ResidualMeasures exact =
        Apply<double>(CyclePreconditioner<double>(multigrid, level), r, reference);
      // Patches have pivots down to 1e-5. The square root times 6e-8 is 2e-5, and corrections add
      // up.
      EXPECT_LT((z - reference).norm(), 1e-3 * reference.norm());
      EXPECT_LT((mine.energy - exact.energy).norm(), 1e-4 * exact.energy.norm());
      EXPECT_LT((mine.norm - exact.norm).norm(), 1e-6 * exact.norm.norm());
    }
  }
}

/// The energy follows from half of the cycle and equals the energy of the whole cycle.
TEST(SingleMultigrid, EveryCycleKnowsItsEnergy)
{
  const Discretization on = Discretize(Torus(64, 32, 1.0, 0.4), 5);
  const MultiVector r = RandomColumns(on.space.Finest().numberOfFunctions, 5);
  for (const MultigridOptions& options : OtherCycles())
  {
    const SingleMultigrid single = MakeSingle(on, options);
    MultigridOptions inDouble = options;
    inDouble.precision = FactorPrecision::Double;
    const Multigrid exact = MakeDouble(on, inDouble);
    const Multigrid mixed = MakeDouble(on, options);
    MultiVector reference;
    Apply<double>(CyclePreconditioner<double>(exact, 0), r, reference);
    const Eigen::VectorXd energy = r.cwiseProduct(reference).colwise().sum();
    const auto check = [&](const BlockPreconditioner<double>& precondition, double tolerance)
    {
      MultiVector z;
      const ResidualMeasures measures = Apply(precondition, r, z);
      EXPECT_LT((z - reference).norm(), 10.0 * tolerance * reference.norm());
      EXPECT_LT((measures.energy - energy).norm(), tolerance * energy.norm());
    };
    check(CyclePreconditioner<double>(exact, 0), 1e-11);
    check(CyclePreconditioner<double>(mixed, 0), 1e-4);
    check(CyclePreconditioner<double>(single, 0), 1e-4);
  }
}

TEST(SingleMultigrid, ColumnsKnowNothingOfEachOtherNorOfThreads)
{
  const Discretization on = Discretize(TrefoilTube(120, 16, 0.12), 5);
  const SingleMultigrid one = MakeSingle(on, 1);
  const SingleMultigrid three = MakeSingle(on, 3);
  const MultiVector r = RandomColumns(on.space.Finest().numberOfFunctions, 32);
  MultiVector z;
  MultiVector again;
  const ResidualMeasures measures = Apply(one, 0, r, z);
  const ResidualMeasures sameMeasures = Apply(three, 0, r, again);
  EXPECT_TRUE(z == again);
  EXPECT_TRUE(measures.energy == sameMeasures.energy);
  Apply<double>(one, 0, r.rightCols(20), again);
  EXPECT_TRUE(z.rightCols(20) == again);
}

TEST(SingleMultigrid, IsTheSameForBlocksInSinglePrecision)
{
  const Discretization on = Discretize(Torus(64, 32, 1.0, 0.4), 5);
  const SingleMultigrid cycle = MakeSingle(on);
  const Vectors<float> r = RandomColumns(on.space.Finest().numberOfFunctions, 21).cast<float>();
  Vectors<float> z;
  const ResidualMeasures measures = Apply(cycle, 0, r, z);
  MultiVector wide;
  const ResidualMeasures wideMeasures = Apply<double>(cycle, 0, r.cast<double>(), wide);
  EXPECT_TRUE(z.cast<double>() == wide);
  EXPECT_TRUE(measures.energy == wideMeasures.energy);
  EXPECT_TRUE(measures.norm == wideMeasures.norm);
}

TEST(SingleMultigrid, HandsOverOnlyWhatIsWanted)
{
  const Discretization on = Discretize(Torus(64, 32, 1.0, 0.4), 5);
  const SingleMultigrid single = MakeSingle(on);
  const Multigrid multigrid = MakeDouble(on);
  const MultiVector r = RandomColumns(on.space.Finest().numberOfFunctions, 5);
  const RowSource<double> source{ r.rows(), r.cols(),
    [&r](Id begin, Id end, Block<double> part) { part = r.middleRows(begin, end - begin); } };
  int handedOver = 0;
  ResidualMeasures seen;
  const CorrectionTest isWanted = [&](const ResidualMeasures& measures)
  {
    seen = measures;
    return false;
  };
  const RowSink<double> sink = [&](Id, Id, const ConstBlock<double>&) { ++handedOver; };
  MultiVector z;
  const ResidualMeasures whole = Apply(single, 0, r, z);
  EXPECT_TRUE(
    CyclePreconditioner<double>(single, 0)(source, isWanted, sink).energy == whole.energy);
  EXPECT_TRUE(seen.energy == whole.energy);
  EXPECT_TRUE(seen.norm == whole.norm);
  CyclePreconditioner<double>(multigrid, 0)(source, isWanted, sink);
  EXPECT_EQ(handedOver, 0);
}

TEST(SingleMultigrid, RefusesWhatItCannotDo)
{
  const Discretization on = Discretize(GeodesicSphere(8), 3);
  const SingleMultigrid single = MakeSingle(on);
  MultiVector z;
  const MultiVector r = RandomColumns(on.space.Finest().numberOfFunctions, 33);
  EXPECT_THROW(Apply(single, 0, r, z), InvalidInput);
  MultigridOptions options = Standard;
  options.postSweeps = 2; // B is not symmetric
  EXPECT_THROW(Apply<double>(MakeSingle(on, options), 0, r.leftCols(1), z), InvalidInput);
  options = Standard;
  options.smoother = SmootherType::GaussSeidel;
  EXPECT_THROW(MakeSingle(on, options), InvalidInput);
}

/// Pivots are about the square of the faces' slope: 3e-6 at 0.1 degrees, 3e-8 at 0.01.
TEST(SingleMultigrid, IsReliableWhereFunctionsDoNotAlmostVanish)
{
  EXPECT_TRUE(MakeSingle(Discretize(GeodesicSphere(32), 5)).IsReliable());
  EXPECT_TRUE(MakeSingle(Discretize(TiltedBox(0.1), 5)).IsReliable());
  EXPECT_FALSE(MakeSingle(Discretize(TiltedBox(0.01), 5)).IsReliable());
  EXPECT_FALSE(MakeSingle(Discretize(TiltedBox(0.0), 5)).IsReliable());
}

/// Two threads use one hierarchy, at the same time and one after the other.
TEST(SingleMultigrid, SeveralThreadsMayCycleAtTheSameTime)
{
  const Discretization on = Discretize(Torus(64, 32, 1.0, 0.4), 5);
  const SingleMultigrid cycle = MakeSingle(on, 1);
  constexpr int Times = 8;
  std::vector<MultiVector> r(Times);
  std::vector<MultiVector> alone(Times);
  std::vector<MultiVector> together(Times);
  for (int k = 0; k < Times; ++k)
  {
    r[k] = RandomColumns(on.space.Finest().numberOfFunctions, 5 + k);
    Apply(cycle, 0, r[k], alone[k]);
  }
  ParallelBlocks(Times, 2, [&](Id k) { Apply(cycle, 0, r[k], together[k]); });
  EXPECT_TRUE(alone == together);
}

Spectrum Solve(const Discretization& on, const MultigridOptions& multigrid, double tolerance = 1e-8)
{
  SpectrumOptions options;
  options.numberOfModes = 20;
  options.tolerance = tolerance;
  options.multigrid = multigrid;
  return ComputeSpectrum(ViewOf(on.space, on.system), options);
}

TEST(SpectrumCycle, IsDoubleWhereSinglePrecisionWouldNotDoAndSingleForAnyCycle)
{
  const Spectrum flat = Solve(Discretize(TiltedBox(0.01), 5), Standard);
  EXPECT_TRUE(flat.converged);
  EXPECT_FALSE(flat.singlePrecision);
  const Discretization sphere = Discretize(GeodesicSphere(32), 5);
  MultigridOptions others = Standard;
  others.smoother = SmootherType::GaussSeidel;
  const Spectrum inDouble = Solve(sphere, others, 1e-10);
  EXPECT_TRUE(inDouble.converged);
  EXPECT_FALSE(inDouble.singlePrecision);
  std::vector<MultigridOptions> cycles = OtherCycles();
  cycles.back() = Standard; // replaces the cycle without sweeps
  for (const MultigridOptions& options : cycles)
  {
    const Spectrum single = Solve(sphere, options);
    EXPECT_TRUE(single.converged);
    EXPECT_TRUE(single.singlePrecision);
    for (std::size_t j = 1; j < single.eigenvalues.size(); ++j)
    {
      // Errors are estimated.
      EXPECT_NEAR(single.eigenvalues[j] / inDouble.eigenvalues[j], 1.0, 2e-8);
    }
  }
}

TEST(SpectrumCycle, LooksAtHowEveryLevelIsRelaxed)
{
  const Discretization on = Discretize(GeodesicSphere(8), 3);
  std::vector<MultigridLevel> levels =
    BuildMultigridLevels(ViewOf(on.space, on.system), Shift, 1.0, Standard);
  EXPECT_TRUE(FitSinglePrecision(levels, Standard));
  levels.front().smoothing = LevelSmoothing{}; // Gauss-Seidel
  EXPECT_FALSE(FitSinglePrecision(levels, Standard));
  levels.front().smoothing->smoother = SmootherType::Patch;
  EXPECT_TRUE(FitSinglePrecision(levels, Standard));
  levels.back().smoothing = LevelSmoothing{}; // the coarsest level is solved directly
  EXPECT_TRUE(FitSinglePrecision(levels, Standard));
}

/// The eigenproblem of the finest level, without a preconditioner.
template<class Real>
SpectralProblem<Real> ProblemOn(const Discretization& on, const Constants& constants)
{
  SpectralProblem<Real> problem;
  problem.stiffness = StiffnessMatrix(on.space, on.system);
  problem.mass = MassMatrix(on.space, on.system);
  problem.shift = Shift;
  problem.constants = &constants;
  return problem;
}

/// Some functions of this space have hardly any mass. After some steps in single precision,
/// products of vectors that follow from coefficients are wrong in the second digit.
TEST(BlockIteration, PairsForAFinerLevelAreRenewed)
{
  const Discretization on = Discretize(TrefoilTube(120, 16, 0.12), 4);
  const SingleMultigrid cycle = MakeSingle(on);
  const Constants constants(
    MassMatrix(on.space, on.system), on.space.component, on.space.numberOfComponents, 0);
  SpectralProblem<float> problem = ProblemOn<float>(on, constants);
  problem.preconditioner.first = CyclePreconditioner<float>(cycle, 0);
  BlockOptions options;
  options.wanted = 60;
  options.blockSize = 72;
  options.maximumIterations = 6;
  options.measureLast = false;
  EigenPairs<float> pairs;
  BlockWorkspace<float> workspace;
  ImproveEigenPairs<float>(problem, options, {}, pairs, workspace);
  ASSERT_EQ(pairs.values.size(), 72);
  EXPECT_TRUE(pairs.isRenewed);
  const MultiVector X = pairs.vectors.View().cast<double>();
  const Eigen::MatrixXd products = ProjectPair<double>({ X }, problem.stiffness, problem.mass, X);
  const Eigen::VectorXd scale = pairs.values.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd stiffness = scale.asDiagonal() * products.leftCols(72) * scale.asDiagonal();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(72, 72);
  // Sums of products that are rounded to 6e-8.
  EXPECT_LT((stiffness - one).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-5);
  EXPECT_LT((products.rightCols(72) - one).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-5);
}

/// A preconditioner that is no better than none, with the cycle as its fallback.
TEST(BlockIteration, FallsBackToABetterPreconditionerWhenItStagnates)
{
  const Discretization on = Discretize(Torus(64, 32, 1.0, 0.4), 5);
  const Multigrid multigrid = MakeDouble(on);
  const Constants constants(
    MassMatrix(on.space, on.system), on.space.component, on.space.numberOfComponents, 0);
  SpectralProblem<double> problem = ProblemOn<double>(on, constants);
  problem.preconditioner.first =
    [](const RowSource<double>& source, const CorrectionTest&, const RowSink<double>& sink)
  {
    MultiVector r(source.rows, source.columns);
    source.fill(0, source.rows, r);
    sink(0, source.rows, r);
    const Eigen::VectorXd norm = r.colwise().squaredNorm();
    return ResidualMeasures{ norm, norm };
  };
  BlockOptions options;
  options.wanted = 8;
  options.blockSize = 16;
  options.maximumIterations = 60;
  const auto solve = [&]
  {
    EigenPairs<double> pairs;
    BlockWorkspace<double> workspace;
    return ImproveEigenPairs<double>(problem, options, {}, pairs, workspace);
  };
  EXPECT_LT(solve().numberOfConverged, 8);
  int made = 0;
  problem.preconditioner.makeDouble = [&]
  {
    ++made;
    return CyclePreconditioner<double>(multigrid, 0);
  };
  const BlockReport report = solve();
  EXPECT_EQ(report.numberOfConverged, 8);
  EXPECT_EQ(made, 1);
  EXPECT_GT(report.iterations, 20);
}

} // namespace
} // namespace gridfem
