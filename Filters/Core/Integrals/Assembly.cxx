// Builds patterns, values and prolongations of level matrices, row by row and without hash maps.
#include "Integrals/Assembly.h"

#include "Algebra/FillRows.h"
#include "Base/Prefetch.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace gridfem
{
namespace
{

/// Number of grid corners around a grid corner, including itself. NumberAround gives the number of
/// corner j of a cell as seen from corner i.
constexpr int CornersAround = 27;

constexpr int NumberAround(int i, int j)
{
  int number = 0;
  for (int axis = 2; axis >= 0; --axis)
  {
    number = 3 * number + ((j >> axis) & 1) - ((i >> axis) & 1) + 1;
  }
  return number;
}

/// A number for every two corners of a cell.
struct CornerTable
{
  int number[FunctionsPerPatch][FunctionsPerPatch];
};

template<class Number>
constexpr CornerTable MakeCornerTable(Number number)
{
  CornerTable table{};
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    for (int j = 0; j < FunctionsPerPatch; ++j)
    {
      table.number[i][j] = number(i, j);
    }
  }
  return table;
}

constexpr CornerTable Around = MakeCornerTable(NumberAround);

/// Packed positions of the entries of each row of an element matrix.
constexpr CornerTable Rows = MakeCornerTable(PackedIndex);

/// Sorts distinct numbers by counting the smaller numbers for each. This needs no branch to be
/// predicted.
void SortFew(Index* begin, Index* end)
{
  constexpr int Few = 32;
  const auto count = static_cast<int>(end - begin);
  if (count > Few)
  {
    std::sort(begin, end);
    return;
  }
  std::array<Index, Few> item;
  item.fill(std::numeric_limits<Index>::max());
  std::copy(begin, end, item.begin());
  for (int i = 0; i < count; ++i)
  {
    int smaller = 0;
    for (const Index other : item)
    {
      smaller += other < item[i] ? 1 : 0;
    }
    begin[smaller] = item[i];
  }
}

/// Appends the distinct functions that share a patch with function f, ascending. Most surrounding
/// grid corners have only one such function, so most repetitions are recognized by their corner.
void AppendNeighbours(
  const PatchLevel& level, const FunctionPlaces& places, Index f, Array<Index>& columns)
{
  const std::size_t first = columns.size();
  std::array<Index, CornersAround> known;
  known.fill(-1);
  for (Index k = places.begin[f]; k < places.begin[f + 1]; ++k)
  {
    const auto& dof = level.dof[places.item[k] / FunctionsPerPatch];
    const int* const around = Around.number[places.item[k] % FunctionsPerPatch];
    for (int j = 0; j < FunctionsPerPatch; ++j)
    {
      Index& here = known[around[j]];
      const bool isFirst = here < 0;
      if (here == dof[j] ||
          (!isFirst && std::find(columns.begin() + first, columns.end(), dof[j]) != columns.end()))
      {
        continue;
      }
      here = isFirst ? dof[j] : here;
      columns.push_back(dof[j]);
    }
  }
  SortFew(columns.data() + first, columns.data() + columns.size());
}

/// Computes the rows of a level matrix as sums over elements.
struct ElementSum
{
  const PatchLevel& level;
  const FunctionPlaces& places;
  const ElementMatrix* mass; // null if its factor is 0
  double a;
  const ElementMatrix* stiffness; // null if its factor is 0
  double b;

  /// Prefetches the matrices of the last patch of a row. Earlier rows may not have used this patch.
  EIGEN_ALWAYS_INLINE void FetchLast(Index row) const
  {
    const Index end = places.begin[row + 1];
    if (end == 0)
    {
      return;
    }
    const Index patch = places.item[end - 1] / FunctionsPerPatch;
    for (const ElementMatrix* const matrices : { mass, stiffness })
    {
      if (matrices)
      {
        FetchAll(matrices[patch]);
      }
    }
  }

  /// @param position  scratch with one entry per column: the place of the column in the row
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
    for (Index k = places.begin[row]; k < places.begin[row + 1]; ++k)
    {
      const Index patch = places.item[k] / FunctionsPerPatch;
      const int* entry = Rows.number[places.item[k] % FunctionsPerPatch];
      std::array<double, FunctionsPerPatch> part; // separate from the sums, so that SIMD lanes
                                                  // compute it
      for (int j = 0; j < FunctionsPerPatch; ++j)
      {
        const double m = mass ? a * mass[patch][entry[j]] : 0.0;
        const double l = stiffness ? b * stiffness[patch][entry[j]] : 0.0;
        part[j] = m + l;
      }
      for (int j = 0; j < FunctionsPerPatch; ++j)
      {
        value[position[level.dof[patch][j]]] += part[j];
      }
    }
  }
};

