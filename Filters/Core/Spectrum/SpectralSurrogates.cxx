#include "Spectrum/SpectralSurrogates.h"

#include "Base/NormalNumbers.h"

#include <Eigen/QR>

#include <algorithm>

namespace gridfem
{
namespace
{

/// Returns an orthogonal matrix, uniform among all. It is Q of a matrix of normal numbers. Its
/// signs make the diagonal of R positive. [Mezzadri: How to generate random matrices from the
/// classical compact groups, 2007]
Eigen::MatrixXd RandomOrthogonal(Id size, const NormalNumbers& numbers)
{
  Eigen::MatrixXd normal(size, size);
  for (Id k = 0; k < normal.size(); k += 2)
  {
    const auto pair = numbers.Pair(static_cast<std::uint64_t>(k / 2));
    normal.data()[k] = pair[0];
    if (k + 1 < normal.size())
    {
      normal.data()[k + 1] = pair[1];
    }
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> factors(normal);
  Eigen::MatrixXd q = factors.householderQ();
  for (Id k = 0; k < size; ++k)
  {
    q.col(k) *= factors.matrixQR()(k, k) < 0.0 ? -1.0 : 1.0;
  }
  return q;
}

} // namespace

MultiVector RotateWithinGroups(
  const MultiVector& shares, Index constants, std::uint64_t seed, Id number)
{
  MultiVector rotated = shares;
  std::uint64_t group = 0;
  Id first = constants;
  while (first < shares.rows())
  {
    const Id count = std::min<Id>(2 * static_cast<Id>(group) + 3, shares.rows() - first);
    const NormalNumbers numbers(
      seed, NormalNumbers::Mixed(static_cast<std::uint64_t>(number)) + group);
    rotated.middleRows(first, count) =
      RandomOrthogonal(count, numbers) * shares.middleRows(first, count);
    first += count;
    ++group;
  }
  return rotated;
}

} // namespace gridfem
