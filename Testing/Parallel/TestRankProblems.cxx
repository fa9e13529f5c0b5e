// Core's problems on the pieces of several ranks have the results of one rank, at every point and
// on every triangle. Copies of triangles count once, and have the values of their originals.
#include "Equations/HeatDiffusion.h"
#include "Equations/PointConstraints.h"
#include "Parallel/HeldPoints.h"
#include "Pieces.h"
#include "Shape/SurfaceDerivatives.h"
#include "Spaces/GridSpace.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// Points without another point in the same place. Elsewhere, ranks cannot know that several of
/// their points are one.
std::vector<char> AlonePoints(const TriangleMesh& mesh)
{
  const Array<Index> first = WeldCoincidentPoints(mesh.points);
  std::vector<char> isAlone(mesh.points.size(), 1);
  for (std::size_t k = 0; k < first.size(); ++k)
  {
    if (first[k] != static_cast<Index>(k))
    {
      isAlone[k] = isAlone[first[k]] = 0;
    }
  }
  return isAlone;
}

void CompareDerivatives(const NamedSurface& surface, Dealing dealing, bool withCopies, bool hasHats)
{
  SCOPED_TRACE(surface.name + (hasHats ? ", hats" : ""));
  const Communicator ranks(MPI_COMM_WORLD);
  const auto alone = WholeSpace(surface.mesh, StableOptions(), hasHats);
  const Field f{ FieldAssociation::Points, VectorsAt(surface.mesh.points) };
  EquationOptions options = Exactly();
  options.solve.tolerance = hasHats ? 1e-11 : options.solve.tolerance; // rounding is 1e-12
  const SurfaceDerivatives expected = ComputeDerivatives(*alone, surface.mesh, f, nullptr, options);

  const Piece piece = PieceOf(surface.mesh, dealing, withCopies);
  const RankSurface pieces(ranks, piece.mesh, StableOptions(), hasHats, {}, piece.copies);
  const RankSpace& space = pieces.Space();
  const Field own{ FieldAssociation::Points, VectorsAt(piece.mesh.points) };
  SurfaceDerivatives found = ComputeDerivatives(pieces.Levels(), piece.mesh, own, nullptr, options);
  EXPECT_TRUE(found.report.converged);
  const auto compare = [&](const char* name, MultiVector& atPoints, const MultiVector& onTriangles,
                         const MultiVector& pointsOfWhole, const MultiVector& trianglesOfWhole,
                         const std::vector<char>& isCompared)
  {
    space.Copies().FillPoints(space.Distribution(), atPoints);
    ExpectRows(name, atPoints, pointsOfWhole, piece.points, isCompared);
    ExpectRows(name, onTriangles, trianglesOfWhole, piece.triangles);
    ExpectRows(name, space.Copies().RowsOfOriginals(space.Distribution(), onTriangles),
      trianglesOfWhole, piece.originals);
  };
  compare("gradient", found.gradientAtPoints, found.gradientOnTriangles, expected.gradientAtPoints,
    expected.gradientOnTriangles, {});
  compare("Laplacian", found.laplacianAtPoints, found.laplacianOnTriangles,
    expected.laplacianAtPoints, expected.laplacianOnTriangles, {});
  compare("divergence", found.divergenceAtPoints, found.divergenceOnTriangles,
    expected.divergenceAtPoints, expected.divergenceOnTriangles, {});
  compare("curl", found.curlAtPoints, found.curlOnTriangles, expected.curlAtPoints,
    expected.curlOnTriangles, AlonePoints(surface.mesh));
}

} // namespace

TEST(RankProblems, DerivativesAreThoseOfOneRank)
{
  for (const int surface : { 1, 2, 3, 5, 7 })
  {
    const Dealing dealing = surface == 1 ? Dealing::EveryOther : Dealing::Shuffled;
    CompareDerivatives(Surfaces()[surface], dealing, false, false);
    if (surface != 3) // its triangles are so large that the grid says little about the hats' masses
    {
      CompareDerivatives(Surfaces()[surface], dealing, false, true);
    }
  }
}

TEST(RankProblems, CopiesOfTrianglesCountOnce)
{
  CompareDerivatives(Surfaces()[0], Dealing::EveryOther, true, false);
  CompareDerivatives(Surfaces()[4], Dealing::Contiguous, true, false);
  CompareDerivatives(Surfaces()[4], Dealing::Shuffled, true, true);
}

TEST(RankProblems, CopiesOfNothingAreNotKnown)
{
  const Communicator ranks(MPI_COMM_WORLD);
  Piece piece = PieceOf(Surfaces().front().mesh, Dealing::OneRank, false);
  const auto first = static_cast<Id>(piece.mesh.points.size());
  for (const double x : { 0.1, 0.2, 0.3 })
  {
    piece.mesh.points.emplace_back(x, 0.1, x * x);
  }
  const RankSpace space(ranks, piece.mesh, Options(4), {}, { { first, first + 1, first + 2 } });
  MultiVector values = MultiVector::Ones(first + 3, 1);
  space.Copies().FillPoints(space.Distribution(), values);
  EXPECT_TRUE(std::isnan(values(first, 0)));
  EXPECT_TRUE((values.topRows(first).array() == 1.0).all());
  const MultiVector ofTriangles =
    MultiVector::Ones(static_cast<Id>(piece.mesh.triangles.size()), 2);
  const MultiVector rows = space.Copies().RowsOfOriginals(space.Distribution(), ofTriangles);
  EXPECT_EQ(rows.rows(), 1);
  EXPECT_TRUE(std::isnan(rows(0, 1)));
}

