// Weighted and unknown values, and terms of the boundary: the pieces of several ranks give the
// results of one rank.
#include "Equations/PartialField.h"
#include "Equations/PointConstraints.h"
#include "Equations/Poisson.h"
#include "Parallel/HeldPoints.h"
#include "Parallel/RankBoundary.h"
#include "Pieces.h"
#include "Support/Meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// Two in three points are unknown beyond a plane, so some known points have no triangle.
Field PartlyKnown(const TriangleMesh& mesh)
{
  Field f{ FieldAssociation::Points, VectorsAt(mesh.points) };
  for (Id k = 0; k < f.values.rows(); ++k)
  {
    const Vec3& p = mesh.points[k];
    if (p[0] > 0.3 && std::sin(37.0 * p[0] + 53.0 * p[1] + 71.0 * p[2]) < 0.5)
    {
      f.values(k, 1) = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return f;
}

Field WeightsAt(const TriangleMesh& mesh)
{
  Field weight{ FieldAssociation::Points, MultiVector(static_cast<Id>(mesh.points.size()), 1) };
  for (Id k = 0; k < weight.values.rows(); ++k)
  {
    weight.values(k, 0) = std::pow(mesh.points[k][2], 2) + 0.1;
  }
  return weight;
}

struct Partial
{
  MultiVector atPoints;
  ConstrainedSolution solution;
  Id ignored;
};

/// @param none  HeldValues without a row
Partial SolvePartial(
  const SurfaceSpace& space, const TriangleMesh& mesh, const HeldValues& none, double lambda)
{
  const Field weight = WeightsAt(mesh);
  const PartialField field = SplitField(PartlyKnown(mesh), &weight, mesh);
  const Field known = ScaleOfKnown(field, nullptr, mesh);
  const std::shared_ptr<const SurfaceSpace> weighted = space.WithWeightedMass(field.weight);
  const ConstrainedHierarchy hierarchy(*weighted, lambda, 1.0, none.rows, 1e3, Exactly().multigrid);
  const MultiVector load = lambda * space.LoadOfWeightedValues(field.values, field.weight) +
                           space.LoadOfGradientsOf(field.values, &known);
  ConstraintOptions constraints;
  constraints.estimateOn = &space;
  Partial partial;
  SolveOptions solve = Exactly().solve;
  solve.tolerance = 1e-11; // nothing holds the solution: rounding exceeds 1e-12
  partial.solution =
    SolveConstrained(*weighted, lambda, hierarchy, load, none.values, constraints, solve);
  SetMeans(
    space, partial.solution.isHeld, MeansOfKnown(space, field), partial.solution.coefficients, 1);
  partial.atPoints = space.ValuesAtPoints(partial.solution.coefficients);
  partial.ignored = CountIgnoredPoints(space, field, mesh);
  return partial;
}

} // namespace

TEST(RankConditions, WeighedAndUnknownValuesCountAsOnOneRank)
{
  const Communicator ranks(MPI_COMM_WORLD);
  for (const NamedSurface& surface : { Surfaces()[1], Surfaces()[2], Surfaces()[4] })
  {
    for (const double lambda : { 0.0, 0.05 })
    {
      if (lambda == 0.0 && surface.name != "components")
      {
        continue;
      }
      for (const bool hasHats : { false, true })
      {
        SCOPED_TRACE(
          surface.name + (hasHats ? ", hats" : "") + ", weight " + std::to_string(lambda));
        const auto alone = WholeSpace(surface.mesh, StableOptions(), hasHats);
        const Partial expected =
          SolvePartial(*alone, surface.mesh, HoldPoints(*alone, {}, MultiVector(0, 3)), lambda);
        EXPECT_TRUE(expected.solution.report.converged);
        EXPECT_GT(expected.ignored, 0);

        const Piece piece = PieceOf(surface.mesh, Dealing::Shuffled, false);
        const RankSurface pieces(ranks, piece.mesh, StableOptions(), hasHats);
        const RankLevels& levels = pieces.Levels();
        const Partial found =
          SolvePartial(levels, piece.mesh, HoldPoints(levels, {}, MultiVector(0, 3)), lambda);
        EXPECT_TRUE(found.solution.report.converged);
        EXPECT_EQ(found.ignored, expected.ignored);
        ExpectRows("values", found.atPoints, expected.atPoints, piece.points);
      }
    }
  }
}

TEST(RankConditions, AWrongWeightOfOneRankFailsOnAll)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const Piece piece = PieceOf(Surfaces().front().mesh, Dealing::Contiguous, false);
  const RankSurface surface(ranks, piece.mesh, Options(4), true);
  std::vector<double> weight(piece.mesh.triangles.size(), 1.0);
  if (ranks.Rank() == ranks.Size() - 1)
  {
    weight.back() = std::nan("");
  }
  EXPECT_THROW(surface.Levels().WithWeightedMass(weight), RankFailure);
  EXPECT_THROW(surface.Levels().OfGrid().WithWeightedMass(weight), RankFailure);
}

