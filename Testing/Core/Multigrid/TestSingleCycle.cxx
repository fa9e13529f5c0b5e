// The cycle in single precision, against the one in double, and who decides between the two.
#include "Base/Errors.h"
#include "Discretisation.h"
#include "Krylov/Lobpcg.h"
#include "Meshes.h"
#include "Problems/Spectrum.h"
#include "Problems/SpectrumCycle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace gridfem
{
namespace
{

using namespace gridfem::testing;

constexpr double Shift = 0.01;

SingleCycle MakeSingle(const Discretisation& on, int threads = 0)
{
  return SingleCycle(BuildMultigridLevels(ViewOf(on.space, on.system), Shift, 1.0, {}), threads);
}

Multigrid MakeDouble(const Discretisation& on)
{
  return BuildMultigrid(ViewOf(on.space, on.system), Shift, 1.0, MultigridOptions{ CycleType::V });
}

MultiVector RandomBlock(Id rows, Id columns)
{
  std::mt19937_64 generator(3);
  MultiVector X(rows, columns);
  for (Id k = 0; k < X.size(); ++k)
  {
    X.data()[k] = static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0;
  }
  return X;
}

/// The preconditioner on a block that is stored.
template<class Real>
ResidualMeasures Apply(
  const BlockPreconditioner<Real>& precondition, const Vectors<Real>& r, Vectors<Real>& z)
{
  z.resize(r.rows(), r.cols());
  const RowSource<Real> source{ r.rows(), r.cols(),
    [&r](Id begin, Id end, Block<Real> part) { part = r.middleRows(begin, end - begin); } };
  return precondition(
    source, [](const ResidualMeasures&) { return true; },
    [&z](Id begin, Id end, const ConstBlock<Real>& part)
    { z.middleRows(begin, end - begin) = part; });
}

template<class Real>
ResidualMeasures Apply(
  const SingleCycle& cycle, std::size_t level, const Vectors<Real>& r, Vectors<Real>& z)
{
  return Apply<Real>(
    [&](const RowSource<Real>& source, const CorrectionTest& isWanted, const RowSink<Real>& sink)
    { return cycle.Apply(level, source, isWanted, sink); },
    r, z);
}

/// A box whose faces lie between planes of the grid.
TriangleMesh TiltedBox(double degrees)
{
  TriangleMesh box = Box(1);
  for (Vec3& point : box.points)
  {
    point = point.cwiseProduct(Vec3(1.0, 0.83, 0.41));
  }
  return Transform(box, { 1, 1, 1 }, degrees * std::acos(-1.0) / 180.0);
}

TEST(SingleCycle, IsTheDoubleOneUpToSinglePrecision)
{
  const Discretisation on = Discretise(Torus(64, 32, 1.0, 0.4), 5);
  const SingleCycle single = MakeSingle(on);
  const Multigrid multigrid = MakeDouble(on);
  EXPECT_TRUE(single.IsReliable());
  for (const std::size_t level : { 0, 1 })
  {
    for (const Id columns : { 1, 16, 17, 32 })
    {
      const MultiVector r = RandomBlock(on.space.levels[level].numberOfFunctions, columns);
      MultiVector z;
      MultiVector reference;
      const ResidualMeasures mine = Apply(single, level, r, z);
      const ResidualMeasures exact =
        Apply<double>(CyclePreconditioner<double>(multigrid, level), r, reference);
      // Patches have pivots down to 1e-5, whose root times 6e-8 is 2e-5, and corrections add up.
      EXPECT_LT((z - reference).norm(), 1e-3 * reference.norm());
      EXPECT_LT((mine.energy - exact.energy).norm(), 1e-4 * exact.energy.norm());
      EXPECT_LT((mine.norm - exact.norm).norm(), 1e-6 * exact.norm.norm());
    }
  }
}

TEST(SingleCycle, ColumnsKnowNothingOfEachOtherNorOfThreads)
{
  const Discretisation on = Discretise(TrefoilTube(120, 16, 0.12), 5);
  const SingleCycle one = MakeSingle(on, 1);
  const SingleCycle three = MakeSingle(on, 3);
  const MultiVector r = RandomBlock(on.space.Finest().numberOfFunctions, 32);
  MultiVector z;
  MultiVector again;
  const ResidualMeasures measures = Apply(one, 0, r, z);
  const ResidualMeasures sameMeasures = Apply(three, 0, r, again);
  EXPECT_TRUE(z == again);
  EXPECT_TRUE(measures.energy == sameMeasures.energy);
  Apply<double>(one, 0, r.rightCols(20), again);
  EXPECT_TRUE(z.rightCols(20) == again);
}

TEST(SingleCycle, IsTheSameForBlocksInSinglePrecision)
{
  const Discretisation on = Discretise(Torus(64, 32, 1.0, 0.4), 5);
  const SingleCycle cycle = MakeSingle(on);
  const Vectors<float> r = RandomBlock(on.space.Finest().numberOfFunctions, 21).cast<float>();
  Vectors<float> z;
  const ResidualMeasures measures = Apply(cycle, 0, r, z);
  MultiVector wide;
  const ResidualMeasures wideMeasures = Apply<double>(cycle, 0, r.cast<double>(), wide);
  EXPECT_TRUE(z.cast<double>() == wide);
  EXPECT_TRUE(measures.energy == wideMeasures.energy);
  EXPECT_TRUE(measures.norm == wideMeasures.norm);
}

TEST(SingleCycle, HandsOverOnlyWhatIsWanted)
{
  const Discretisation on = Discretise(Torus(64, 32, 1.0, 0.4), 5);
  const SingleCycle single = MakeSingle(on);
  const Multigrid multigrid = MakeDouble(on);
  const MultiVector r = RandomBlock(on.space.Finest().numberOfFunctions, 5);
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
  EXPECT_TRUE(single.Apply(0, source, isWanted, sink).energy == whole.energy);
  EXPECT_TRUE(seen.energy == whole.energy);
  EXPECT_TRUE(seen.norm == whole.norm);
  CyclePreconditioner<double>(multigrid, 0)(source, isWanted, sink);
  EXPECT_EQ(handedOver, 0);
}

TEST(SingleCycle, RefusesMoreColumnsThanItTakes)
{
  const Discretisation on = Discretise(GeodesicSphere(8), 3);
  const SingleCycle single = MakeSingle(on);
  MultiVector z;
  const MultiVector r = RandomBlock(on.space.Finest().numberOfFunctions, 33);
  EXPECT_THROW(Apply(single, 0, r, z), InvalidInput);
}

/// Pivots are about the square of the faces' slope: 3e-6 at 0.1 degrees, 3e-8 at 0.01.
TEST(SingleCycle, IsReliableWhereFunctionsDoNotAlmostVanish)
{
  EXPECT_TRUE(MakeSingle(Discretise(GeodesicSphere(32), 5)).IsReliable());
  EXPECT_TRUE(MakeSingle(Discretise(TiltedBox(0.1), 5)).IsReliable());
  EXPECT_FALSE(MakeSingle(Discretise(TiltedBox(0.01), 5)).IsReliable());
  EXPECT_FALSE(MakeSingle(Discretise(TiltedBox(0.0), 5)).IsReliable());
}

Spectrum Solve(const Discretisation& on, const MultigridOptions& multigrid)
{
  SpectrumOptions options;
  options.numberOfModes = 20;
  options.tolerance = 1e-8;
  options.multigrid = multigrid;
  return ComputeSpectrum(ViewOf(on.space, on.system), options);
}

TEST(SpectrumCycle, IsDoubleWhereSinglePrecisionWouldNotDo)
{
  const MultigridOptions standard{ CycleType::V };
  const Spectrum flat = Solve(Discretise(TiltedBox(0.01), 5), standard);
  EXPECT_TRUE(flat.converged);
  EXPECT_FALSE(flat.singlePrecision);
  const Discretisation sphere = Discretise(GeodesicSphere(32), 5);
  const Spectrum single = Solve(sphere, standard);
  EXPECT_TRUE(single.converged);
  EXPECT_TRUE(single.singlePrecision);
  MultigridOptions twice = standard;
  twice.preSweeps = twice.postSweeps = 2;
  for (const MultigridOptions& other : { MultigridOptions{ CycleType::W }, twice })
  {
    const Spectrum inDouble = Solve(sphere, other);
    EXPECT_TRUE(inDouble.converged);
    EXPECT_FALSE(inDouble.singlePrecision);
    for (std::size_t j = 1; j < single.eigenvalues.size(); ++j)
    {
      // Both stop at an error of 1e-8 of the eigenvalue.
      EXPECT_NEAR(single.eigenvalues[j] / inDouble.eigenvalues[j], 1.0, 2e-8);
    }
  }
}

/// The finest level, without a preconditioner.
template<class Real>
SpectralProblem<Real> ProblemOn(const Discretisation& on, const Constants& constants)
{
  SpectralProblem<Real> problem;
  problem.stiffness = StiffnessMatrix(on.space, on.system);
  problem.mass = MassMatrix(on.space, on.system);
  problem.shift = Shift;
  problem.constants = &constants;
  return problem;
}

/// Some functions of this space have hardly any mass: after some steps in single precision,
/// products of vectors that follow from coefficients are wrong in the second digit.
TEST(BlockIteration, PairsForAFinerLevelAreRenewed)
{
  const Discretisation on = Discretise(TrefoilTube(120, 16, 0.12), 4);
  const SingleCycle cycle = MakeSingle(on);
  const Constants constants(
    MassMatrix(on.space, on.system), on.space.component, on.space.numberOfComponents, 0);
  SpectralProblem<float> problem = ProblemOn<float>(on, constants);
  problem.precondition = [&](const RowSource<float>& r, const CorrectionTest& isWanted,
                           const RowSink<float>& z) { return cycle.Apply(0, r, isWanted, z); };
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
  EXPECT_LT((stiffness - one).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_LT((products.rightCols(72) - one).cwiseAbs().maxCoeff(), 1e-5);
}

/// A preconditioner that is no better than none, with the cycle to fall back to.
TEST(BlockIteration, FallsBackToABetterPreconditionerWhenItStagnates)
{
  const Discretisation on = Discretise(Torus(64, 32, 1.0, 0.4), 5);
  const Multigrid multigrid = MakeDouble(on);
  const Constants constants(
    MassMatrix(on.space, on.system), on.space.component, on.space.numberOfComponents, 0);
  SpectralProblem<double> problem = ProblemOn<double>(on, constants);
  problem.precondition =
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
  problem.fallback = [&]
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
