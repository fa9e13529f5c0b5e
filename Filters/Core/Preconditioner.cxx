#include "Preconditioner.h"

#include "Multigrid.h"
#include "Parallel.h"

namespace gridfem
{
namespace
{

/// Columns of one cycle: as wide as SIMD lanes need and small enough for the cache.
constexpr Id PanelWidth = 8;

MultiVector AllRows(const RowSource& r, int threads)
{
  MultiVector all(r.rows, r.columns);
  ParallelRanges(
    r.rows, threads,
    [&](Id begin, Id end)
    {
      MultiVector part(SourceRows, r.columns);
      r.fill(begin, end, part);
      all.middleRows(begin, end - begin) = part.topRows(end - begin);
    },
    SourceRows);
  return all;
}

void HandOver(const MultiVector& z, const RowSink& sink, int threads)
{
  ParallelRanges(
    z.rows(), threads,
    [&](Id begin, Id end) { sink(begin, end, z.middleRows(begin, end - begin)); }, SourceRows);
}

} // namespace

Eigen::VectorXd SquaredNorms(const RowSource& r, int threads)
{
  // Few sums of many ranges each: their number does not depend on the threads.
  constexpr Id RangesPerSum = 16;
  return ParallelSum(
    r.rows, threads, Eigen::VectorXd(Eigen::VectorXd::Zero(r.columns)),
    [&](Id first, Id last)
    {
      MultiVector part(SourceRows, r.columns);
      Eigen::VectorXd sum = Eigen::VectorXd::Zero(r.columns);
      for (Id begin = first; begin < last; begin += SourceRows)
      {
        const Id end = std::min(last, begin + SourceRows);
        r.fill(begin, end, part);
        for (Id row = 0; row < end - begin; ++row)
        {
          sum += part.row(row).cwiseAbs2().transpose();
        }
      }
      return sum;
    },
    RangesPerSum * SourceRows);
}

Preconditioner CyclePreconditioner(const Multigrid& multigrid, std::size_t level)
{
  return [&multigrid, level](const RowSource& r, const RowSink& z)
  {
    const int threads = multigrid.Options().threads;
    MultiVector block = AllRows(r, threads); // corrections take the place of residuals
    ResidualMeasures measures{ Eigen::VectorXd(r.columns), Eigen::VectorXd(r.columns) };
    ParallelRanges(
      r.columns, threads,
      [&](Id begin, Id end)
      {
        const MultiVector residual = block.middleCols(begin, end - begin);
        MultiVector correction;
        multigrid.PreconditionFrom(level, residual, correction);
        measures.energy.segment(begin, end - begin) = ColumnDots(residual, correction, threads);
        measures.norm.segment(begin, end - begin) = ColumnDots(residual, residual, threads);
        block.middleCols(begin, end - begin) = correction;
      },
      PanelWidth);
    HandOver(block, z, threads);
    return measures;
  };
}

} // namespace gridfem
