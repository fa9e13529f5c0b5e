#include "Preconditioner.h"

#include "Parallel.h"

namespace gridfem
{

Eigen::VectorXd SquaredNorms(const RowSource& r, Id rows, Id columns, int threads)
{
  // Few sums of many ranges each: their number does not depend on the threads.
  constexpr Id RangesPerSum = 16;
  return ParallelSum(
    rows, threads, Eigen::VectorXd(Eigen::VectorXd::Zero(columns)),
    [&](Id first, Id last)
    {
      MultiVector part(SourceRows, columns);
      Eigen::VectorXd sum = Eigen::VectorXd::Zero(columns);
      for (Id begin = first; begin < last; begin += SourceRows)
      {
        const Id end = std::min(last, begin + SourceRows);
        r(begin, end, part);
        for (Id row = 0; row < end - begin; ++row)
        {
          sum += part.row(row).cwiseAbs2().transpose();
        }
      }
      return sum;
    },
    RangesPerSum * SourceRows);
}

} // namespace gridfem
