// The screened Poisson equation on several ranks has the solution of one rank, at every point.
#include "Parallel/RankLevels.h"
#include "Parallel/RankPoisson.h"
#include "Spaces/GridSpace.h"
#include "Surfaces.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// Two columns, which differ from point to point.
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

PoissonSolution SolveOnOne(const GridSpace& space, const Field& f, const PoissonOptions& options)
{
  std::vector<MultigridLevel> levels;
  for (std::size_t l = 0; l < space.NumberOfLevels(); ++l)
  {
    MultigridLevel& level = levels.emplace_back();
    space.FillMatrix(l, options.screeningWeight, 1.0, level.A, 1);
    level.order = space.Relaxation(l, options.multigrid).order;
    if (l + 1 < space.NumberOfLevels())
    {
      level.prolongation = space.Prolongation(l);
    }
  }
  return SolvePoisson(space, Multigrid(std::move(levels), options.multigrid), space.LoadOfValues(f),
    space.LoadOfGradientsOf(f, nullptr), options);
}

struct Solved
{
  MultiVector values; // at this rank's own points
  std::vector<Id> points;
  std::vector<char> hasValue;
  SolveReport report;
  SolutionAccuracy accuracy;
};

Solved SolveOnRanks(const TriangleMesh& mesh, Dealing dealing, const PoissonOptions& poisson)
{
  const Communicator ranks(MPI_COMM_WORLD);
  Solved solved;
  const TriangleMesh own =
    PartOf(mesh, Deal(mesh, dealing, ranks.Size()), ranks.Rank(), &solved.points);
  const RankSpace space(ranks, own, Options(4));
  Field f;
  f.values = space.Distribution().SendPoints(FieldAt(own.points));
  const PoissonSolution solution = SolvePoisson(
    space, space.Own().LoadOfValues(f), space.Own().LoadOfGradientsOf(f, nullptr), poisson);
  const RankLevels levels(space);
  solved.values = levels.ValuesAtPoints(solution.coefficients);
  solved.hasValue = levels.PointsWithFunctions();
  solved.report = solution.report;
  solved.accuracy = solution.accuracy;
  return solved;
}

PoissonOptions PoissonWith(double weight)
{
  PoissonOptions options;
  options.screeningWeight = weight;
  options.multigrid.threads = 1;
  options.solve.tolerance = 1e-10; // residuals of sheets with a thin gap are rounding below
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
      if (weight > 0.0 && surface.name != "torus")
      {
        continue;
      }
      SCOPED_TRACE(surface.name + ", weight " + std::to_string(weight));
      const GridSpace space = BuildGridSpace(surface.mesh, Options(4).space);
      const Field f{ FieldAssociation::Points, FieldAt(surface.mesh.points) };
      const PoissonSolution expected = SolveOnOne(space, f, PoissonWith(weight));
      const MultiVector values = space.ValuesAtPoints(expected.coefficients);
      const Solved solved = SolveOnRanks(surface.mesh, Dealing::Shuffled, PoissonWith(weight));
      EXPECT_TRUE(solved.report.converged);
      // On so small a surface most patches are at borders, where corrections are damped.
      EXPECT_LE(solved.report.iterations, 5 + 2 * expected.report.iterations);
      for (std::size_t k = 0; k < solved.points.size(); ++k)
      {
        EXPECT_TRUE(solved.hasValue[k]);
        ASSERT_LE((solved.values.row(static_cast<Id>(k)) - values.row(solved.points[k]))
                    .cwiseAbs()
                    .maxCoeff(),
          1e-8)
          << "point " << k;
      }
    }
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
      const GridSpace space = BuildGridSpace(surface.mesh, Options(4).space);
      const Field f{ FieldAssociation::Points, FieldAt(surface.mesh.points) };
      const PoissonSolution expected = SolveOnOne(space, f, options);
      const Solved solved = SolveOnRanks(surface.mesh, Dealing::Contiguous, options);
      EXPECT_TRUE(solved.report.converged);
      // Of one rank the same, but that Core's sweeps are in single precision and the ranks' are
      // not; of several the coarser solution, which they are told from, is less exact where nearly
      // all patches are at borders, as on so small a torus. On scans they agree to a hundredth.
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
    SCOPED_TRACE(surface.name);
    const Solved solved = SolveOnRanks(surface.mesh, Dealing::Shuffled, PoissonWith(0.05));
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

  const RankSpace space(ranks, PartOf(mesh, rankOf, ranks.Rank()), Options(4));
  MultiVector load = MultiVector::Zero(space.Numberings().front().Functions(), 1);
  if (ranks.Rank() == bad && load.rows() > 0)
  {
    load(0, 0) = std::nan("");
  }
  EXPECT_THROW(SolvePoisson(space, load, MultiVector(), PoissonWith(0.05)), std::runtime_error);
}

TEST(RankPoisson, IsAbortedOnAllRanksByOne)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const TriangleMesh mesh = Surfaces().front().mesh;
  const TriangleMesh own =
    PartOf(mesh, Deal(mesh, Dealing::Contiguous, ranks.Size()), ranks.Rank());
  for (const double when : { 0.1, 0.3, 0.61, 0.73 })
  {
    const Progress progress(
      [&](double done) { return ranks.Rank() != ranks.Size() - 1 || done < when; });
    EXPECT_THROW(
      {
        const RankSpace space(ranks, own, Options(4), progress.Part(0.0, 0.6));
        Field f;
        f.values = space.Distribution().SendPoints(FieldAt(own.points));
        SolvePoisson(space, space.Own().LoadOfValues(f), MultiVector(), PoissonWith(0.05),
          progress.Part(0.6, 1.0));
      },
      Aborted);
  }
}

TEST(RankPoisson, OfNothingIsNothing)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const RankSpace space(ranks, TriangleMesh(), Options(4));
  const PoissonSolution solution =
    SolvePoisson(space, MultiVector(0, 1), MultiVector(), PoissonWith(0.05));
  EXPECT_TRUE(solution.report.converged);
  EXPECT_EQ(solution.coefficients.rows(), 0);
}
