// The space on several ranks equals the space of one rank: the same patches and functions on every
// level, and the same entries of M, L and the prolongations.
#include "Largest.h"
#include "Meshes.h"
#include "Parallel/RankLevels.h"
#include "Solvers/MemoryEstimate.h"
#include "Solvers/Requirements.h"
#include "Surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr int Depth = 5;

RankSpaceOptions Options(bool connectivityAware, int granularity)
{
  RankSpaceOptions options = gridfem::testing::Options(Depth);
  options.space.functions.connectivityAware = connectivityAware;
  options.space.coarsestSize = 0;
  options.granularity = granularity;
  return options;
}

struct Entry
{
  Id row;
  Id column;
  double value;
};

/// A level gathered from all ranks. Making it is collective.
struct GatheredLevel
{
  std::vector<MortonKey> cells;
  std::vector<Id> numbers; // numbers of the functions, eight per patch
  Id total = 0;
  std::vector<Entry> mass;
  std::vector<Entry> stiffness;
  std::vector<Entry> prolongation;
};

Id NumberOf(const RankSpace& space, std::size_t level, Index function)
{
  return level < space.Numberings().size() ? space.Numberings()[level].number[function] : function;
}

std::vector<Entry> EntriesOf(const RankSpace& space, const SparseMatrix& own, Index firstRow,
  std::size_t rowLevel, std::size_t columnLevel)
{
  std::vector<Entry> entries;
  for (Index row = firstRow; row < own.rows; ++row)
  {
    for (Id k = own.rowBegin[row]; k < own.rowBegin[row + 1]; ++k)
    {
      entries.push_back({ NumberOf(space, rowLevel, row),
        NumberOf(space, columnLevel, own.column[k]), own.value[k] });
    }
  }
  return entries;
}

std::vector<Id> NumbersOf(const RankSpace& space, const PatchLevel& own, std::size_t level)
{
  std::vector<Id> numbers;
  for (const auto& dof : own.dof)
  {
    for (const Index function : dof)
    {
      numbers.push_back(NumberOf(space, level, function));
    }
  }
  return numbers;
}

GatheredLevel GatherDivided(const RankSpace& space, std::size_t l)
{
  const Communicator& ranks = space.Ranks();
  const GridSpace& own = space.Own();
  GatheredLevel level;
  level.cells = ranks.Gather(own.Functions().levels[l].cell);
  level.numbers = ranks.Gather(NumbersOf(space, own.Functions().levels[l], l));
  level.total = space.Numberings()[l].total;
  level.mass = ranks.Gather(EntriesOf(space, own.Matrix(l, 1.0, 0.0, 1), 0, l, l));
  level.stiffness = ranks.Gather(EntriesOf(space, own.Matrix(l, 0.0, 1.0, 1), 0, l, l));
  level.prolongation =
    ranks.Gather(EntriesOf(space, own.Prolongation(l), space.Numberings()[l].ghosts, l, l + 1));
  return level;
}

/// Takes a level that each rank holds whole.
GatheredLevel TakeShared(const RankSpace& space, std::size_t l)
{
  const GridSpace& shared = space.Shared();
  const std::size_t there = l - space.Numberings().size();
  GatheredLevel level;
  level.cells = shared.Functions().levels[there].cell;
  level.numbers = NumbersOf(space, shared.Functions().levels[there], l);
  level.total = shared.NumberOfFunctions(there);
  level.mass = EntriesOf(space, shared.Matrix(there, 1.0, 0.0, 1), 0, l, l);
  level.stiffness = EntriesOf(space, shared.Matrix(there, 0.0, 1.0, 1), 0, l, l);
  if (there + 1 < shared.NumberOfLevels())
  {
    level.prolongation = EntriesOf(space, shared.Prolongation(there), 0, l, l + 1);
  }
  return level;
}

std::vector<GatheredLevel> GatherLevels(const RankSpace& space)
{
  const std::size_t distributed = space.Numberings().size();
  std::vector<GatheredLevel> levels;
  for (std::size_t l = 0; l < distributed + space.Shared().NumberOfLevels(); ++l)
  {
    levels.push_back(l < distributed ? GatherDivided(space, l) : TakeShared(space, l));
  }
  return levels;
}