namespace
{

/// Surfaces with boundary: with edges longer than cells, edges on planes of the grid, and
/// overlapping triangles.
std::vector<NamedSurface> WithBoundary()
{
  const TriangleMesh square = FlatRectangle(1, 1);
  return { { "open", Surfaces()[4].mesh }, { "soup", Surfaces()[3].mesh },
    { "sheets", Surfaces()[7].mesh }, { "on planes", FlatRectangle(8, 6) },
    { "two triangles", Transform(square, Vec3(1, 2, 3), 0.7) },
    { "two triangles on planes", square },
    { "half a sphere", []
      {
        TriangleMesh half = LatLongSphere(20, 11);
        half.triangles.resize(half.triangles.size() / 2);
        return half;
      }() } };
}

/// Σ load_i x_i for the corners x of functions, which is ∮ f x, and Σ load_i.
MultiVector MomentsOf(
  const SurfaceSpace& space, const FiniteElementSpace& own, const MultiVector& load)
{
  MultiVector place(load.rows(), 4);
  place << own.EmbeddingOfMesh(), MultiVector::Ones(load.rows(), 1);
  const DistributedRows* const distributed = space.Distributed(0);
  const Id whole = load.rows() - GhostRows(distributed);
  MultiVector moments = place.bottomRows(whole).transpose() * load.bottomRows(whole);
  SumOverProcesses(distributed, moments);
  return moments;
}

/// The largest number of all ranks that is not NaN; 0 if there is none.
double LargestOf(const Communicator& ranks, const MultiVector& values)
{
  double largest = values.size() > 0 ? values.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() : 0.0;
  ranks.Maximum(&largest, 1);
  return largest;
}

} // namespace

TEST(RankConditions, AFluxIsThatOfOneRank)
{
  const Communicator ranks(MPI_COMM_WORLD);
  for (const NamedSurface& surface : WithBoundary())
  {
    for (const bool hasHats : { false, true })
    {
      SCOPED_TRACE(surface.name + (hasHats ? ", hats" : ""));
      const auto whole = WholeSpace(surface.mesh, StableOptions(), hasHats);
      const FiniteElementSpace& alone = *whole;
      const MultiVector flux = VectorsAt(surface.mesh.points);
      const BoundaryTerms expected = TermsOnBoundary(alone, surface.mesh, true, &flux, nullptr);
      const Piece piece =
        PieceOf(surface.mesh, hasHats ? Dealing::Contiguous : Dealing::Shuffled, false);
      const RankSurface pieces(ranks, piece.mesh, StableOptions(), hasHats);
      const RankLevels& levels = pieces.Levels();
      const MultiVector own = VectorsAt(piece.mesh.points);
      const BoundaryTerms found = TermsOnBoundary(levels, true, &own, nullptr);
      ASSERT_TRUE(found.isThere);
      EXPECT_EQ(found.held.values.rows(), 0);
      const MultiVector moments = MomentsOf(alone, alone, expected.load);
      const MultiVector ours = MomentsOf(levels, levels.Own(), found.load);
      EXPECT_LE((ours - moments).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
        1e-9 * moments.cwiseAbs().maxCoeff<Eigen::PropagateNaN>());

      if (surface.name != "soup" && surface.name != "half a sphere")
      {
        continue;
      }
      PoissonOptions options;
      options.screeningWeight = 0.05;
      options.multigrid = Exactly().multigrid;
      options.solve = Exactly().solve;
      const auto solve = [&](const SurfaceSpace& on, const MultiVector& load)
      {
        const Multigrid multigrid = BuildMultigrid(on, 0.05, 1.0, options.multigrid);
        const MultiVector none = MultiVector::Zero(load.rows(), load.cols());
        const MultiVector rest = load / on.UnitLength();
        const PoissonSolution solution = SolvePoisson(on, multigrid, rest / 0.05, none, options);
        EXPECT_TRUE(solution.report.converged);
        return on.ValuesAtPoints(solution.coefficients);
      };
      ExpectRows("values", solve(levels, found.load), solve(alone, expected.load), piece.points);
    }
  }
}

