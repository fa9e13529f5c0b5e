// Builds patterns, values and prolongations of level matrices, row by row and without hash maps.
#include "Integrals/Assembly.h"

#include "Algebra/FillRows.h"
#include "Base/Prefetch.h"
#include "Integrals/SmoothElements.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace gridfem
{
namespace
{

/// The places of a cell's functions: `Side` of them along each axis, x fastest.
template<int Functions>
struct FunctionLattice
{
  static constexpr int Side = Functions == FunctionsPerPatch ? 2 : 3;
  static constexpr int SideAround = 2 * Side - 1;
  /// Number of places of functions that share a cell with a function, including its own.
  static constexpr int PlacesAround = SideAround * SideAround * SideAround;
  static_assert(Side * Side * Side == Functions);

  /// The number of the place of function j of a cell as seen from function i.
  static constexpr int NumberAround(int i, int j)
  {
    int number = 0;
    for (int stride = Side * Side; stride > 0; stride /= Side)
    {
      number = SideAround * number + j / stride % Side - i / stride % Side + Side - 1;
    }
    return number;
  }
};

/// A number for every two functions of a cell.
template<int Functions>
struct FunctionTable
{
  int number[Functions][Functions];

  template<class Number>
  explicit constexpr FunctionTable(Number ofPair) : number()
  {
    for (int i = 0; i < Functions; ++i)
    {
      for (int j = 0; j < Functions; ++j)
      {
        number[i][j] = ofPair(i, j);
      }
    }
  }
};

template<int Functions>
constexpr FunctionTable<Functions> Around(FunctionLattice<Functions>::NumberAround);

/// Packed positions of the entries of each row of an element matrix.
template<int Functions>
constexpr FunctionTable<Functions> Rows(PackedIndex<Functions>);

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
/// places have only one such function, so most repetitions are recognized by their place.
template<int Functions>
void AppendNeighbors(const BasicPatchLevel<Functions>& level, const FunctionPlaces& places, Index f,
  Array<Index>& columns)
{
  const std::size_t first = columns.size();
  std::array<Index, FunctionLattice<Functions>::PlacesAround> known;
  known.fill(-1);
  for (Index k = places.begin[f]; k < places.begin[f + 1]; ++k)
  {
    const auto& dof = level.dof[places.item[k] / Functions];
    const int* const around = Around<Functions>.number[places.item[k] % Functions];
    for (int j = 0; j < Functions; ++j)
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
template<int Functions>
struct ElementSum
{
  using Matrix = BasicElementMatrix<Functions>;

  const BasicPatchLevel<Functions>& level;
  const FunctionPlaces& places;
  const Matrix* mass; // null if its factor is 0
  double a;
  const Matrix* stiffness; // null if its factor is 0
  double b;

  /// Prefetches the matrices of the last patch of a row. Earlier rows may not have used this patch.
  EIGEN_ALWAYS_INLINE void FetchLast(Index row) const
  {
    const Index end = places.begin[row + 1];
    if (end == 0)
    {
      return;
    }
    const Index patch = places.item[end - 1] / Functions;
    for (const Matrix* const matrices : { mass, stiffness })
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
      const Index patch = places.item[k] / Functions;
      const int* entry = Rows<Functions>.number[places.item[k] % Functions];
      std::array<double, Functions> part; // separate from the sums, so that SIMD lanes compute it
      for (int j = 0; j < Functions; ++j)
      {
        const double m = mass ? a * mass[patch][entry[j]] : 0.0;
        const double l = stiffness ? b * stiffness[patch][entry[j]] : 0.0;
        part[j] = m + l;
      }
      for (int j = 0; j < Functions; ++j)
      {
        value[position[level.dof[patch][j]]] += part[j];
      }
    }
  }
};

/// Appends the row of a function that is a weighted sum of the functions of a patch.
template<std::size_t Functions>
void AppendRow(const std::array<Index, Functions>& dof, const double* weight, Array<Index>& columns,
  Array<double>& values)
{
  std::array<std::pair<Index, double>, Functions> entries;
  for (std::size_t p = 0; p < Functions; ++p)
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

template<int Functions>
FunctionPlaces PlacesOfFunctions(const BasicPatchLevel<Functions>& level, int threads)
{
  return GroupItems(level.dof.empty() ? nullptr : level.dof.front().data(),
    Functions * level.NumberOfPatches(), level.numberOfFunctions, threads);
}

template<int Functions>
SparseMatrix BuildPattern(
  const BasicPatchLevel<Functions>& level, const FunctionPlaces& places, int threads)
{
  SparseMatrix pattern;
  pattern.rows = pattern.columns = level.numberOfFunctions;
  FillRows(pattern, threads,
    [&](Index row, Array<Index>& columns, Array<double>&)
    { AppendNeighbors(level, places, row, columns); });
  return pattern;
}

template<int Functions>
void AssembleValues(const BasicPatchLevel<Functions>& level, const FunctionPlaces& places,
  const Array<BasicElementMatrix<Functions>>& mass, double a,
  const Array<BasicElementMatrix<Functions>>& stiffness, double b, SparseMatrix& matrix,
  int threads)
{
  const ElementSum<Functions> sum{ level, places, a != 0.0 ? mass.data() : nullptr, a,
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

template<int Functions>
SparseMatrix BuildProlongation(const BasicPatchLevel<Functions>& fine, const FunctionPlaces& places,
  const BasicPatchLevel<Functions>& coarse, int threads)
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
      const Index patch = first / Functions;
      const Index number = first % Functions;
      const auto& dof = coarse.dof[fine.parent[patch]];
      const auto& weights = ChildWeights<Functions>(fine.Octant(patch))[number];
      AppendRow(dof, weights.data(), columns, values);
    });
  return prolongation;
}

template FunctionPlaces PlacesOfFunctions(const PatchLevel&, int);
template FunctionPlaces PlacesOfFunctions(const SmoothLevel&, int);
template SparseMatrix BuildPattern(const PatchLevel&, const FunctionPlaces&, int);
template SparseMatrix BuildPattern(const SmoothLevel&, const FunctionPlaces&, int);
template void AssembleValues(const PatchLevel&, const FunctionPlaces&, const Array<ElementMatrix>&,
  double, const Array<ElementMatrix>&, double, SparseMatrix&, int);
template void AssembleValues(const SmoothLevel&, const FunctionPlaces&,
  const Array<SmoothElementMatrix>&, double, const Array<SmoothElementMatrix>&, double,
  SparseMatrix&, int);
template SparseMatrix BuildProlongation(
  const PatchLevel&, const FunctionPlaces&, const PatchLevel&, int);
template SparseMatrix BuildProlongation(
  const SmoothLevel&, const FunctionPlaces&, const SmoothLevel&, int);

} // namespace gridfem
