// The spectrum on several ranks equals the spectrum of one rank: its values, and its vectors at
// every point.
#include "Krylov/SpectralProblem.h"
#include "Largest.h"
#include "Pieces.h"
#include "Spaces/GridSpace.h"
#include "Spectrum/Spectrum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

SpectrumOptions Modes(int count)
{
  SpectrumOptions options;
  options.numberOfModes = count;
  options.tolerance = 1e-12;
  options.maximumIterations = 300;
  options.multigrid.threads = 1;
  options.multigrid.precision = FactorPrecision::Double;
  return options;
}

struct OnRanks
{
  Spectrum spectrum;
  MultiVector values; // modes at this rank's own points
  std::vector<Id> points;
};

OnRanks SolveOnRanks(const TriangleMesh& mesh, Dealing dealing, const SpectrumOptions& options,
  int depth = 4, bool hasHats = false)
{
  const Communicator ranks(MPI_COMM_WORLD);
  OnRanks result;
  const TriangleMesh own =
    PartOf(mesh, Deal(mesh, dealing, ranks.Size()), ranks.Rank(), &result.points);
  const RankSurface surface(ranks, own, Options(depth), hasHats);
  result.spectrum = ComputeSpectrum(surface.Levels(), options);
  result.values = surface.Levels().ValuesAtPoints(result.spectrum.vectors);
  return result;
}

/// Whether a value is far enough from its neighbors to determine its vector up to the sign.
bool IsSimple(const std::vector<double>& values, std::size_t mode)
{
  constexpr double Gap = 1e-2;
  const double own = values[mode];
  return own > 0.0 && (mode == 0 || own - values[mode - 1] > Gap * own) &&
         mode + 1 < values.size() && values[mode + 1] - own > Gap * own;
}

double LargestDifference(
  const Communicator& ranks, const OnRanks& ours, const MultiVector& theirs, Id mode, double sign)
{
  double difference = 0.0;
  for (std::size_t k = 0; k < ours.points.size(); ++k)
  {
    difference = Larger(difference,
      std::abs(ours.values(static_cast<Id>(k), mode) - sign * theirs(ours.points[k], mode)));
  }
  ranks.Maximum(&difference, 1);
  return difference;
}

/// Compares with the values of one rank, to a relative tolerance, in about as many iterations.
void CompareWithOneRank(const NamedSurface& surface, const SpectrumOptions& options, double part)
{
  SCOPED_TRACE(surface.name);
  constexpr int Depth = 5; // one rank solves smaller levels densely, without iterations
  const GridSpace space = BuildGridSpace(surface.mesh, Options(Depth).space);
  const Spectrum expected = ComputeSpectrum(space, options);
  const Spectrum found = SolveOnRanks(surface.mesh, Dealing::Contiguous, options, Depth).spectrum;
  EXPECT_TRUE(found.converged);
  // Patches at borders are in double precision. Flat pieces may therefore need it nowhere else.
  EXPECT_GE(found.singlePrecision, expected.singlePrecision);
  EXPECT_LE(found.iterations, 1 + 1.3 * expected.iterations);
  ASSERT_EQ(found.eigenvalues.size(), expected.eigenvalues.size());
  for (std::size_t mode = 0; mode < expected.eigenvalues.size(); ++mode)
  {
    EXPECT_NEAR(
      found.eigenvalues[mode], expected.eigenvalues[mode], part * expected.eigenvalues[mode])
      << "mode " << mode;
  }
}

} // namespace

TEST(RankSpectrum, IsThatOfOneRank)
{
  const Communicator ranks(MPI_COMM_WORLD);
  int simple = 0;
  for (const NamedSurface& surface : Surfaces())
  {
    for (const bool hasHats : { false, true })
    {
      SCOPED_TRACE(surface.name + (hasHats ? ", hats" : ""));
      const auto space = WholeSpace(surface.mesh, Options(4), hasHats);
      const Spectrum expected = ComputeSpectrum(*space, Modes(12));
      const MultiVector values = space->ValuesAtPoints(expected.vectors);
      const OnRanks found = SolveOnRanks(surface.mesh, Dealing::Shuffled, Modes(12), 4, hasHats);
      EXPECT_TRUE(found.spectrum.converged);
      ASSERT_EQ(found.spectrum.eigenvalues.size(), expected.eigenvalues.size());
      for (std::size_t mode = 0; mode < expected.eigenvalues.size(); ++mode)
      {
        SCOPED_TRACE("mode " + std::to_string(mode));
        EXPECT_NEAR(found.spectrum.eigenvalues[mode], expected.eigenvalues[mode],
          1e-8 * expected.eigenvalues[mode]);
        if (IsSimple(expected.eigenvalues, mode))
        {
          const auto column = static_cast<Id>(mode);
          const double size = values.col(column).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
          const double off = std::min(LargestDifference(ranks, found, values, column, 1.0),
            LargestDifference(ranks, found, values, column, -1.0));
          EXPECT_LE(off, 1e-3 * size); // nearly hidden functions show at points
          ++simple;
        }
      }
    }
  }
  EXPECT_GE(simple, 16);
}

