#include "CollectSpectrum.h"

#include "BlockVectors.h"
#include "PairedProduct.h"
#include "Parallel.h"

#include <algorithm>

namespace gridfem
{
namespace
{

/// Columns of one cycle: as wide as SIMD lanes need and small enough for the cache.
constexpr Id PanelWidth = 8;

/// Entries that differ by less, relatively, are equal up to rounding: symmetric surfaces have many.
constexpr double NearTie = 1e-6;

/// Rows whose images are looked at together.
constexpr Id RowsAtOnce = 512;

/// Per column of M X the entry of largest magnitude, near ties to the lowest row.
Eigen::RowVectorXd LargestEntries(const SparseMatrix& mass, const MultiVector& X, int threads)
{
  const Id ranges = (X.rows() + RowsAtOnce - 1) / RowsAtOnce;
  std::vector<Eigen::RowVectorXd> parts(ranges, Eigen::RowVectorXd::Zero(X.cols()));
  const auto update = [](Eigen::RowVectorXd& largest, const auto& row)
  { largest = (row.array().abs() > (1.0 + NearTie) * largest.array().abs()).select(row, largest); };
  ParallelBlocks(ranges, threads,
    [&](Id range)
    {
      const Id begin = range * RowsAtOnce;
      const Id end = std::min(X.rows(), begin + RowsAtOnce);
      MultiVector load(RowsAtOnce, X.cols());
      MultiplyRows(mass, X, begin, end, load);
      for (Id row = 0; row < end - begin; ++row)
      {
        update(parts[range], load.row(row));
      }
    });
  Eigen::RowVectorXd largest = Eigen::RowVectorXd::Zero(X.cols());
  for (const Eigen::RowVectorXd& part : parts)
  {
    update(largest, part);
  }
  return largest;
}

/// The entry of largest magnitude of M x becomes positive.
void FixSigns(const SparseMatrix& mass, MultiVector& X, int threads)
{
  const Eigen::RowVectorXd sign =
    LargestEntries(mass, X, threads)
      .unaryExpr([](double value) { return value < 0.0 ? -1.0 : 1.0; });
  ParallelRanges(X.rows(), threads,
    [&](Id begin, Id end) { X.middleRows(begin, end - begin) *= sign.asDiagonal(); });
}

/// X becomes [front, first `count` columns of X].
void PutInFront(const MultiVector& front, Id count, MultiVector& X)
{
  const Id width = front.cols() + count;
  if (X.rows() < front.rows() || X.cols() < width)
  {
    X.conservativeResize(front.rows(), width);
  }
  for (Id row = 0; row < front.rows(); ++row)
  {
    double* to = X.data() + row * X.cols();
    std::copy_backward(to, to + count, to + width);
    std::copy_n(front.data() + row * front.cols(), front.cols(), to);
  }
  KeepColumns(X, width);
}

} // namespace

Spectrum CollectSpectrum(const Constants& constants, Index zeros, EigenPairs& pairs,
  const BlockReport& report, const SparseMatrix& mass, int threads)
{
  const Index others = static_cast<Index>(report.residuals.size());
  Spectrum spectrum;
  spectrum.eigenvalues.assign(zeros, 0.0);
  for (Index j = 0; j < others; ++j)
  {
    // Below 0 there is only rounding, where a sliver has functions that almost vanish.
    spectrum.eigenvalues.push_back(std::max(0.0, pairs.values[j]));
  }
  spectrum.vectors = std::move(pairs.vectors);
  PutInFront(constants.Vectors(zeros), others, spectrum.vectors);
  FixSigns(mass, spectrum.vectors, threads);
  spectrum.residuals.assign(zeros, 0.0);
  spectrum.residuals.insert(
    spectrum.residuals.end(), report.residuals.begin(), report.residuals.end());
  spectrum.estimatedErrors.assign(zeros, 0.0);
  spectrum.numberOfConverged = zeros + report.numberOfConverged;
  spectrum.converged = spectrum.numberOfConverged == zeros + others;
  spectrum.iterations = report.iterations;
  return spectrum;
}

Preconditioner CyclePreconditioner(const Multigrid& multigrid, std::size_t level)
{
  return [&multigrid, level](const RowSource& source, Block z)
  {
    const int threads = multigrid.Options().threads;
    MultiVector r(z.rows(), z.cols());
    ParallelRanges(
      z.rows(), threads,
      [&](Id begin, Id end)
      {
        MultiVector rows(SourceRows, z.cols());
        source(begin, end, rows);
        r.middleRows(begin, end - begin) = rows.topRows(end - begin);
      },
      SourceRows);
    ParallelRanges(
      z.cols(), threads,
      [&](Id begin, Id end)
      {
        const MultiVector residual = r.middleCols(begin, end - begin);
        MultiVector correction;
        multigrid.PreconditionFrom(level, residual, correction);
        z.middleCols(begin, end - begin) = correction;
      },
      PanelWidth);
    return ResidualMeasures{ ColumnDots(r, z, threads), ColumnDots(r, r, threads) };
  };
}

} // namespace gridfem
