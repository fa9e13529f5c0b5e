#include "BlockVectors.h"

#include "LargePages.h"
#include "Parallel.h"

#include <random>

namespace gridfem
{

void Reshape(MultiVector& X, Id rows, Id columns)
{
  if (X.size() != rows * columns)
  {
    X.resize(0, 0); // two blocks at a time would be one too many
    X.resize(rows, columns);
    PreferLargePages(X.data(), X.size() * sizeof(double));
  }
  X.resize(rows, columns);
}

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
  MultiVector result;
  Reshape(result, X.rows(), static_cast<Id>(columns.size()));
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
