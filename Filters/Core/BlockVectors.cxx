#include "BlockVectors.h"

#include "LargeMemory.h"
#include "Parallel.h"

#include <algorithm>
#include <new>
#include <random>

namespace gridfem
{

void BlockBuffer::Reserve(Id rows, Id columns)
{
  if (block_.rows() != rows || block_.outerStride() < columns)
  {
    memory_.resize(0); // two blocks at a time would be one too many
    memory_.resize(rows * columns);
    PreferLargePages(memory_.data(), memory_.size() * sizeof(double));
    new (&block_) Map(memory_.data(), rows, 0, Eigen::OuterStride<>(columns));
  }
}

void BlockBuffer::Show(Id columns)
{
  new (&block_)
    Map(memory_.data(), block_.rows(), columns, Eigen::OuterStride<>(block_.outerStride()));
}

void Reshape(MultiVector& X, Id rows, Id columns)
{
  if (X.size() != rows * columns)
  {
    X.resize(0, 0);
    X.resize(rows, columns);
    PreferLargePages(X.data(), X.size() * sizeof(double));
  }
  X.resize(rows, columns);
}

void KeepColumns(MultiVector& X, Id columns)
{
  const Id rows = X.rows();
  const Id before = X.cols();
  for (Id row = 1; row < rows; ++row)
  {
    std::copy_n(X.data() + row * before, columns, X.data() + row * columns);
  }
  X.resize(rows * before, 1); // as one column, so that its end can be cut off in place
  X.conservativeResize(rows * columns, 1);
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

void SelectColumns(
  const ConstBlock& X, const std::vector<Index>& columns, Block selected, int threads)
{
  const Id count = static_cast<Id>(columns.size());
  ParallelRanges(X.rows(), threads,
    [&](Id begin, Id end)
    {
      for (Id row = begin; row < end; ++row)
      {
        const double* from = X.data() + row * X.outerStride();
        double* to = selected.data() + row * selected.outerStride();
        for (Id j = 0; j < count; ++j)
        {
          to[j] = from[columns[j]];
        }
      }
    });
}

Eigen::VectorXd ColumnDots(const ConstBlock& X, const ConstBlock& Y, int threads)
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
