#include "BasisProducts.h"

#include "PairedProduct.h"
#include "Parallel.h"

namespace gridfem
{
namespace
{

/// Rows whose images are computed and multiplied at a time: they fit the second-level cache.
constexpr Id RowsAtOnce = 256;

/// Sums over all rows are made of this many, each by one thread and added in order.
constexpr Id NumberOfSums = 16;

Id Width(const BasisParts& parts)
{
  Id width = 0;
  for (const ConstBlock& part : parts)
  {
    width += part.cols();
  }
  return width;
}

/// Sum over the rows of [X₁ X₂ ...]ᵀ image, where imageRows(begin, end, image) fills the first rows
/// of a block of `columns` columns.
template<class ImageRows>
Eigen::MatrixXd ProjectRows(
  const BasisParts& parts, Id rows, Id columns, int threads, ImageRows&& imageRows)
{
  const auto sum = [&](Id first, Id last)
  {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(Width(parts), columns);
    MultiVector image(RowsAtOnce, columns);
    for (Id begin = first; begin < last; begin += RowsAtOnce)
    {
      const Id count = std::min(RowsAtOnce, last - begin);
      imageRows(begin, begin + count, image);
      Id row = 0;
      for (const ConstBlock& part : parts)
      {
        result.middleRows(row, part.cols()).noalias() +=
          part.middleRows(begin, count).transpose() * image.topRows(count);
        row += part.cols();
      }
    }
    return result;
  };
  const Id perSum = (rows + NumberOfSums - 1) / NumberOfSums;
  return ParallelSum(rows, threads, Eigen::MatrixXd(Eigen::MatrixXd::Zero(Width(parts), columns)),
    sum, std::max(perSum, RowsAtOnce));
}

} // namespace

Eigen::MatrixXd ProjectPair(const BasisParts& parts, const SparseMatrix& A, const SparseMatrix& B,
  const ConstBlock& Y, int threads)
{
  const PairedProduct product(A, B, Y);
  return ProjectRows(parts, A.rows, 2 * Y.cols(), threads,
    [&](Id begin, Id end, MultiVector& image) { product.Rows(begin, end, image); });
}

Eigen::MatrixXd Project(
  const BasisParts& parts, const SparseMatrix& A, const ConstBlock& Y, int threads)
{
  return ProjectRows(parts, A.rows, Y.cols(), threads,
    [&](Id begin, Id end, MultiVector& image) { MultiplyRows(A, Y, begin, end, image); });
}

void SubtractCombination(const BasisParts& parts, const Eigen::MatrixXd& C, Block Y, int threads)
{
  ParallelRanges(
    Y.rows(), threads,
    [&](Id begin, Id end)
    {
      Id row = 0;
      for (const ConstBlock& part : parts)
      {
        Y.middleRows(begin, end - begin).noalias() -=
          part.middleRows(begin, end - begin) * C.middleRows(row, part.cols());
        row += part.cols();
      }
    },
    RowsAtOnce);
}

} // namespace gridfem