/// Appends the row of a function that is a weighted sum of the eight functions of a patch.
void AppendRow(const std::array<Index, FunctionsPerPatch>& dof, const double* weight,
  Array<Index>& columns, Array<double>& values)
{
  std::array<std::pair<Index, double>, FunctionsPerPatch> entries;
  for (int p = 0; p < FunctionsPerPatch; ++p)
  {
    entries[p] = { dof[p], weight[p] };
  }
  std::sort(entries.begin(), entries.end());
  for (const auto& [column, value] : entries)
  {
    if (value != 0.0)
    {
      columns.push_back(column);
      values.push_back(value);
    }
  }
}

} // namespace

FunctionPlaces PlacesOfFunctions(const PatchLevel& level, int threads)
{
  return GroupItems(level.dof.empty() ? nullptr : level.dof.front().data(),
    FunctionsPerPatch * level.NumberOfPatches(), level.numberOfFunctions, threads);
}

SparseMatrix BuildPattern(const PatchLevel& level, const FunctionPlaces& places, int threads)
{
  SparseMatrix pattern;
  pattern.rows = pattern.columns = level.numberOfFunctions;
  FillRows(pattern, threads,
    [&](Index row, Array<Index>& columns, Array<double>&)
    { AppendNeighbours(level, places, row, columns); });
  return pattern;
}

void AssembleValues(const PatchLevel& level, const FunctionPlaces& places,
  const Array<ElementMatrix>& mass, double a, const Array<ElementMatrix>& stiffness, double b,
  SparseMatrix& matrix, int threads)
{
  const ElementSum sum{ level, places, a != 0.0 ? mass.data() : nullptr, a,
    b != 0.0 ? stiffness.data() : nullptr, b };
  matrix.value.resize(matrix.NonZeros());
  const int team = NumberOfThreads(threads);
  // There is one table per thread. Tables are made before the threads start, so that the loop
  // cannot throw.
  std::vector<std::vector<Index>> positions(team, std::vector<Index>(matrix.columns));
#pragma omp parallel for num_threads(team) schedule(dynamic, DefaultBlockSize)
  for (Index row = 0; row < matrix.rows; ++row)
  {
    constexpr Index Ahead = 16;
    if (row < matrix.rows - Ahead)
    {
      sum.FetchLast(row + Ahead);
    }
    sum.FillRow(matrix, row, positions[omp_get_thread_num()]);
  }
}

SparseMatrix BuildProlongation(
  const PatchLevel& fine, const FunctionPlaces& places, const PatchLevel& coarse, int threads)
{
  SparseMatrix prolongation;
  prolongation.rows = fine.numberOfFunctions;
  prolongation.columns = coarse.numberOfFunctions;
  FillRows(prolongation, threads,
    [&](Index row, Array<Index>& columns, Array<double>& values)
    {
      if (places.begin[row] == places.begin[row + 1])
      {
        return;
      }
      const Index first = places.item[places.begin[row]];
      const Index patch = first / FunctionsPerPatch;
      const Index corner = first % FunctionsPerPatch;
      const auto& dof = coarse.dof[fine.parent[patch]];
      const auto& weights = ChildWeights(fine.Octant(patch))[corner];
      AppendRow(dof, weights.data(), columns, values);
    });
  return prolongation;
}

} // namespace gridfem