TEST(RankSpectrum, TakesBlocksInSinglePrecisionAsOneRankDoes)
{
  SpectrumOptions options = Modes(12);
  options.tolerance = 1e-6; // relative error of the values
  int single = 0;
  for (const NamedSurface& surface : Surfaces())
  {
    CompareWithOneRank(surface, options, 1e-5); // close values miss the tolerance
    single += SolveOnRanks(surface.mesh, Dealing::OneRank, options).spectrum.singlePrecision;
  }
  EXPECT_GE(single, 3); // flat pieces need double precision
}

TEST(RankSpectrum, TakesWCyclesAndMoreSweeps)
{
  SpectrumOptions options = Modes(12);
  options.multigrid.cycle = CycleType::W;
  options.multigrid.preSweeps = options.multigrid.postSweeps = 2;
  CompareWithOneRank(Surfaces()[1], options, 1e-8);
}

TEST(RankSpectrum, FindsManyModesWindowByWindow)
{
  SpectrumOptions options = Modes(170);
  options.tolerance = 1e-9;
  CompareWithOneRank(Surfaces()[1], options, 1e-8);
}

TEST(RankSpectrum, IsOrthonormalForAnyDistribution)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const TriangleMesh mesh = Surfaces()[1].mesh;
  for (const Dealing dealing : Dealings)
  {
    const TriangleMesh own = PartOf(mesh, Deal(mesh, dealing, ranks.Size()), ranks.Rank());
    const RankSurface surface(ranks, own, Options(4), false);
    const RankLevels& levels = surface.Levels();
    const Spectrum spectrum = ComputeSpectrum(levels, Modes(12));
    SpectralProblem<double> problem;
    problem.stiffness = levels.Matrix(0, 0.0, 1.0, 1);
    problem.mass = levels.Matrix(0, 1.0, 0.0, 1);
    problem.distributed = levels.Distributed(0);
    problem.threads = 1;
    MultiVector X = spectrum.vectors;
    problem.Agree(X);
    EXPECT_TRUE(X == spectrum.vectors);
    const Eigen::MatrixXd products = problem.ProjectBoth({ X }, X);
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(12, 24);
    for (int mode = 0; mode < 12; ++mode)
    {
      expected(mode, mode) = spectrum.eigenvalues[mode];
      expected(mode, 12 + mode) = 1.0;
    }
    EXPECT_LE((products - expected).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-7);
    for (int mode = 1; mode < 12; ++mode)
    {
      EXPECT_GT(spectrum.estimatedErrors[mode], 0.0);
      EXPECT_LT(spectrum.estimatedErrors[mode], 0.2);
    }
  }
}

TEST(RankSpectrum, EndsWithWholeMultiplets)
{
  const TriangleMesh sphere = Surfaces().front().mesh; // 2 l + 1 values of l (l + 1)
  SpectrumOptions options = Modes(6);
  options.tolerance = 1e-6;
  const Spectrum cut = SolveOnRanks(sphere, Dealing::Contiguous, options).spectrum;
  EXPECT_EQ(cut.eigenvalues.size(), 6U);
  EXPECT_TRUE(cut.cutsMultiplet);
  options.completeMultiplets = true;
  const Spectrum whole = SolveOnRanks(sphere, Dealing::Contiguous, options).spectrum;
  EXPECT_EQ(whole.eigenvalues.size(), 9U);
  EXPECT_FALSE(whole.cutsMultiplet);
  EXPECT_TRUE(whole.converged);
}

TEST(RankSpectrum, IsAbortedOnAllRanksByOne)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const TriangleMesh mesh = Surfaces().front().mesh;
  const TriangleMesh own =
    PartOf(mesh, Deal(mesh, Dealing::Contiguous, ranks.Size()), ranks.Rank());
  for (const bool hasHats : { false, true })
  {
    const RankSurface surface(ranks, own, Options(4), hasHats);
    for (const double when : { 0.05, 0.2, 0.6 })
    {
      const Progress progress = OfAllRanks(ranks,
        Progress([&](double done) { return ranks.Rank() != ranks.Size() - 1 || done < when; }));
      EXPECT_THROW(ComputeSpectrum(surface.Levels(), Modes(10), progress), Aborted);
    }
  }
}

TEST(RankSpectrum, OfConstantsAloneAndOfNothing)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const OnRanks constant = SolveOnRanks(Surfaces().front().mesh, Dealing::Contiguous, Modes(1));
  ASSERT_EQ(constant.spectrum.eigenvalues.size(), 1U);
  EXPECT_EQ(constant.spectrum.eigenvalues.front(), 0.0);
  for (Id k = 1; k < constant.values.rows(); ++k)
  {
    EXPECT_NEAR(constant.values(k, 0), constant.values(0, 0), 1e-12);
  }
  const RankSurface nothing(ranks, TriangleMesh(), Options(4), false);
  EXPECT_TRUE(ComputeSpectrum(nothing.Levels(), Modes(5)).eigenvalues.empty());
}
