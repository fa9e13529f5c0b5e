// Distances along the pieces of several ranks equal the distances of one rank.
#include "Distance/StraightDistance.h"
#include "Largest.h"
#include "Parallel/RankDistance.h"
#include "Pieces.h"
#include "Spaces/GridSpace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// Options with heat that is exact to rounding, so that the order of its relaxation does not
/// matter.
DistanceOptions ExactDistance()
{
  DistanceOptions options;
  options.multigrid.threads = 1;
  options.heatChange = 1e-9;
  return options;
}

/// A triangle with sources at all corners, and one more source.
std::vector<char> SourcesOf(const TriangleMesh& mesh)
{
  std::vector<char> isSource(mesh.points.size(), 0);
  for (const Id corner : mesh.triangles.front())
  {
    isSource[corner] = 1;
  }
  isSource[mesh.triangles[mesh.triangles.size() / 2][1]] = 1;
  return isSource;
}

MultiVector ColumnOf(const std::vector<double>& numbers)
{
  return Eigen::Map<const Eigen::VectorXd>(
    numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

/// Expects that points of several ranks have the same bits on all of them.
void ExpectOneValue(const Communicator& ranks, const Piece& piece, const MultiVector& values,
  std::size_t pointsOfWhole)
{
  std::vector<double> low(pointsOfWhole, 1e300);
  std::vector<double> high(pointsOfWhole, -1e300);
  for (std::size_t k = 0; k < piece.points.size(); ++k)
  {
    const double value = values(static_cast<Id>(k), 0);
    low[piece.points[k]] = high[piece.points[k]] = std::isnan(value) ? -1.0 : value;
  }
  ranks.Minimum(low.data(), static_cast<Id>(low.size()));
  ranks.Maximum(high.data(), static_cast<Id>(high.size()));
  for (std::size_t k = 0; k < low.size(); ++k)
  {
    EXPECT_TRUE(low[k] == high[k] || low[k] > high[k])
      << "point " << k; // the latter: no rank has the point
  }
}

void CompareDistances(
  const NamedSurface& surface, Dealing dealing, int depth, bool byAll, bool hasHats)
{
  SCOPED_TRACE(surface.name + (hasHats ? ", hats" : ""));
  const Communicator ranks(MPI_COMM_WORLD);
  RankSpaceOptions options = Options(depth);
  options.space.normalStabilization = 0.1;
  options.space.functions.joinAtPoints = true;
  const auto mesh = std::make_shared<const TriangleMesh>(surface.mesh);
  const std::vector<char> isSource = SourcesOf(*mesh);
  std::vector<Id> sources;
  for (std::size_t k = 0; k < isSource.size(); ++k)
  {
    if (isSource[k])
    {
      sources.push_back(static_cast<Id>(k));
    }
  }
  const GeodesicDistance alone(WholeSpace(*mesh, options, hasHats), mesh, ExactDistance());
  const DistanceField expected = alone.From(sources, Exactly().solve);
  ASSERT_TRUE(expected.report.converged);

  const Piece piece = PieceOf(surface.mesh, dealing, false);
  std::vector<double> first(isSource.size(), ranks.Size()); // first rank that has each point
  for (const Id point : piece.points)
  {
    first[point] = ranks.Rank();
  }
  ranks.Minimum(first.data(), static_cast<Id>(first.size()));
  std::vector<Id> own;
  for (std::size_t k = 0; k < piece.points.size(); ++k)
  {
    if (isSource[piece.points[k]] && (byAll || first[piece.points[k]] == ranks.Rank()))
    {
      own.push_back(static_cast<Id>(k));
    }
  }
  const RankSurface pieces(ranks, piece.mesh, options, hasHats);
  const RankDistance distance(
    pieces.Levels(), std::make_shared<const TriangleMesh>(piece.mesh), ExactDistance());
  const DistanceField found = distance.From(own, Exactly().solve);
  EXPECT_TRUE(found.report.converged);
  EXPECT_EQ(found.unreached, 0);
  const MultiVector values = ColumnOf(found.atPoints);
  ExpectRows("distance", values, ColumnOf(expected.atPoints), piece.points);
  ExpectOneValue(ranks, piece, values, mesh->points.size());
  const std::vector<double> straight =
    DistancesThroughSpace(*mesh, RimOfSources(*mesh, isSource, 1), 1);
  for (std::size_t k = 0; k < piece.points.size(); ++k)
  {
    const double bound = isSource[piece.points[k]] ? 0.0 : straight[piece.points[k]];
    ASSERT_FALSE(found.atPoints[k] < (1.0 - 1e-14) * bound) << k; // NaN beyond all sources
  }
}

} // namespace

TEST(RankDistance, DistancesAreThoseOfOneRank)
{
  for (const int surface : { 0, 2, 4 })
  {
    CompareDistances(Surfaces()[surface], Dealing::Shuffled, 4, true, false);
  }
  CompareDistances(Surfaces()[1], Dealing::Contiguous, 4, false, false);
}

TEST(RankDistance, DistancesOfHatsAreThoseOfOneRank)
{
  CompareDistances(Surfaces()[0], Dealing::Contiguous, 4, false, true);
  CompareDistances(Surfaces()[2], Dealing::Shuffled, 4, true, true);
}

/// Between sources that are close to each other heat falls slowly, so its rounding shows most.
TEST(RankDistance, AreAsExactAsThoseOfOneRank)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const auto mesh = std::make_shared<const TriangleMesh>(Surfaces()[1].mesh);
  const Piece piece = PieceOf(*mesh, Dealing::Contiguous, false);
  const auto isSource = [&](Id point) { return point % 9 == 0 && mesh->points[point][0] > 0.3; };
  std::vector<Id> sources;
  for (Id point = 0; point < static_cast<Id>(mesh->points.size()); ++point)
  {
    if (isSource(point))
    {
      sources.push_back(point);
    }
  }
  std::vector<Id> own;
  for (std::size_t k = 0; k < piece.points.size(); ++k)
  {
    if (isSource(piece.points[k]))
    {
      own.push_back(static_cast<Id>(k));
    }
  }
  RankSpaceOptions options = Options(4);
  options.space.normalStabilization = 0.1;
  options.space.functions.joinAtPoints = true;
  const auto whole = std::make_shared<GridSpace>(BuildGridSpace(*mesh, options.space));
  DistanceOptions usual = ExactDistance();
  usual.heatChange = DistanceOptions().heatChange;
  const MultiVector exact = ColumnOf(
    GeodesicDistance(whole, mesh, ExactDistance()).From(sources, Exactly().solve).atPoints);
  const MultiVector ofOne =
    ColumnOf(GeodesicDistance(whole, mesh, usual).From(sources, Exactly().solve).atPoints);
  const RankSpace space(ranks, piece.mesh, options);
  const RankLevels levels(space);
  const RankDistance distance(levels, std::make_shared<const TriangleMesh>(piece.mesh), usual);
  const MultiVector found = ColumnOf(distance.From(own, Exactly().solve).atPoints);
  double error = 0.0;
  for (std::size_t k = 0; k < piece.points.size(); ++k)
  {
    error = Larger(error, std::abs(found(static_cast<Id>(k), 0) - exact(piece.points[k], 0)));
  }
  ranks.Maximum(&error, 1);
  const double errorOfOne = (ofOne - exact).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  EXPECT_GT(errorOfOne, 0.0);
  EXPECT_LE(error, 2.0 * errorOfOne + 2e-4 * exact.maxCoeff<Eigen::PropagateNaN>()) << errorOfOne;
  RecordProperty("ErrorOfOne", std::to_string(errorOfOne));
  RecordProperty("Error", std::to_string(error));
}

TEST(RankDistance, NoSourceIsRefusedOnAllRanks)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const Piece piece = PieceOf(Surfaces().front().mesh, Dealing::Contiguous, false);
  const RankSpace space(ranks, piece.mesh, Options(4));
  const RankLevels levels(space);
  const RankDistance distance(
    levels, std::make_shared<const TriangleMesh>(piece.mesh), ExactDistance());
  EXPECT_THROW(distance.From({}, Exactly().solve), InvalidInput);
}
