#include "Algebra/SparseCholesky.h"

#include "Base/Parallel.h"

#include <Eigen/SparseCholesky>

#include <algorithm>

namespace gridfem
{
namespace
{

using EigenMatrix = Eigen::SparseMatrix<double>;

/// Right-hand sides that share a pass through the factor.
constexpr int Lanes = 16;
using Row = Eigen::Map<Eigen::Array<double, Lanes, 1>>;

/// The lower triangle, column by column.
EigenMatrix LowerOf(const SparseMatrix& A)
{
  // The rows of the symmetric matrix are its columns.
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(A.NonZeros() / 2 + A.rows));
  for (Index row = 0; row < A.rows; ++row)
  {
    for (Id k = A.rowBegin[row]; k < A.rowBegin[row + 1]; ++k)
    {
      if (A.column[k] >= row)
      {
        entries.emplace_back(A.column[k], row, A.value[k]);
      }
    }
  }
  EigenMatrix lower(A.rows, A.rows);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

/// Solves L Lᵀ x = b in place, for `Lanes` right-hand sides beside each other.
void SolveLanes(const EigenMatrix& L, double* x)
{
  const int* const begin = L.outerIndexPtr();
  const int* const rows = L.innerIndexPtr();
  const double* const values = L.valuePtr();
  const auto at = [x](Id row) { return Row(x + row * Lanes); };
  const Id n = L.cols();
  for (Id j = 0; j < n; ++j)
  {
    const Eigen::Array<double, Lanes, 1> xj = at(j) / values[begin[j]]; // the diagonal comes first
    at(j) = xj;
    for (int k = begin[j] + 1; k < begin[j + 1]; ++k)
    {
      at(rows[k]) -= values[k] * xj;
    }
  }
  for (Id j = n - 1; j >= 0; --j)
  {
    Eigen::Array<double, Lanes, 1> xj = at(j);
    for (int k = begin[j] + 1; k < begin[j + 1]; ++k)
    {
      xj -= values[k] * at(rows[k]);
    }
    at(j) = xj / values[begin[j]];
  }
}

} // namespace

struct SparseCholesky::Factor
{
  Eigen::SimplicialLLT<EigenMatrix> llt;
};

SparseCholesky::SparseCholesky(const SparseMatrix& A)
{
  auto factor = std::make_unique<Factor>();
  factor->llt.compute(LowerOf(A));
  factor_ = std::move(factor);
}

SparseCholesky::~SparseCholesky() = default;

bool SparseCholesky::IsDefinite() const
{
  return factor_->llt.info() == Eigen::Success;
}

void SparseCholesky::Solve(const MultiVector& b, MultiVector& x, int threads) const
{
  const EigenMatrix& L = factor_->llt.matrixL().nestedExpression();
  const auto& place = factor_->llt.permutationP().indices(); // of each unknown in the factor
  const Id columns = b.cols();
  MultiVector result(b.rows(), columns);
  ParallelRanges((columns + Lanes - 1) / Lanes, threads,
    [&](Id first, Id last)
    {
      std::vector<double> lanes(static_cast<std::size_t>(b.rows() * Lanes));
      for (Id block = first; block < last; ++block)
      {
        const Id begin = block * Lanes;
        const Id count = std::min<Id>(Lanes, columns - begin);
        std::fill(lanes.begin(), lanes.end(), 0.0);
        for (Id row = 0; row < b.rows(); ++row)
        {
          std::copy_n(&b(row, begin), count, &lanes[static_cast<std::size_t>(place[row] * Lanes)]);
        }
        SolveLanes(L, lanes.data());
        for (Id row = 0; row < b.rows(); ++row)
        {
          std::copy_n(
            &lanes[static_cast<std::size_t>(place[row] * Lanes)], count, &result(row, begin));
        }
      }
    },
    1);
  x = std::move(result);
}

} // namespace gridfem
