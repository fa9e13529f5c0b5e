#include "Multigrid/BlockPreconditioner.h"

#include "Base/Parallel.h"
#include "Multigrid/Multigrid.h"

namespace gridfem
{
namespace
{

/// Columns of one cycle: as wide as SIMD lanes need and small enough for the cache.
constexpr Id PanelWidth = 8;

template<class Real>
MultiVector AllRows(const RowSource<Real>& r, int threads)
{
  MultiVector all(r.rows, r.columns);
  ParallelRanges(
    r.rows, threads,
    [&](Id begin, Id end)
    {
      Vectors<Real> part(end - begin, r.columns);
      r.fill(begin, end, part);
      all.middleRows(begin, end - begin) = part.template cast<double>();
    },
    SourceRows);
  return all;
}

template<class Real>
void HandOver(const MultiVector& z, const RowSink<Real>& sink, int threads)
{
  ParallelRanges(
    z.rows(), threads,
    [&](Id begin, Id end)
    {
      const Vectors<Real> part = z.middleRows(begin, end - begin).template cast<Real>();
      sink(begin, end, part);
    },
    SourceRows);
}

} // namespace

template<class Real>
Eigen::VectorXd SquaredNorms(const RowSource<Real>& r, int threads)
{
  // Few sums of many ranges each: their number does not depend on the threads.
  constexpr Id RangesPerSum = 16;
  return ParallelSum(
    r.rows, threads, Eigen::VectorXd(Eigen::VectorXd::Zero(r.columns)),
    [&](Id first, Id last)
    {
      Vectors<Real> part(SourceRows, r.columns);
      Eigen::VectorXd sum = Eigen::VectorXd::Zero(r.columns);
      for (Id begin = first; begin < last; begin += SourceRows)
      {
        const Id end = std::min(last, begin + SourceRows);
        r.fill(begin, end, part.topRows(end - begin));
        for (Id row = 0; row < end - begin; ++row)
        {
          sum += part.row(row).template cast<double>().cwiseAbs2().transpose();
        }
      }
      return sum;
    },
    RangesPerSum * SourceRows);
}

template Eigen::VectorXd SquaredNorms(const RowSource<float>&, int);
template Eigen::VectorXd SquaredNorms(const RowSource<double>&, int);

template<class Real>
BlockPreconditioner<Real> CyclePreconditioner(const Multigrid& multigrid, std::size_t level)
{
  return [&multigrid, level](
           const RowSource<Real>& r, const CorrectionTest& isWanted, const RowSink<Real>& z)
  {
    const int threads = multigrid.Options().threads;
    MultiVector block = AllRows(r, threads); // corrections take the place of residuals
    const DividedRows* const divided = RowsOf(multigrid.Levels()[level]);
    if (divided)
    {
      divided->Sum(block);
    }
    const Id own = block.rows() - ForeignRows(divided);
    ResidualMeasures measures{ Eigen::VectorXd(r.columns), Eigen::VectorXd(r.columns) };
    ParallelRanges(
      r.columns, divided ? 1 : threads, // messages come from one thread
      [&](Id begin, Id end)
      {
        const MultiVector residual = block.middleCols(begin, end - begin);
        MultiVector correction;
        multigrid.PreconditionFrom(level, residual, correction);
        const auto ofOwn = residual.bottomRows(own);
        measures.energy.segment(begin, end - begin) =
          ColumnDots(ofOwn, correction.bottomRows(own), threads);
        measures.norm.segment(begin, end - begin) = ColumnDots(ofOwn, ofOwn, threads);
        block.middleCols(begin, end - begin) = correction;
      },
      divided ? r.columns : PanelWidth);
    SumOverProcesses(divided, measures.energy);
    SumOverProcesses(divided, measures.norm);
    if (isWanted(measures))
    {
      HandOver(block, z, threads);
    }
    return measures;
  };
}

template BlockPreconditioner<float> CyclePreconditioner(const Multigrid&, std::size_t);
template BlockPreconditioner<double> CyclePreconditioner(const Multigrid&, std::size_t);

} // namespace gridfem
