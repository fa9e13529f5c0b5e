#include "Algebra/BasisProducts.h"

#include "Algebra/BlockProducts.h"
#include "Base/Parallel.h"

namespace gridfem
{
namespace
{

/// Number of rows whose images are computed and multiplied together: they fit the second-level
/// cache.
template<class Real>
constexpr Id RowsAtOnce = 2048 / sizeof(Real);

/// A sum over all rows is split into at most this many parts. One thread computes each part, and
/// the parts are added in order.
constexpr Id NumberOfSums = 16;

template<class Real>
Id Width(const BasisParts<Real>& parts)
{
  Id width = 0;
  for (const ConstBlock<Real>& part : parts)
  {
    width += part.cols();
  }
  return width;
}

/// Returns [X₁ X₂ ...]ᵀ times the whole image. The function imageRows(begin, end, image) computes
/// rows begin .. end - 1 of the image, in the first rows of a block with `columns` columns.
template<class Real, class ImageRows>
Eigen::MatrixXd ProjectRows(
  const BasisParts<Real>& parts, Id rows, Id columns, int threads, ImageRows&& imageRows)
{
  const auto sum = [&](Id first, Id last)
  {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(Width(parts), columns);
    Vectors<Real> image(RowsAtOnce<Real>, columns);
    Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> product;
    for (Id begin = first; begin < last; begin += RowsAtOnce<Real>)
    {
      const Id count = std::min(RowsAtOnce<Real>, last - begin);
      imageRows(begin, begin + count, image);
      Id row = 0;
      for (const ConstBlock<Real>& part : parts)
      {
        product.noalias() = part.middleRows(begin, count).transpose() * image.topRows(count);
        result.middleRows(row, part.cols()) += product.template cast<double>();
        row += part.cols();
      }
    }
    return result;
  };
  const Id perSum = (rows + NumberOfSums - 1) / NumberOfSums;
  return ParallelSum(rows, threads, Eigen::MatrixXd(Eigen::MatrixXd::Zero(Width(parts), columns)),
    sum, std::max(perSum, RowsAtOnce<Real>));
}

} // namespace

template<class Real>
Eigen::MatrixXd ProjectPair(const BasisParts<Real>& parts, const SparseMatrix& A,
  const SparseMatrix& B, const ConstBlock<Real>& Y, int threads)
{
  const BlockProducts<Real> product(A, B, Y);
  return ProjectRows(parts, A.rows, 2 * Y.cols(), threads,
    [&](Id begin, Id end, Vectors<Real>& image) { product.Rows(begin, end, image); });
}

template<class Real>
Eigen::MatrixXd Project(
  const BasisParts<Real>& parts, const SparseMatrix& A, const ConstBlock<Real>& Y, int threads)
{
  return ProjectRows(parts, A.rows, Y.cols(), threads,
    [&](Id begin, Id end, Vectors<Real>& image) { MultiplyRows<Real>(A, Y, begin, end, image); });
}

template<class Real>
void SubtractCombination(
  const BasisParts<Real>& parts, const Eigen::MatrixXd& C, Block<Real> Y, int threads)
{
  const Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>& coefficients = C.template cast<Real>();
  ParallelRanges(
    Y.rows(), threads,
    [&](Id begin, Id end)
    {
      Id row = 0;
      for (const ConstBlock<Real>& part : parts)
      {
        Y.middleRows(begin, end - begin).noalias() -=
          part.middleRows(begin, end - begin) * coefficients.middleRows(row, part.cols());
        row += part.cols();
      }
    },
    RowsAtOnce<Real>);
}

template Eigen::MatrixXd ProjectPair(const BasisParts<float>&, const SparseMatrix&,
  const SparseMatrix&, const ConstBlock<float>&, int);
template Eigen::MatrixXd Project(
  const BasisParts<float>&, const SparseMatrix&, const ConstBlock<float>&, int);
template void SubtractCombination(
  const BasisParts<float>&, const Eigen::MatrixXd&, Block<float>, int);

template Eigen::MatrixXd ProjectPair(const BasisParts<double>&, const SparseMatrix&,
  const SparseMatrix&, const ConstBlock<double>&, int);
template Eigen::MatrixXd Project(
  const BasisParts<double>&, const SparseMatrix&, const ConstBlock<double>&, int);
template void SubtractCombination(
  const BasisParts<double>&, const Eigen::MatrixXd&, Block<double>, int);

} // namespace gridfem
