// Hat functions on several ranks are those of one rank: the same matrices and prolongation, and the
// same solutions at every point.
#include "Parallel/RankSurface.h"
#include "Pieces.h"
#include "Problems/Poisson.h"
#include "Spaces/HatSpace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

HatSpace HatsOf(const TriangleMesh& mesh, const RankSpaceOptions& options)
{
  return BuildHatSpace(mesh, options.space);
}

/// Per hat here, that of the whole.
std::vector<Index> HatsOfWhole(const RankSurface& surface, const HatSpace& whole)
{
  using Position = std::array<double, 3>;
  const auto position = [](const Vec3& point) { return Position{ point[0], point[1], point[2] }; };
  std::map<Position, Index> hatAt;
  const TriangleMesh& mesh = whole.Grid().Mesh();
  for (std::size_t point = 0; point < mesh.points.size(); ++point)
  {
    hatAt[position(mesh.points[point])] = whole.Hats().functions.ofPoint[point];
  }
  const HatSpace& own = surface.Levels().Hats()->Own();
  std::vector<Index> hats(own.NumberOfFunctions(0), -1);
  const TriangleMesh& received = own.Grid().Mesh();
  for (std::size_t point = 0; point < received.points.size(); ++point)
  {
    const Index hat = own.Hats().functions.ofPoint[point];
    if (hat >= 0)
    {
      hats[hat] = hatAt.at(position(received.points[point]));
    }
  }
  return hats;
}

/// Sums of the ranks' entries, to 1e-12 of the largest.
void CompareMatrices(const RankSurface& surface, const HatSpace& whole)
{
  const Communicator& ranks = surface.Space().Ranks();
  const RankLevels& levels = surface.Levels();
  const std::vector<Index> hats = HatsOfWhole(surface, whole);
  ASSERT_EQ(levels.NumberOfFunctions(0), whole.NumberOfFunctions(0));
  for (const bool isMass : { true, false })
  {
    const SparseMatrix own = levels.Matrix(0, isMass, !isMass, 1);
    const SparseMatrix expected = whole.Matrix(0, isMass, !isMass, 1);
    struct Entry
    {
      Index row;
      Index column;
      double value;
    };
    std::vector<Entry> entries;
    for (Index row = 0; row < own.rows; ++row)
    {
      for (Id k = own.rowBegin[row]; k < own.rowBegin[row + 1]; ++k)
      {
        entries.push_back({ hats[row], hats[own.column[k]], own.value[k] });
      }
    }
    std::map<std::pair<Index, Index>, double> sum;
    for (const Entry& entry : ranks.Gather(entries))
    {
      sum[{ entry.row, entry.column }] += entry.value;
    }
    const double largest = *std::max_element(expected.value.begin(), expected.value.end());
    ASSERT_EQ(static_cast<Id>(sum.size()), expected.NonZeros());
    for (Index row = 0; row < expected.rows; ++row)
    {
      for (Id k = expected.rowBegin[row]; k < expected.rowBegin[row + 1]; ++k)
      {
        ASSERT_NEAR(sum.at({ row, expected.column[k] }), expected.value[k], 1e-12 * largest);
      }
    }
  }
}

/// Weights of all ranks.
void ExpectSumsOfOne(const RankSurface& surface)
{
  const RankLevels& levels = surface.Levels();
  MultiVector ones = MultiVector::Ones(levels.Prolongation(0)->columns, 1);
  MultiVector fine;
  Multiply(levels.Prolongation(0), ones, fine, 1);
  SumProlonged<double>(levels.Divided(0), fine);
  EXPECT_LE((fine.array() - 1.0).abs().maxCoeff(), 1e-14);
}

} // namespace

TEST(RankHats, MatricesAreThoseOfOneRankHoweverTrianglesAreDealt)
{
  const Communicator ranks(MPI_COMM_WORLD);
  for (const NamedSurface& surface : Surfaces())
  {
    const HatSpace whole = HatsOf(surface.mesh, Options(4));
    for (const Dealing dealing : Dealings)
    {
      SCOPED_TRACE(surface.name + ", dealing " + std::to_string(static_cast<int>(dealing)));
      const Piece piece = PieceOf(surface.mesh, dealing, false);
      const RankSurface own(ranks, piece.mesh, Options(4), true);
      CompareMatrices(own, whole);
      ExpectSumsOfOne(own);
      EXPECT_EQ(own.Levels().ComponentsOf(0).count, whole.ComponentsOf(0).count);
    }
  }
}

TEST(RankHats, PoissonHasTheSolutionOfOneRank)
{
  const Communicator ranks(MPI_COMM_WORLD);
  for (const NamedSurface& surface : Surfaces())
  {
    SCOPED_TRACE(surface.name);
    PoissonOptions options;
    options.screeningWeight = 0.05;
    options.multigrid.threads = 1;
    options.solve.tolerance = 1e-10;
    options.solve.maximumIterations = 300;
    const auto solve = [&](const SurfaceSpace& space, const TriangleMesh& mesh, int& iterations)
    {
      const Field f{ FieldAssociation::Points, VectorsAt(mesh.points) };
      const Multigrid multigrid = BuildMultigrid(space, 0.05, 1.0, options.multigrid);
      const PoissonSolution solution = SolvePoisson(
        space, multigrid, space.LoadOfValues(f), space.LoadOfGradientsOf(f, nullptr), options);
      EXPECT_TRUE(solution.report.converged);
      iterations = solution.report.iterations;
      return space.ValuesAtPoints(solution.coefficients);
    };
    int iterations = 0;
    int ofRanks = 0;
    const MultiVector expected = solve(HatsOf(surface.mesh, Options(4)), surface.mesh, iterations);
    const Piece piece = PieceOf(surface.mesh, Dealing::Shuffled, false);
    const RankSurface own(ranks, piece.mesh, Options(4), true);
    ExpectRows("values", solve(own.Levels(), piece.mesh, ofRanks), expected, piece.points);
    EXPECT_LE(ofRanks, 2 + 1.3 * iterations); // triangles longer than cells share all hats
  }
}