TEST(RankProblems, HeatSpreadsAsOnOneRank)
{
  const Communicator ranks(MPI_COMM_WORLD);
  for (const int surfaceAndHats : { 2, 3, 10, 11 })
  {
    const NamedSurface surface = Surfaces()[surfaceAndHats / 2];
    const bool hasHats = surfaceAndHats % 2 > 0;
    SCOPED_TRACE(surface.name + (hasHats ? ", hats" : ""));
    DiffusionOptions options;
    options.timeStep = 2.0;
    options.multigrid.threads = 1;
    options.solve = Exactly().solve;
    const auto spread =
      [&](const std::shared_ptr<const SurfaceSpace>& space, const TriangleMesh& mesh)
    {
      const Field f{ FieldAssociation::Points, VectorsAt(mesh.points) };
      const MultiVector start = space->LoadOfValues(f);
      HeatDiffusion heat(std::make_shared<const HeatEquation>(space, options), start, 0.5 * start);
      EXPECT_TRUE(heat.Advance().converged);
      EXPECT_TRUE(heat.Advance().converged);
      return space->ValuesAtPoints(heat.Coefficients());
    };
    const MultiVector expected =
      spread(WholeSpace(surface.mesh, StableOptions(), hasHats), surface.mesh);
    const Piece piece = PieceOf(surface.mesh, Dealing::Shuffled, false);
    const auto pieces =
      std::make_shared<const RankSurface>(ranks, piece.mesh, StableOptions(), hasHats);
    ExpectRows("values", spread({ pieces, &pieces->Levels() }, piece.mesh), expected, piece.points);
  }
}

TEST(RankProblems, HeldValuesAreMetAsOnOneRank)
{
  const Communicator ranks(MPI_COMM_WORLD);
  for (const int surfaceAndHats : { 2, 3, 4, 5, 11 })
  {
    const NamedSurface surface = Surfaces()[surfaceAndHats / 2];
    const bool hasHats = surfaceAndHats % 2 > 0;
    for (const double weight : { 0.0, 0.05 })
    {
      SCOPED_TRACE(surface.name + (hasHats ? ", hats" : "") + ", weight " + std::to_string(weight));
      const auto isHeld = [&](const Vec3& point) { return point[0] > 0.4; };
      const auto solve = [&](const SurfaceSpace& space, const HeldValues& held, const Field& f)
      {
        ConstraintOptions constraints;
        constraints.estimateOn = &space;
        const ConstrainedHierarchy hierarchy(
          space, weight, 1.0, held.rows, constraints.penalty, Exactly().multigrid);
        return SolveConstrained(space, weight, hierarchy, weight * space.LoadOfValues(f),
          held.values, constraints, Exactly().solve);
      };
      const auto hold = [&](const TriangleMesh& mesh, std::vector<Id>& points)
      {
        const MultiVector values = VectorsAt(mesh.points);
        const std::vector<char> isUsed = UsedPoints(mesh);
        for (std::size_t k = 0; k < mesh.points.size(); ++k)
        {
          if (isUsed[k] && isHeld(mesh.points[k]))
          {
            points.push_back(static_cast<Id>(k));
          }
        }
        MultiVector held(static_cast<Id>(points.size()), 3);
        for (std::size_t k = 0; k < points.size(); ++k)
        {
          held.row(static_cast<Id>(k)) = values.row(points[k]);
        }
        return held;
      };
      const auto alone = WholeSpace(surface.mesh, StableOptions(), hasHats);
      std::vector<Id> points;
      const MultiVector values = hold(surface.mesh, points);
      const ConstrainedSolution expected = solve(*alone, HoldPoints(*alone, points, values),
        { FieldAssociation::Points, VectorsAt(surface.mesh.points) });

      const Piece piece = PieceOf(surface.mesh, Dealing::Shuffled, false);
      const RankSurface pieces(ranks, piece.mesh, StableOptions(), hasHats);
      const RankLevels& levels = pieces.Levels();
      points.clear();
      const MultiVector own = hold(piece.mesh, points);
      const ConstrainedSolution found = solve(levels, HoldPoints(levels, points, own),
        { FieldAssociation::Points, VectorsAt(piece.mesh.points) });
      EXPECT_TRUE(found.report.converged);
      EXPECT_EQ(found.isExact, expected.isExact);
      EXPECT_EQ(found.steps, expected.steps);
      if (hasHats) // even if points lie between cells of two ranks, as on the plate
      {
        EXPECT_LE(found.report.iterations, 5 + 1.5 * expected.report.iterations);
      }
      EXPECT_NEAR(found.misfit, expected.misfit, 1e-7);
      EXPECT_EQ(found.isHeld.size(), expected.isHeld.size());
      if (expected.isExact)
      {
        ExpectRows("values", levels.ValuesAtPoints(found.coefficients),
          alone->ValuesAtPoints(expected.coefficients), piece.points);
      }
    }
  }
}
