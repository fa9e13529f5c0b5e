// Hat functions on several ranks equal the hat functions of one rank, with the same matrices and
// prolongation.
#include "Parallel/RankSurface.h"
#include "Pieces.h"
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

/// The number in the whole of each hat on this rank.
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

/// Compares sums of the ranks' entries, to 1e-12 of the largest.
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

/// A different number for each function, according to its corner of the grid.
MultiVector NumbersAtCorners(const PatchLevel& level)
{
  MultiVector numbers = MultiVector::Zero(level.numberOfFunctions, 1);
  for (std::size_t patch = 0; patch < level.cell.size(); ++patch)
  {
    const CellIndex cell = MortonDecode(level.cell[patch]);
    for (int corner = 0; corner < FunctionsPerPatch; ++corner)
    {
      const double x = cell[0] + (corner & 1);
      const double y = cell[1] + (corner >> 1 & 1);
      const double z = cell[2] + (corner >> 2);
      numbers(level.dof[patch][corner], 0) = std::sin(1.7 * x + 2.9 * y + 4.3 * z);
    }
  }
  return numbers;
}

/// Compares the weights that all ranks add up, by their products with numbers at the corners of the
/// grid.
void CompareProlongations(const RankSurface& surface, const HatSpace& whole)
{
  const RankLevels& levels = surface.Levels();
  MultiVector found;
  Multiply(levels.Prolongation(0),
    NumbersAtCorners(levels.Hats()->Own().Grid().Functions().levels.front()), found, 1);
  SumProlonged<double>(levels.Distributed(0), found);
  MultiVector expected;
  Multiply(
    whole.Prolongation(0), NumbersAtCorners(whole.Grid().Functions().levels.front()), expected, 1);
  const std::vector<Index> hats = HatsOfWhole(surface, whole);
  for (Index hat = 0; hat < static_cast<Index>(hats.size()); ++hat)
  {
    ASSERT_NEAR(found(hat, 0), expected(hats[hat], 0), 1e-12) << "hat " << hat;
  }
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
      CompareProlongations(own, whole);
      EXPECT_EQ(own.Levels().ComponentsOf(0).count, whole.ComponentsOf(0).count);
    }
  }
}