TEST(RankConditions, TheBoundaryIsHeldAsOnOneRank)
{
  const Communicator ranks(MPI_COMM_WORLD);
  for (const NamedSurface& surface : WithBoundary())
  {
    for (const bool hasHats : { false, true })
    {
      if (!hasHats && (surface.name == "soup" || surface.name == "sheets")) // double points
      {
        continue;
      }
      SCOPED_TRACE(surface.name + (hasHats ? ", hats" : ""));
      const auto valuesOf = [](const TriangleMesh& mesh)
      {
        MultiVector values = VectorsAt(mesh.points);
        for (Id k = 0; k < values.rows(); ++k)
        {
          if (mesh.points[k][1] > 0.9)
          {
            values(k, 0) = std::nan("");
          }
        }
        return values;
      };
      const auto whole = WholeSpace(surface.mesh, StableOptions(), hasHats);
      const FiniteElementSpace& alone = *whole;
      const MultiVector values = valuesOf(surface.mesh);
      const BoundaryTerms expected = TermsOnBoundary(alone, surface.mesh, true, nullptr, &values);
      const Piece piece = PieceOf(surface.mesh, Dealing::Shuffled, false);
      const RankSurface pieces(ranks, piece.mesh, StableOptions(), hasHats);
      const RankLevels& levels = pieces.Levels();
      const MultiVector own = valuesOf(piece.mesh);
      const BoundaryTerms found = TermsOnBoundary(levels, true, nullptr, &own);
      ASSERT_TRUE(found.isThere);
      EXPECT_EQ(found.load.size(), 0);
      auto held = static_cast<double>(found.held.values.rows());
      ranks.Sum(&held, 1);
      if (surface.name != "soup" && surface.name != "sheets") // their points hold one hat twice
      {
        EXPECT_EQ(held, static_cast<double>(expected.held.values.rows()));
      }
      EXPECT_NEAR(LargestOf(ranks, found.held.values),
        expected.held.values.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-12);

      if (surface.name == "on planes")
      {
        continue;
      }
      const auto solve = [&](const SurfaceSpace& on, const HeldValues& what)
      {
        ConstraintOptions constraints;
        const ConstrainedHierarchy hierarchy(
          on, 0.05, 1.0, what.rows, constraints.penalty, Exactly().multigrid);
        const ConstrainedSolution solution = SolveConstrained(
          on, 0.05, hierarchy, MultiVector(), what.values, constraints, Exactly().solve);
        EXPECT_TRUE(solution.report.converged);
        return on.ValuesAtPoints(solution.coefficients);
      };
      ExpectRows("values", solve(levels, found.held), solve(alone, expected.held), piece.points);
    }
  }
}

TEST(RankConditions, AClosedSurfaceHasNoBoundary)
{
  const Communicator ranks(MPI_COMM_WORLD);
  for (const int surface : { 0, 1, 2 })
  {
    const Piece piece = PieceOf(Surfaces()[surface].mesh, Dealing::Shuffled, false);
    const RankSurface pieces(ranks, piece.mesh, StableOptions(), true);
    const MultiVector own = VectorsAt(piece.mesh.points);
    for (const RankLevels* levels : { &pieces.Levels(), &pieces.Levels().OfGrid() })
    {
      const BoundaryTerms found = TermsOnBoundary(*levels, true, &own, &own);
      EXPECT_FALSE(found.isThere);
      EXPECT_EQ(found.load.size(), 0);
    }
  }
}
