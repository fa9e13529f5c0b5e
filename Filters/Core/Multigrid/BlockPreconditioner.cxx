#include "Multigrid/BlockPreconditioner.h"

#include "Base/Parallel.h"

#include <type_traits>

namespace gridfem
{
template<class Given, class Real>
void LoadRows(const RowSource<Given>& r, Vectors<Real>& to, Columns* norm, int threads)
{
  const Columns zero = Columns::Zero(to.cols());
  const Columns sum = ParallelSum(
    r.rows, threads, zero,
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
      return norm ? RowProducts(to, to, begin, end) : zero;
    },
    SourceRows);
  if (norm)
  {
    *norm = sum;
  }
}

template void LoadRows(const RowSource<float>&, Vectors<float>&, Columns*, int);
template void LoadRows(const RowSource<double>&, Vectors<float>&, Columns*, int);
template void LoadRows(const RowSource<float>&, Vectors<double>&, Columns*, int);
template void LoadRows(const RowSource<double>&, Vectors<double>&, Columns*, int);

template<class Given, class Real>
void StoreRows(const Vectors<Real>& from, Id columns, const RowSink<Given>& z, int threads)
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

template void StoreRows(const Vectors<float>&, Id, const RowSink<float>&, int);
template void StoreRows(const Vectors<float>&, Id, const RowSink<double>&, int);
template void StoreRows(const Vectors<double>&, Id, const RowSink<float>&, int);
template void StoreRows(const Vectors<double>&, Id, const RowSink<double>&, int);

template<class Real>
Eigen::VectorXd SquaredNorms(const RowSource<Real>& r, int threads)
{
  // Each sum takes many ranges, so there are few sums. Their number does not depend on the threads.
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
