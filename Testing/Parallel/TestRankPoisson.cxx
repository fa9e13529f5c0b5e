// The screened Poisson equation on several ranks has the solution of one rank, at every point.
#include "Meshes.h"
#include "Pieces.h"
#include "Spaces/FiniteElementSpace.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// Two columns that differ from point to point.
MultiVector FieldAt(const std::vector<Vec3>& points)
{
  MultiVector values(static_cast<Id>(points.size()), 2);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const Vec3& p = points[k];
    values.row(k) << std::sin(5.0 * p[0]) + p[1], std::cos(7.0 * p[2]) * p[0] + 3.0;
  }
  return values;
}

struct Solved
{
  MultiVector values; // at this rank's own points
  std::vector<Id> points;
  std::vector<char> hasValue;
  SolveReport report;
  SolutionAccuracy accuracy;
};

Solved SolveOnRanks(
  const TriangleMesh& mesh, Dealing dealing, const PoissonOptions& poisson, bool hasHats)
{
  const Communicator ranks(MPI_COMM_WORLD);
  Solved solved;
  const TriangleMesh own =
    PartOf(mesh, Deal(mesh, dealing, ranks.Size()), ranks.Rank(), &solved.points);
  const RankSurface surface(ranks, own, Options(4), hasHats);
  const RankLevels& levels = surface.Levels();
  const PoissonSolution solution = SolveScreened(levels, FieldAt(own.points), poisson);
  solved.values = levels.ValuesAtPoints(solution.coefficients);
  solved.hasValue = levels.PointsWithFunctions();
  solved.report = solution.report;
  solved.accuracy = solution.accuracy;
  ranks.Maximum(&solved.accuracy.largest, 1);
  return solved;
}

PoissonOptions PoissonWith(double weight)
{
  PoissonOptions options;
  options.screeningWeight = weight;
  options.multigrid.threads = 1;
  options.solve.tolerance = 1e-10; // smaller residuals of sheets with a thin gap are rounding
  options.solve.maximumIterations = 300;
  return options;
}

} // namespace

TEST(RankPoisson, HasTheSolutionOfOneRank)
{
  for (const NamedSurface& surface : Surfaces())
  {
    for (const double weight : { 0.0, 0.05 })
    {
      for (const bool hasHats : { false, true })
      {
        if (weight > 0.0 && surface.name != "torus")
        {
          continue;
        }
        SCOPED_TRACE(
          surface.name + ", weight " + std::to_string(weight) + (hasHats ? ", hats" : ""));
        const auto space = WholeSpace(surface.mesh, Options(4), hasHats);
        const PoissonSolution expected =
          SolveScreened(*space, FieldAt(surface.mesh.points), PoissonWith(weight));
        const MultiVector values = space->ValuesAtPoints(expected.coefficients);
        for (const Dealing dealing :
          hasHats
            ? std::vector<Dealing>{ Dealing::Contiguous, Dealing::EveryOther, Dealing::Shuffled }
            : std::vector<Dealing>{ Dealing::OneRank, Dealing::Shuffled })
        {
          const Solved solved = SolveOnRanks(surface.mesh, dealing, PoissonWith(weight), hasHats);
          EXPECT_TRUE(solved.report.converged);
          // On such a small surface most patches are at borders, where corrections are damped. If
          // triangles are longer than cells, all ranks share all hats. Eight ranks take 45
          // iterations on the grid where one takes 29.
          const int ofOne = expected.report.iterations;
          EXPECT_LE(solved.report.iterations, hasHats ? 2 + 1.3 * ofOne : 4 + 1.5 * ofOne);
          for (const char hasValue : solved.hasValue)
          {
            EXPECT_TRUE(hasValue);
          }
          ExpectRows("values", solved.values, values, solved.points);
        }
      }
    }
  }
}

TEST(RankPoisson, TakesAboutAsManyIterationsAsOneRank)
{
  const TriangleMesh mesh = Transform(Torus(240, 80, 1.0, 0.4), { 1, 2, 3 }, 0.4);
  const Communicator ranks(MPI_COMM_WORLD);
  const TriangleMesh own =
    PartOf(mesh, Deal(mesh, Dealing::Contiguous, ranks.Size()), ranks.Rank());
  RankSpaceOptions options = Options(6);
  options.granularity = 0;
  PoissonOptions poisson = PoissonWith(1e-4);
  poisson.solve.tolerance = 1e-8;
  for (const bool hasHats : { false, true })
  {
    const auto whole = WholeSpace(mesh, options, hasHats);
    const int ofOne = SolveScreened(*whole, FieldAt(mesh.points), poisson).report.iterations;
    const RankSurface surface(ranks, own, options, hasHats);
    const SolveReport report = SolveScreened(surface.Levels(), FieldAt(own.points), poisson).report;
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.iterations, std::ceil(1.3 * ofOne)) << ofOne << " on one rank";
  }
}

