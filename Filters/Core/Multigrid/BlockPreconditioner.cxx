#include "Multigrid/BlockPreconditioner.h"

#include "Base/Parallel.h"

#include <type_traits>

namespace gridfem
{
template<class Given, class Real>
Columns LoadRows(const RowSource<Given>& r, Vectors<Real>& to, int threads)
{
  return ParallelSum(
    r.rows, threads, Columns(Columns::Zero(to.cols())),
    [&](Id begin, Id end)
    {
      auto rows = to.middleRows(begin, end - begin);
      rows.rightCols(to.cols() - r.columns).setZero();
      if constexpr (std::is_same_v<Given, Real>)
      {
        r.fill(begin, end, rows.leftCols(r.columns));
      }
      else
      {
        Vectors<Given> part(end - begin, r.columns);
        r.fill(begin, end, part);
        rows.leftCols(r.columns) = part.template cast<Real>();
      }
      return RowProducts(to, to, begin, end);
    },
    SourceRows);
}

template Columns LoadRows(const RowSource<float>&, Vectors<float>&, int);
template Columns LoadRows(const RowSource<double>&, Vectors<float>&, int);
template Columns LoadRows(const RowSource<float>&, Vectors<double>&, int);
template Columns LoadRows(const RowSource<double>&, Vectors<double>&, int);

template<class Given, class Real>
void HandOver(const Vectors<Real>& from, Id columns, const RowSink<Given>& z, int threads)
{
  ParallelRanges(
    from.rows(), threads,
    [&](Id begin, Id end)
    {
      const auto rows = from.block(begin, 0, end - begin, columns);
      if constexpr (std::is_same_v<Given, Real>)
      {
        z(begin, end, rows);
      }
      else
      {
        const Vectors<Given> part = rows.template cast<Given>();
        z(begin, end, part);
      }
    },
    SourceRows);
}

template void HandOver(const Vectors<float>&, Id, const RowSink<float>&, int);
template void HandOver(const Vectors<float>&, Id, const RowSink<double>&, int);
template void HandOver(const Vectors<double>&, Id, const RowSink<float>&, int);
template void HandOver(const Vectors<double>&, Id, const RowSink<double>&, int);

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

} // namespace gridfem
