// The screened Poisson equation on several ranks has the solution of one rank, at every point.
#include "Parallel/RankPoisson.h"
#include "Spaces/GridSpace.h"
#include "Surfaces.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

RankSpaceOptions Options(int depth)
{
  RankSpaceOptions options;
  options.space.functions.depth = depth;
  options.space.functions.threads = 1;
  options.granularity = 3;
  return options;
}

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
  MultiVector values; // at all points of the surface; NaN where this rank has none
  SolveReport report;
};

/// On all ranks, and gives every rank the values at its own points.
Solved SolveOnRanks(const TriangleMesh& mesh, Dealing dealing, const RankSpaceOptions& options,
  const RankPoissonOptions& poisson)
{
  const Communicator ranks(MPI_COMM_WORLD);
  std::vector<Id> points;
  const TriangleMesh own =
    PartOf(mesh, Deal(mesh, dealing, ranks.Size()), ranks.Rank(), &points);
  const RankSpace space(ranks, own, options);
  Field f;
  f.values = space.Distribution().SendPoints(FieldAt(own.points));
  const PoissonSolution solution = SolvePoisson(
    space, space.Own().LoadOfValues(f), space.Own().LoadOfGradientsOf(f, nullptr), poisson);
  const MultiVector values =
    space.ValuesAtPoints(solution.coefficients, static_cast<Id>(own.points.size()));
  Solved solved{ MultiVector::Constant(static_cast<Id>(mesh.points.size()), 2,
                   std::numeric_limits<double>::quiet_NaN()),
    solution.report };
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    solved.values.row(points[k]) = values.row(static_cast<Id>(k));
  }
  return solved;
}

} // namespace

TEST(RankPoisson, HasTheSolutionOfOneRank)
{
  for (const NamedSurface& surface : Surfaces())
  {
    for (const double lambda : { 0.0, 0.02 })
    {
      SCOPED_TRACE(surface.name + ", weight " + std::to_string(lambda));
      PoissonOptions one;
      one.screeningWeight = lambda;
      one.multigrid.threads = 1;
      one.solve.tolerance = 1e-12;
      const GridSpace space = BuildGridSpace(surface.mesh, Options(5).space);
      const Field f{ FieldAssociation::Points, FieldAt(surface.mesh.points) };
      const PoissonSolution expected = SolveOnOne(space, f, one);
      const MultiVector values = space.ValuesAtPoints(expected.coefficients);

      RankPoissonOptions options;
      options.screeningWeight = lambda;
      options.multigrid.threads = 1;
      options.solve.tolerance = 1e-12;
      const Solved solved =
        SolveOnRanks(surface.mesh, Dealing::Shuffled, Options(5), options);
      EXPECT_TRUE(solved.report.converged);
      EXPECT_LE(solved.report.iterations, 2 + 1.5 * expected.report.iterations);
      for (Id k = 0; k < values.rows(); ++k)
      {
        if (!solved.values.row(k).hasNaN())
        {
          ASSERT_LE((solved.values.row(k) - values.row(k)).cwiseAbs().maxCoeff(), 1e-8)
            << "point " << k;
        }
      }
    }
  }
}
