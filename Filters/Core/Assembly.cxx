// Patterns, values and prolongations of level matrices, row by row and without hash maps.
#include "Assembly.h"

#include "Parallel.h"

#include <utility>

namespace gridfem
{
namespace
{

/// Appends the distinct functions that share a patch with function f, ascending.
void AppendNeighbours(
  const Level& level, const FunctionPatches& patches, Index f, std::vector<Index>& columns)
{
  const auto first = static_cast<std::ptrdiff_t>(columns.size());
  for (Id k = patches.begin[f]; k < patches.begin[f + 1]; ++k)
  {
    const auto& dof = level.dof[patches.patch[k]];
    columns.insert(columns.end(), dof.begin(), dof.end());
  }
  std::sort(columns.begin() + first, columns.end());
  columns.erase(std::unique(columns.begin() + first, columns.end()), columns.end());
}

/// Fills a matrix from rows made block by block: row(r, columns, values) appends one row's entries.
template<class Row>
void FillRows(SparseMatrix& matrix, int threads, Row&& row)
{
  struct Part
  {
    std::vector<Index> column;
    std::vector<double> value;
  };
  const Id blocks = (Id(matrix.rows) + DefaultBlockSize - 1) / DefaultBlockSize;
  std::vector<Part> parts(blocks);
  matrix.rowBegin.assign(Id(matrix.rows) + 1, 0);
  ParallelRanges(matrix.rows, threads,
    [&](Id begin, Id end)
    {
      Part& part = parts[begin / DefaultBlockSize];
      for (Id r = begin; r < end; ++r)
      {
        const std::size_t before = part.column.size();
        row(static_cast<Index>(r), part.column, part.value);
        matrix.rowBegin[r] = static_cast<Id>(part.column.size() - before);
      }
    });
  const Id nonZeros = ExclusiveScan(matrix.rowBegin);
  matrix.column.resize(nonZeros);
  matrix.value.resize(nonZeros);
  ParallelBlocks(blocks, threads,
    [&](Id block)
    {
      const Id begin = matrix.rowBegin[block * DefaultBlockSize];
      Part part = std::move(parts[block]);
      std::copy(part.column.begin(), part.column.end(), matrix.column.begin() + begin);
      std::copy(part.value.begin(), part.value.end(), matrix.value.begin() + begin);
    });
}

/// Packed positions of the entries of each row of an element matrix.
struct RowEntries
{
  int entry[FunctionsPerPatch][FunctionsPerPatch];
};

constexpr RowEntries MakeRowEntries()
{
  RowEntries rows{};
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    for (int j = 0; j < FunctionsPerPatch; ++j)
    {
      rows.entry[i][j] = PackedIndex(i, j);
    }
  }
  return rows;
}

constexpr RowEntries Rows = MakeRowEntries();

/// What the rows of a level matrix are summed from.
struct ElementSum
{
  const Level& level;
  const FunctionPatches& patches;
  const ElementMatrix* mass; // null when its factor is 0
  double a;
  const ElementMatrix* stiffness; // null when its factor is 0
  double b;

  /// @param position  scratch, one per column: place of the column's entry in the row
  void FillRow(SparseMatrix& matrix, Index row, std::vector<Index>& position) const
  {
    const Id begin = matrix.rowBegin[row];
    const auto entries = static_cast<Index>(matrix.rowBegin[row + 1] - begin);
    double* value = matrix.value.data() + begin;
    for (Index k = 0; k < entries; ++k)
    {
      position[matrix.column[begin + k]] = k;
      value[k] = 0.0;
    }
    for (Id k = patches.begin[row]; k < patches.begin[row + 1]; ++k)
    {
      const Id patch = patches.patch[k];
      const int* entry = Rows.entry[patches.corner[k]];
      for (int j = 0; j < FunctionsPerPatch; ++j)
      {
        const double m = mass ? a * mass[patch][entry[j]] : 0.0;
        const double l = stiffness ? b * stiffness[patch][entry[j]] : 0.0;
        value[position[level.dof[patch][j]]] += m + l;
      }
    }
  }
};

/// First patch of every function and the function's corner in it.
std::vector<std::pair<Id, int>> FirstPatches(const Level& level)
{
  std::vector<std::pair<Id, int>> first(level.numberOfFunctions, { -1, 0 });
  for (Id patch = 0; patch < level.NumberOfPatches(); ++patch)
  {
    for (int corner = 0; corner < FunctionsPerPatch; ++corner)
    {
      auto& entry = first[level.dof[patch][corner]];
      if (entry.first < 0)
      {
        entry = { patch, corner };
      }
    }
  }
  return first;
}

} // namespace

