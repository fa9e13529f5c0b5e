// The space on several ranks is that of one rank: the same patches and functions on every level, the
// same entries of M, L and the prolongations.
#include "Parallel/RankSpace.h"
#include "Surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr int Depth = 5;

RankSpaceOptions Options(bool connectivityAware, int granularity)
{
  RankSpaceOptions options;
  options.space.functions.depth = Depth;
  options.space.functions.connectivityAware = connectivityAware;
  options.space.functions.threads = 1;
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

using Entries = std::map<std::pair<Id, Id>, double>;

Entries SumOf(const std::vector<Entry>& entries)
{
  Entries sum;
  for (const Entry& entry : entries)
  {
    sum[{ entry.row, entry.column }] += entry.value;
  }
  return sum;
}

/// Compares with the space of the whole surface.
class Comparison
{
public:
  Comparison(const RankSpace& space, const GridSpace& whole)
    : space_(space), whole_(whole), divided_(space.Numberings().size()), numbers_(divided_ + 1)
  {
    for (std::size_t l = 0; l <= divided_; ++l)
    {
      this->MatchFunctions(l);
    }
  }

  void CheckMatrices()
  {
    for (std::size_t l = 0; l < divided_; ++l)
    {
      this->CheckMatrix(l, 1.0, 0.0);
      this->CheckMatrix(l, 0.0, 1.0);
      this->CheckProlongation(l);
    }
  }

private:
  Id NumberOf(std::size_t level, Index function) const
  {
    return level < divided_ ? space_.Numberings()[level].number[function] : function;
  }

  /// Patches are in the same order everywhere, so that functions are matched by their corners.
  void MatchFunctions(std::size_t l)
  {
    const PatchLevel& own = space_.Own().Functions().levels[l];
    const PatchLevel& whole = whole_.Functions().levels[l];
    const auto cells = space_.Ranks().Gather(own.cell);
    ASSERT_EQ(cells, whole.cell) << "level " << l;
    std::vector<Id> numbers;
    for (const auto& dof : own.dof)
    {
      for (const Index function : dof)
      {
        numbers.push_back(this->NumberOf(l, function));
      }
    }
    numbers = space_.Ranks().Gather(numbers);
    const Id total = l < divided_ ? space_.Numberings()[l].total
                                  : space_.Shared().levels.front().numberOfFunctions;
    ASSERT_EQ(total, whole.numberOfFunctions) << "level " << l;
    numbers_[l].assign(total, -1);
    for (std::size_t k = 0; k < numbers.size(); ++k)
    {
      const Index function = whole.dof[k / FunctionsPerPatch][k % FunctionsPerPatch];
      Id& known = numbers_[l][function];
      ASSERT_TRUE(known < 0 || known == numbers[k]) << "level " << l << ", function " << function;
      known = numbers[k];
    }
    std::vector<Id> sorted = numbers_[l];
    std::sort(sorted.begin(), sorted.end());
    ASSERT_TRUE(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) << "level " << l;
  }

  void Compare(const std::vector<Entry>& own, const SparseMatrix& expected, std::size_t rowLevel,
    std::size_t columnLevel, double tolerance) const
  {
    const Entries found = SumOf(space_.Ranks().Gather(own));
    ASSERT_EQ(static_cast<Id>(found.size()), expected.NonZeros());
    for (Index row = 0; row < expected.rows; ++row)
    {
      for (Id k = expected.rowBegin[row]; k < expected.rowBegin[row + 1]; ++k)
      {
        const auto entry = found.find(
          { numbers_[rowLevel][row], numbers_[columnLevel][expected.column[k]] });
        ASSERT_TRUE(entry != found.end()) << "level " << rowLevel << ", row " << row;
        ASSERT_NEAR(entry->second, expected.value[k], tolerance)
          << "level " << rowLevel << ", row " << row;
      }
    }
  }

  void CheckMatrix(std::size_t l, double a, double b) const
  {
    SparseMatrix own;
    space_.Own().FillMatrix(l, a, b, own, 1);
    std::vector<Entry> entries;
    for (Index row = 0; row < own.rows; ++row)
    {
      for (Id k = own.rowBegin[row]; k < own.rowBegin[row + 1]; ++k)
      {
        entries.push_back(
          { this->NumberOf(l, row), this->NumberOf(l, own.column[k]), own.value[k] });
      }
    }
    SparseMatrix expected;
    whole_.FillMatrix(l, a, b, expected, 1);
    double largest = 0.0;
    for (const double value : expected.value)
    {
      largest = std::max(largest, std::abs(value));
    }
    this->Compare(entries, expected, l, l, 1e-12 * largest);
  }

  void CheckProlongation(std::size_t l) const
  {
    const SparseMatrix& own = space_.Own().Prolongation(l);
    std::vector<Entry> entries;
    for (Index row = space_.Numberings()[l].foreign; row < own.rows; ++row)
    {
      for (Id k = own.rowBegin[row]; k < own.rowBegin[row + 1]; ++k)
      {
        entries.push_back(
          { this->NumberOf(l, row), this->NumberOf(l + 1, own.column[k]), own.value[k] });
      }
    }
    this->Compare(entries, whole_.Prolongation(l), l, l + 1, 1e-14);
  }

  const RankSpace& space_;
  const GridSpace& whole_;
  std::size_t divided_;
  std::vector<std::vector<Id>> numbers_; // of the functions of the whole
};

/// What all ranks hold together, in the order of their triangles.
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

void CompareWithOneRank(
  const TriangleMesh& mesh, Dealing dealing, const RankSpaceOptions& options)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const std::vector<int> rankOf = Deal(mesh, dealing, ranks.Size());
  const GridSpace whole = BuildGridSpace(WholeOf(mesh, rankOf, ranks.Size()), options.space);
  const RankSpace space(ranks, PartOf(mesh, rankOf, ranks.Rank()), options);
  Comparison comparison(space, whole);
  if (!::testing::Test::HasFatalFailure())
  {
    comparison.CheckMatrices();
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

TEST(RankSpace, IsThatOfOneRankWhateverTheBlocks)
{
  for (const NamedSurface& surface : Surfaces())
  {
    for (const int granularity : { 0, 1, 2, 4 })
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
