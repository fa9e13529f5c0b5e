#include "Equations/RowPenalty.h"

#include "Algebra/RowBuilder.h"
#include "Base/Errors.h"
#include "Base/Parallel.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace gridfem
{
namespace
{

/// C P, without entries that are only rounding.
SparseMatrix RowsOnCoarser(const SparseMatrix& rows, const SparseMatrix& prolongation)
{
  constexpr double Rounding = 1e-13;
  RowBuilder coarse;
  RowBuilder::Entries entries;
  for (Index row = 0; row < rows.rows; ++row)
  {
    entries.clear();
    for (Id k = rows.rowBegin[row]; k < rows.rowBegin[row + 1]; ++k)
    {
      const Index fine = rows.column[k];
      for (Id p = prolongation.rowBegin[fine]; p < prolongation.rowBegin[fine + 1]; ++p)
      {
        entries.emplace_back(prolongation.column[p], rows.value[k] * prolongation.value[p]);
      }
    }
    coarse.Append(entries, Rounding);
  }
  return coarse.Finish(prolongation.columns);
}

/// Scales rows to the sums of the rows of `wanted`. Rows whose sum is 0 stay.
void TakeRowSums(const SparseMatrix& wanted, SparseMatrix& rows)
{
  const MultiVector sum = RowSums(rows);
  const MultiVector by = sum.array() / RowSums(wanted).array();
  DivideRows((sum.array() == 0.0).select(1.0, by), rows);
}

/// The place of an entry, or -1.
Id FindEntry(const SparseMatrix& A, Index row, Index column)
{
  const Index* const begin = A.column.data() + A.rowBegin[row];
  const Index* const end = A.column.data() + A.rowBegin[row + 1];
  const Index* const found = std::lower_bound(begin, end, column);
  return found != end && *found == column ? found - A.column.data() : -1;
}

} // namespace

RowPenalty::RowPenalty(
  const SpaceLevels& space, SparseMatrix rows, std::vector<double> weight, int threads)
  : weight_(std::move(weight))
{
  const std::size_t functions = space.Integrals().size(); // number of functions in this process
  if (static_cast<std::size_t>(rows.columns) != functions)
  {
    throw InvalidInput("The constraints are rows of " + std::to_string(rows.columns) +
                       " values for " + std::to_string(functions) + " functions.");
  }
  levels_.push_back({ std::move(rows), {} });
  for (std::size_t l = 1; l < space.NumberOfLevels(); ++l)
  {
    SparseMatrix coarse = RowsOnCoarser(levels_.back().rows, space.Prolongation(l - 1));
    const DistributedRows* const distributed = space.Distributed(l - 1);
    if (distributed && distributed->ArePartsProlonged()) // this process's part stands for the whole
    {
      TakeRowSums(levels_.back().rows, coarse);
    }
    levels_.push_back({ std::move(coarse), {} });
  }
  for (Level& level : levels_)
  {
    level.transposed = Transpose(level.rows, threads);
  }
}

void RowPenalty::AddTo(std::size_t level, double factor, SparseMatrix& A, int threads) const
{
  const SparseMatrix& rows = levels_[level].rows;
  const SparseMatrix& transposed = levels_[level].transposed;
  ParallelRanges(A.rows, threads,
    [&](Id begin, Id end)
    {
      for (Index i = static_cast<Index>(begin); i < end; ++i)
      {
        for (Id t = transposed.rowBegin[i]; t < transposed.rowBegin[i + 1]; ++t)
        {
          const Index row = transposed.column[t];
          const double weight = factor * weight_[row] * transposed.value[t];
          for (Id k = rows.rowBegin[row]; k < rows.rowBegin[row + 1]; ++k)
          {
            const Id place = FindEntry(A, i, rows.column[k]);
            const double term = weight * rows.value[k];
            A.value[place >= 0 ? place : FindEntry(A, i, i)] += place >= 0 ? term : std::abs(term);
          }
        }
      }
    });
}

void RowPenalty::AddSumTo(std::size_t level, double factor, const DistributedRows& distributed,
  SparseMatrix& A, int threads) const
{
  SparseMatrix sum = A;
  std::fill(sum.value.begin(), sum.value.end(), 0.0);
  this->AddTo(level, factor, sum, threads);
  distributed.SumNumbers(sum.value.data(), static_cast<Id>(sum.value.size()));
  std::transform(
    A.value.begin(), A.value.end(), sum.value.begin(), A.value.begin(), std::plus<double>());
}

MultiVector RowPenalty::Weighted(const MultiVector& values) const
{
  const Eigen::Map<const Eigen::VectorXd> weight(
    weight_.data(), static_cast<Eigen::Index>(weight_.size()));
  return weight.asDiagonal() * values;
}

MultiVector RowPenalty::LoadOf(const MultiVector& values, int threads) const
{
  MultiVector load;
  Multiply(levels_.front().transposed, this->Weighted(values), load, threads);
  return load;
}

} // namespace gridfem