using Numbers = std::vector<Index>; // the function of the whole for each number

/// Matches functions by their corners, because patches are in the same order everywhere.
void MatchFunctions(const GatheredLevel& level, const PatchLevel& whole, Numbers& functionOf)
{
  ASSERT_EQ(level.cells, whole.cell);
  ASSERT_EQ(level.total, whole.numberOfFunctions);
  functionOf.assign(level.total, -1);
  for (std::size_t k = 0; k < level.numbers.size(); ++k)
  {
    const Index function = whole.dof[k / FunctionsPerPatch][k % FunctionsPerPatch];
    Index& known = functionOf[level.numbers[k]];
    ASSERT_TRUE(known < 0 || known == function) << "function " << function;
    known = function;
  }
  Numbers sorted = functionOf;
  std::sort(sorted.begin(), sorted.end());
  for (Index k = 0; k < whole.numberOfFunctions; ++k)
  {
    ASSERT_EQ(sorted[k], k);
  }
}

/// Adds up entries at one place, and compares them to 1e-12 of the largest.
void CompareEntries(std::vector<Entry> entries, const SparseMatrix& whole, const Numbers& rows,
  const Numbers& columns)
{
  double largest = 0.0;
  for (const double value : whole.value)
  {
    largest = Larger(largest, std::abs(value));
  }
  for (Entry& entry : entries)
  {
    entry = { rows[entry.row], columns[entry.column], entry.value };
  }
  std::sort(entries.begin(), entries.end(),
    [](const Entry& a, const Entry& b)
    { return a.row != b.row ? a.row < b.row : a.column < b.column; });
  std::size_t next = 0;
  for (Index row = 0; row < whole.rows; ++row)
  {
    for (Id k = whole.rowBegin[row]; k < whole.rowBegin[row + 1]; ++k)
    {
      double sum = 0.0;
      const std::size_t first = next;
      while (next < entries.size() && entries[next].row == row &&
             entries[next].column == whole.column[k])
      {
        sum += entries[next++].value;
      }
      ASSERT_GT(next, first) << "row " << row;
      ASSERT_NEAR(sum, whole.value[k], 1e-12 * largest) << "row " << row;
    }
  }
  ASSERT_EQ(next, entries.size());
}

void Compare(const std::vector<GatheredLevel>& levels, const GridSpace& whole)
{
  ASSERT_EQ(levels.size(), whole.NumberOfLevels());
  std::vector<Numbers> functionOf(levels.size());
  for (std::size_t l = 0; l < levels.size(); ++l)
  {
    SCOPED_TRACE("level " + std::to_string(l));
    ASSERT_NO_FATAL_FAILURE(MatchFunctions(levels[l], whole.Functions().levels[l], functionOf[l]));
  }
  for (std::size_t l = 0; l < levels.size(); ++l)
  {
    SCOPED_TRACE("level " + std::to_string(l));
    CompareEntries(levels[l].mass, whole.Matrix(l, 1.0, 0.0, 1), functionOf[l], functionOf[l]);
    CompareEntries(levels[l].stiffness, whole.Matrix(l, 0.0, 1.0, 1), functionOf[l], functionOf[l]);
    if (l + 1 < levels.size())
    {
      CompareEntries(
        levels[l].prolongation, whole.Prolongation(l), functionOf[l], functionOf[l + 1]);
    }
  }
}

/// The mesh of all ranks, in the order of their triangles.
TriangleMesh WholeOf(const TriangleMesh& mesh, const std::vector<int>& rankOf, int ranks)
{
  TriangleMesh whole;
  for (int rank = 0; rank < ranks; ++rank)
  {
    const TriangleMesh part = PartOf(mesh, rankOf, rank);
    const auto first = static_cast<Id>(whole.points.size());
    whole.points.insert(whole.points.end(), part.points.begin(), part.points.end());
    for (const auto& t : part.triangles)
    {
      whole.triangles.push_back({ first + t[0], first + t[1], first + t[2] });
    }
  }
  return whole;
}

