#include "BlockVectors.h"

#include "Parallel.h"

#include <random>

namespace gridfem
{

MultiVector RandomColumns(Id rows, Id columns)
{
  std::mt19937_64 generator(20180901);
  MultiVector X(rows, columns);
  for (Id i = 0; i < rows; ++i)
  {
    for (Id j = 0; j < columns; ++j)
    {
      X(i, j) = static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0;
    }
  }
  return X;
}

MultiVector SelectColumns(const MultiVector& X, const std::vector<Index>& columns, int threads)
{
  MultiVector result(X.rows(), static_cast<Id>(columns.size()));
  ParallelRanges(X.rows(), threads,
    [&](Id begin, Id end)
    {
      const Id count = end - begin;
      result.middleRows(begin, count) = X.middleRows(begin, count)(Eigen::all, columns);
    });
  return result;
}

Eigen::VectorXd ColumnDots(const MultiVector& X, const MultiVector& Y, int threads)
{
  return ParallelSum(X.rows(), threads, Eigen::VectorXd(Eigen::VectorXd::Zero(X.cols())),
    [&](Id begin, Id end)
    {
      Eigen::VectorXd sum = Eigen::VectorXd::Zero(X.cols());
      for (Id i = begin; i < end; ++i)
      {
        sum += X.row(i).cwiseProduct(Y.row(i)).transpose();
      }
      return sum;
    });
}

} // namespace gridfem
