// Problems of Core on the pieces of several ranks have the answers of one rank, at every point and
// on every triangle; copies of triangles count once, and have the values of their originals.
#include "Parallel/HeldPoints.h"
#include "Parallel/RankLevels.h"
#include "Problems/HeatDiffusion.h"
#include "Problems/PointConstraints.h"
#include "Problems/SurfaceDerivatives.h"
#include "Spaces/GridSpace.h"
#include "Surfaces.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

RankSpaceOptions StableOptions()
{
  RankSpaceOptions options = Options(4);
  options.space.normalStabilization = 1e-2; // few iterations to small tolerances
  return options;
}

MultiVector VectorsAt(const std::vector<Vec3>& points)
{
  MultiVector values(static_cast<Id>(points.size()), 3);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const Vec3& p = points[k];
    values.row(static_cast<Id>(k)) << std::sin(2.0 * p[0]) + p[1], p[0] * p[2], std::cos(p[1]);
  }
  return values;
}

DerivativeOptions Exactly()
{
  DerivativeOptions options;
  options.multigrid.threads = 1;
  options.solve.tolerance = 1e-12;
  options.solve.maximumIterations = 300;
  return options;
}

/// A rank's part, the numbers of its points and triangles in the whole, and what it has of other
/// ranks.
struct Piece
{
  TriangleMesh mesh;
  std::vector<Id> points;
  std::vector<Id> triangles;
  TriangleList copies;
  std::vector<Id> originals; // of the copies, in the whole
};

/// @param withCopies  of the triangles that touch the part
Piece PieceOf(const TriangleMesh& mesh, Dealing dealing, bool withCopies)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const std::vector<int> rankOf = Deal(mesh, dealing, ranks.Size());
  Piece piece;
  piece.mesh = PartOf(mesh, rankOf, ranks.Rank(), &piece.points);
  std::vector<Id> place(mesh.points.size(), -1);
  for (std::size_t k = 0; k < piece.points.size(); ++k)
  {
    place[piece.points[k]] = static_cast<Id>(k);
  }
  const std::vector<Id> own = place;
  for (Id t = 0; t < static_cast<Id>(mesh.triangles.size()); ++t)
  {
    const auto& corners = mesh.triangles[t];
    if (rankOf[t] == ranks.Rank())
    {
      piece.triangles.push_back(t);
      continue;
    }
    if (!withCopies || (own[corners[0]] < 0 && own[corners[1]] < 0 && own[corners[2]] < 0))
    {
      continue;
    }
    piece.originals.push_back(t);
    auto& copy = piece.copies.emplace_back();
    for (int corner = 0; corner < 3; ++corner)
    {
      Id& point = place[corners[corner]];
      if (point < 0)
      {
        point = static_cast<Id>(piece.mesh.points.size());
        piece.mesh.points.push_back(mesh.points[corners[corner]]);
        piece.points.push_back(corners[corner]);
      }
      copy[corner] = point;
    }
  }
  return piece;
}

/// Whether rows here are those of the whole, to a part of its largest number.
void ExpectRows(const char* name, const MultiVector& found, const MultiVector& whole,
  const std::vector<Id>& places, const std::vector<char>& isCompared = {})
{
  SCOPED_TRACE(name);
  ASSERT_EQ(found.rows(), static_cast<Id>(places.size()));
  ASSERT_EQ(found.cols(), whole.cols());
  const double allowed = 1e-8 * whole.cwiseAbs().maxCoeff();
  for (Id k = 0; k < found.rows(); ++k)
  {
    if (isCompared.empty() || isCompared[places[k]])
    {
      ASSERT_LE((found.row(k) - whole.row(places[k])).cwiseAbs().maxCoeff(), allowed)
        << "row " << k;
    }
  }
}

/// Points that nothing else lies upon: elsewhere the ranks' points are not known to be one.
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

