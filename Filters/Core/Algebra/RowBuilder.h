// Builds a sparse matrix row by row.
#ifndef GridFEM_RowBuilder_h
#define GridFEM_RowBuilder_h

#include "Algebra/SparseMatrix.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace gridfem
{

class RowBuilder
{
public:
  using Entries = std::vector<std::pair<Index, double>>;

  /// Appends a row. Entries in the same column are added up; sums whose absolute value is at most
  /// `least` are left out.
  void Append(Entries& entries, double least = -1.0)
  {
    std::sort(entries.begin(), entries.end(),
      [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t k = 0; k < entries.size();)
    {
      const Index own = entries[k].first;
      double sum = 0.0;
      for (; k < entries.size() && entries[k].first == own; ++k)
      {
        sum += entries[k].second;
      }
      if (std::abs(sum) > least)
      {
        column_.push_back(own);
        value_.push_back(sum);
      }
    }
    begin_.push_back(static_cast<Id>(column_.size()));
  }

  SparseMatrix Finish(Index columns)
  {
    SparseMatrix matrix;
    matrix.rows = static_cast<Index>(begin_.size()) - 1;
    matrix.columns = columns;
    matrix.rowBegin = std::move(begin_);
    matrix.column = std::move(column_);
    matrix.value = std::move(value_);
    return matrix;
  }

private:
  Array<Id> begin_{ 0 };
  Array<Index> column_;
  Array<double> value_;
};

} // namespace gridfem

#endif
