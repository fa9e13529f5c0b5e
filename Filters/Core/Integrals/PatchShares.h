// Sums the contributions of patches to functions. Every patch writes its shares of its eight
// functions, and every function sums its shares in a fixed order. The bits are therefore the same
// for any number of threads.
#ifndef GridFEM_PatchShares_h
#define GridFEM_PatchShares_h

#include "Base/Parallel.h"
#include "Integrals/Assembly.h"

#include <algorithm>
#include <vector>

namespace gridfem
{

/// Number of columns made in one pass. It bounds the memory per patch.
constexpr Id ColumnsPerPass = 4;

/// A patch's shares in some of the columns, function by function.
struct PatchShare
{
  Id firstColumn;
  double* value; // 8 x Columns
};

/// Stores the sums of each function's shares in result.middleCols(firstColumn, Columns).
template<int Columns>
void SumShares(const std::vector<double>& shares, const FunctionPlaces& places, Id firstColumn,
  int threads, MultiVector& result)
{
  ParallelRanges(result.rows(), threads,
    [&](Id begin, Id end)
    {
      for (Id f = begin; f < end; ++f)
      {
        std::array<double, Columns> sum{};
        for (Index k = places.begin[f]; k < places.begin[f + 1]; ++k)
        {
          const double* const share = shares.data() + static_cast<Id>(places.item[k]) * Columns;
          for (int c = 0; c < Columns; ++c)
          {
            sum[c] += share[c];
          }
        }
        std::copy(sum.begin(), sum.end(), &result(f, firstColumn));
      }
    });
}

/// Calls body(std::integral_constant<int, Columns>, first column) for passes of at most
/// ColumnsPerPass columns.
template<class Body>
void ForEachPass(Id columns, Body&& body)
{
  for (Id first = 0; first < columns; first += ColumnsPerPass)
  {
    switch (std::min(ColumnsPerPass, columns - first))
    {
      case 1:
        body(std::integral_constant<int, 1>(), first);
        break;
      case 2:
        body(std::integral_constant<int, 2>(), first);
        break;
      case 3:
        body(std::integral_constant<int, 3>(), first);
        break;
      default:
        body(std::integral_constant<int, ColumnsPerPass>(), first);
    }
  }
}

} // namespace gridfem

#endif