void CompareDerivatives(const NamedSurface& surface, Dealing dealing, bool withCopies)
{
  SCOPED_TRACE(surface.name);
  const Communicator ranks(MPI_COMM_WORLD);
  const GridSpace alone = BuildGridSpace(surface.mesh, StableOptions().space);
  const Field f{ FieldAssociation::Points, VectorsAt(surface.mesh.points) };
  const SurfaceDerivatives expected = ComputeDerivatives(alone, surface.mesh, f, Exactly());

  const Piece piece = PieceOf(surface.mesh, dealing, withCopies);
  const RankSpace space(ranks, piece.mesh, StableOptions(), {}, piece.copies);
  const RankLevels levels(space);
  const Field own{ FieldAssociation::Points, VectorsAt(piece.mesh.points) };
  SurfaceDerivatives found = ComputeDerivatives(levels, piece.mesh, own, Exactly());
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
    CompareDerivatives(
      Surfaces()[surface], surface == 1 ? Dealing::EveryOther : Dealing::Shuffled, false);
  }
}

TEST(RankProblems, CopiesOfTrianglesCountOnce)
{
  CompareDerivatives(Surfaces()[0], Dealing::EveryOther, true);
  CompareDerivatives(Surfaces()[4], Dealing::Contiguous, true);
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
  for (const NamedSurface& surface : { Surfaces()[1], Surfaces()[5] })
  {
    SCOPED_TRACE(surface.name);
    DiffusionOptions options;
    options.timeStep = 2.0;
    options.multigrid.threads = 1;
    options.solve = Exactly().solve;
    const auto spread =
      [&](const std::shared_ptr<const SurfaceSpace>& space, const TriangleMesh& mesh)
    {
      const Field f{ FieldAssociation::Points, VectorsAt(mesh.points) };
      const MultiVector start = space->LoadOfValues(f);
      HeatDiffusion heat(space, start, 0.5 * start, options);
      EXPECT_TRUE(heat.Advance().converged);
      EXPECT_TRUE(heat.Advance().converged);
      return space->ValuesAtPoints(heat.Coefficients());
    };
    const MultiVector expected =
      spread(std::make_shared<GridSpace>(BuildGridSpace(surface.mesh, StableOptions().space)),
        surface.mesh);
    const Piece piece = PieceOf(surface.mesh, Dealing::Shuffled, false);
    const RankSpace space(ranks, piece.mesh, StableOptions());
    ExpectRows(
      "values", spread(std::make_shared<RankLevels>(space), piece.mesh), expected, piece.points);
  }
}

TEST(RankProblems, HeldValuesAreMetAsOnOneRank)
{
  const Communicator ranks(MPI_COMM_WORLD);
  for (const NamedSurface& surface : { Surfaces()[1], Surfaces()[2] })
  {
    for (const double weight : { 0.0, 0.05 })
    {
      SCOPED_TRACE(surface.name + ", weight " + std::to_string(weight));
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
      const GridSpace alone = BuildGridSpace(surface.mesh, StableOptions().space);
      std::vector<Id> points;
      const MultiVector values = hold(surface.mesh, points);
      const ConstrainedSolution expected = solve(alone, HoldPoints(alone, points, values),
        { FieldAssociation::Points, VectorsAt(surface.mesh.points) });

      const Piece piece = PieceOf(surface.mesh, Dealing::Shuffled, false);
      const RankSpace space(ranks, piece.mesh, StableOptions());
      const RankLevels levels(space);
      points.clear();
      const MultiVector own = hold(piece.mesh, points);
      const ConstrainedSolution found = solve(levels, HoldPoints(space, points, own),
        { FieldAssociation::Points, VectorsAt(piece.mesh.points) });
      EXPECT_TRUE(found.report.converged);
      EXPECT_EQ(found.isExact, expected.isExact);
      EXPECT_EQ(found.steps, expected.steps);
      EXPECT_NEAR(found.misfit, expected.misfit, 1e-7);
      EXPECT_EQ(found.isHeld.size(), expected.isHeld.size());
      if (expected.isExact)
      {
        ExpectRows("values", levels.ValuesAtPoints(found.coefficients),
          alone.ValuesAtPoints(expected.coefficients), piece.points);
      }
    }
  }
}