TEST(RankPoisson, EstimatesTheErrorsOfOneRank)
{
  for (const double accuracy : { 0.0, 0.1 })
  {
    PoissonOptions options = PoissonWith(0.05);
    options.estimateErrors = true;
    options.accuracy = accuracy;
    options.solve.tolerance = accuracy > 0.0 ? 0.0 : options.solve.tolerance;
    for (const NamedSurface& surface : { Surfaces()[0], Surfaces()[1], Surfaces()[2] })
    {
      SCOPED_TRACE(surface.name + ", accuracy " + std::to_string(accuracy));
      const auto space = WholeSpace(surface.mesh, Options(4), false);
      const PoissonSolution expected = SolveScreened(*space, FieldAt(surface.mesh.points), options);
      const Solved solved = SolveOnRanks(surface.mesh, Dealing::Contiguous, options, false);
      EXPECT_TRUE(solved.report.converged);
      // On one rank the results are the same, except that Core's sweeps are in single precision and
      // the ranks' sweeps are not. On several ranks the estimates use a coarser solution that is
      // less exact if nearly all patches are at borders, as on this small torus. On scans they
      // agree to a hundredth.
      const double part = Communicator(MPI_COMM_WORLD).Size() == 1 ? 1e-5 : 0.5;
      EXPECT_NEAR(solved.accuracy.discretization, expected.accuracy.discretization,
        part * expected.accuracy.discretization);
      EXPECT_NEAR(
        solved.accuracy.largest, expected.accuracy.largest, part * expected.accuracy.largest);
      EXPECT_LE(solved.accuracy.algebraic, std::max(1e-9, 0.2 * solved.accuracy.discretization));
      EXPECT_GT(solved.accuracy.algebraic, 0.0);
    }
  }
}

TEST(RankPoisson, GivesPointsOfTwoRanksOneValue)
{
  const Communicator ranks(MPI_COMM_WORLD);
  for (const NamedSurface& surface : Surfaces())
  {
    for (const bool hasHats : { false, true })
    {
      SCOPED_TRACE(surface.name + (hasHats ? ", hats" : ""));
      const Solved solved =
        SolveOnRanks(surface.mesh, Dealing::Shuffled, PoissonWith(0.05), hasHats);
      const auto points = static_cast<Id>(surface.mesh.points.size());
      MultiVector low = MultiVector::Constant(points, 2, 1e300);
      MultiVector high = MultiVector::Constant(points, 2, -1e300);
      for (std::size_t k = 0; k < solved.points.size(); ++k)
      {
        low.row(solved.points[k]) = high.row(solved.points[k]) =
          solved.values.row(static_cast<Id>(k));
      }
      ranks.Minimum(low.data(), low.size());
      ranks.Maximum(high.data(), high.size());
      EXPECT_TRUE(low == high);
    }
  }
}

TEST(RankPoisson, EndsOnAllRanksWhenOneFails)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const int bad = ranks.Size() - 1;
  TriangleMesh mesh = Surfaces().front().mesh;
  std::vector<int> rankOf = Deal(mesh, Dealing::Contiguous, ranks.Size());
  TriangleMesh own = PartOf(mesh, rankOf, ranks.Rank());
  if (ranks.Rank() == bad)
  {
    own.points[own.triangles.front()[0]][1] = std::nan("");
  }
  try
  {
    RankSpace(ranks, own, Options(4));
    ADD_FAILURE() << "NaN was taken";
  }
  catch (const RankFailure& failure)
  {
    EXPECT_EQ(failure.rank, bad);
  }
}

TEST(RankPoisson, OfWhatIsNoNumberOnOneRankIsConvergedOnNone)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const TriangleMesh mesh = Surfaces().front().mesh;
  const TriangleMesh own =
    PartOf(mesh, Deal(mesh, Dealing::Contiguous, ranks.Size()), ranks.Rank());
  MultiVector f = FieldAt(own.points);
  if (ranks.Rank() == ranks.Size() - 1)
  {
    f(0, 0) = std::nan("");
  }
  for (const bool hasHats : { false, true })
  {
    const RankSurface surface(ranks, own, Options(4), hasHats);
    EXPECT_FALSE(SolveScreened(surface.Levels(), f, PoissonWith(0.05)).report.converged);
  }
}

TEST(RankPoisson, IsAbortedOnAllRanksByOne)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const TriangleMesh mesh = Surfaces().front().mesh;
  const TriangleMesh own =
    PartOf(mesh, Deal(mesh, Dealing::Contiguous, ranks.Size()), ranks.Rank());
  for (const bool hasHats : { false, true })
  {
    for (const double when : { 0.1, 0.3, 0.61, 0.73 })
    {
      const Progress ofRank(
        [&](double done) { return ranks.Rank() != ranks.Size() - 1 || done < when; });
      const Progress progress = OfAllRanks(ranks, ofRank);
      EXPECT_THROW(
        {
          const RankSurface surface(ranks, own, Options(4), hasHats, ofRank.Part(0.0, 0.6));
          const PoissonOptions options = PoissonWith(0.05);
          const Multigrid multigrid = BuildMultigrid(surface.Levels(), options.screeningWeight, 1.0,
            options.multigrid, progress.Part(0.6, 0.7));
          SolvePoisson(surface.Levels(), multigrid,
            surface.Levels().LoadOfValues({ FieldAssociation::Points, FieldAt(own.points) }),
            MultiVector(), options, progress.Part(0.7, 1.0));
        },
        Aborted);
    }
  }
}

TEST(RankPoisson, OfNothingIsNothing)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const RankSurface nothing(ranks, TriangleMesh(), Options(4), false);
  const PoissonSolution solution =
    SolveScreened(nothing.Levels(), MultiVector(0, 1), PoissonWith(0.05));
  EXPECT_TRUE(solution.report.converged);
  EXPECT_EQ(solution.coefficients.rows(), 0);
}