/// Compares with a space on one rank. The first rank does the comparison.
void CompareWithOneRank(const TriangleMesh& mesh, Dealing dealing, const RankSpaceOptions& options)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const std::vector<int> rankOf = Deal(mesh, dealing, ranks.Size());
  const RankSpace space(ranks, PartOf(mesh, rankOf, ranks.Rank()), options);
  const std::vector<GatheredLevel> levels = GatherLevels(space);
  if (ranks.Rank() == 0)
  {
    Compare(levels, BuildGridSpace(WholeOf(mesh, rankOf, ranks.Size()), options.space));
  }
}

/// Exchanges values of every function between all ranks that touch it, in more columns than a
/// message has.
template<class Real>
void ExchangeRows(const RankLevels& levels, const LevelNumbering& numbering, std::size_t level)
{
  constexpr Id Columns = 40;
  const DistributedRows& rows = *levels.Distributed(level);
  Vectors<Real> parts(numbering.Functions(), Columns);
  Vectors<Real> numbers(numbering.Functions(), Columns);
  for (Index f = 0; f < numbering.Functions(); ++f)
  {
    const bool isOwn = f >= numbering.ghosts;
    const auto number = static_cast<Real>(numbering.number[f]); // small enough to keep all digits
    for (Id c = 0; c < Columns; ++c)
    {
      parts(f, c) = Real(c) + number;
      numbers(f, c) = isOwn ? Real(c) + number : Real(-1);
    }
  }
  const Vectors<Real> own = parts;
  rows.Sum(parts);
  rows.TakeGhosts(numbers);
  for (Index f = 0; f < numbering.Functions(); ++f)
  {
    ASSERT_TRUE(parts.row(f) == Real(numbering.touching[f]) * own.row(f)) << "function " << f;
    ASSERT_TRUE(numbers.row(f) == own.row(f)) << "function " << f;
  }
}

} // namespace

TEST(RankSpace, IsThatOfOneRankHoweverTrianglesAreDealt)
{
  for (const NamedSurface& surface : Surfaces())
  {
    for (const Dealing dealing : Dealings)
    {
      SCOPED_TRACE(surface.name + ", dealing " + std::to_string(static_cast<int>(dealing)));
      CompareWithOneRank(surface.mesh, dealing, Options(true, 3));
    }
  }
}

TEST(RankSpace, HasTheSuggestedDepthOfOneRank)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const TriangleMesh mesh = Transform(FlatRectangle(300, 300), { 1, 2, 3 }, 0.4);
  const int suggested = SuggestedDepth(mesh);
  ASSERT_GT(suggested, CoarsestSuggestion);
  for (const Dealing dealing : { Dealing::OneRank, Dealing::Contiguous })
  {
    RankSpaceOptions options = gridfem::testing::Options(AutomaticDepth);
    options.granularity = 0;
    const RankSpace space(
      ranks, PartOf(mesh, Deal(mesh, dealing, ranks.Size()), ranks.Rank()), options);
    EXPECT_EQ(space.Own().Functions().GetGrid().depth, suggested);
  }
}

TEST(RankSpace, RowsOfAllRanksAreAddedUpAndHandedOver)
{
  const Communicator ranks(MPI_COMM_WORLD);
  for (const NamedSurface& surface : Surfaces())
  {
    SCOPED_TRACE(surface.name);
    const std::vector<int> rankOf = Deal(surface.mesh, Dealing::Shuffled, ranks.Size());
    const RankSpace space(ranks, PartOf(surface.mesh, rankOf, ranks.Rank()), Options(true, 2));
    const RankLevels levels(space);
    for (std::size_t l = 0; l < space.Numberings().size(); ++l)
    {
      ExchangeRows<float>(levels, space.Numberings()[l], l);
      ExchangeRows<double>(levels, space.Numberings()[l], l);
    }
  }
}

TEST(RankSpace, IsThatOfOneRankWhateverTheBlocks)
{
  for (const NamedSurface& surface : Surfaces())
  {
    for (const int granularity : { 0, 4 })
    {
      SCOPED_TRACE(surface.name + ", granularity " + std::to_string(granularity));
      CompareWithOneRank(surface.mesh, Dealing::Contiguous, Options(true, granularity));
    }
  }
}

TEST(RankSpace, PlainFunctionsAreThoseOfOneRank)
{
  for (const NamedSurface& surface : Surfaces())
  {
    SCOPED_TRACE(surface.name);
    CompareWithOneRank(surface.mesh, Dealing::Contiguous, Options(false, 3));
  }
}