FunctionPatches PatchesOfFunctions(const Level& level)
{
  FunctionPatches patches;
  patches.begin.assign(Id(level.numberOfFunctions) + 1, 0);
  for (const auto& dof : level.dof)
  {
    for (const Index f : dof)
    {
      ++patches.begin[f];
    }
  }
  const Id total = ExclusiveScan(patches.begin);
  patches.patch.resize(total);
  patches.corner.resize(total);
  std::vector<Id> next(patches.begin.begin(), patches.begin.end() - 1);
  for (Id patch = 0; patch < level.NumberOfPatches(); ++patch)
  {
    for (int corner = 0; corner < FunctionsPerPatch; ++corner)
    {
      const Id place = next[level.dof[patch][corner]]++;
      patches.patch[place] = patch;
      patches.corner[place] = static_cast<std::uint8_t>(corner);
    }
  }
  return patches;
}

SparseMatrix BuildPattern(const Level& level, const FunctionPatches& patches, int threads)
{
  SparseMatrix pattern;
  pattern.rows = pattern.columns = level.numberOfFunctions;
  FillRows(pattern, threads,
    [&](Index row, std::vector<Index>& columns, std::vector<double>&)
    { AppendNeighbours(level, patches, row, columns); });
  return pattern;
}

void AssembleValues(const Level& level, const FunctionPatches& patches,
  const std::vector<ElementMatrix>& mass, double a, const std::vector<ElementMatrix>& stiffness,
  double b, SparseMatrix& matrix, int threads)
{
  const ElementSum sum{ level, patches, a != 0.0 ? mass.data() : nullptr, a,
    b != 0.0 ? stiffness.data() : nullptr, b };
  const int team = NumberOfThreads(threads);
  // One table per thread, made before the threads start: their bodies then cannot throw.
  std::vector<std::vector<Index>> positions(team, std::vector<Index>(matrix.columns));
#pragma omp parallel for num_threads(team) schedule(dynamic, DefaultBlockSize)
  for (Index row = 0; row < matrix.rows; ++row)
  {
    sum.FillRow(matrix, row, positions[omp_get_thread_num()]);
  }
}

SparseMatrix BuildProlongation(const Level& fine, const Level& coarse, int threads)
{
  const std::vector<std::pair<Id, int>> first = FirstPatches(fine);
  SparseMatrix prolongation;
  prolongation.rows = fine.numberOfFunctions;
  prolongation.columns = coarse.numberOfFunctions;
  FillRows(prolongation, threads,
    [&](Index row, std::vector<Index>& columns, std::vector<double>& values)
    {
      const auto [patch, corner] = first[row];
      if (patch < 0)
      {
        return;
      }
      const auto& dof = coarse.dof[fine.parent[patch]];
      const auto& weights = ChildWeights(fine.Octant(patch))[corner];
      std::array<std::pair<Index, double>, FunctionsPerPatch> entries;
      for (int p = 0; p < FunctionsPerPatch; ++p)
      {
        entries[p] = { dof[p], weights[p] };
      }
      std::sort(entries.begin(), entries.end());
      for (const auto& [column, weight] : entries)
      {
        if (weight != 0.0)
        {
          columns.push_back(column);
          values.push_back(weight);
        }
      }
    });
  return prolongation;
}

} // namespace gridfem
