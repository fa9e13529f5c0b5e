// Random functions with the spectrum of a given function: what is kept, and what is random.
#include "Spectrum/SpectralSurrogates.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace gridfem;

namespace
{

constexpr Index Constants = 2;

/// Shares of two functions in 2 + 3 + 5 + 4 modes; the last group is not whole.
MultiVector Shares()
{
  MultiVector shares(14, 2);
  for (Id k = 0; k < shares.rows(); ++k)
  {
    shares.row(k) << 1.0 + double(k), 3.0 - 0.5 * double(k * k % 7);
  }
  return shares;
}

/// First rows and numbers of rows of the groups.
constexpr Id Groups[3][2] = { { 2, 3 }, { 5, 5 }, { 10, 4 } };

} // namespace

TEST(RotateWithinGroups, KeepsConstantsAndTheProductsInEachGroup)
{
  const MultiVector shares = Shares();
  for (const Id number : { 0, 1, 17 })
  {
    const MultiVector rotated = RotateWithinGroups(shares, Constants, 5, number);
    EXPECT_EQ(rotated.topRows(Constants), shares.topRows(Constants));
    for (const auto& [first, count] : Groups)
    {
      const Eigen::Matrix2d before =
        shares.middleRows(first, count).transpose() * shares.middleRows(first, count);
      const Eigen::Matrix2d after =
        rotated.middleRows(first, count).transpose() * rotated.middleRows(first, count);
      EXPECT_LT((after - before).norm(), 1e-12 * before.norm());
    }
    EXPECT_GT((rotated - shares).norm(), 1.0);
  }
}

TEST(RotateWithinGroups, AnotherSeedOrNumberGivesAnotherFunction)
{
  const MultiVector shares = Shares();
  const MultiVector first = RotateWithinGroups(shares, Constants, 5, 0);
  EXPECT_EQ(RotateWithinGroups(shares, Constants, 5, 0), first);
  EXPECT_GT((RotateWithinGroups(shares, Constants, 5, 1) - first).norm(), 1.0);
  EXPECT_GT((RotateWithinGroups(shares, Constants, 6, 0) - first).norm(), 1.0);
}

/// Directions are uniform: the mean is 0, and each mode has the same part of the energy.
TEST(RotateWithinGroups, IsUniform)
{
  constexpr int Count = 4000;
  const MultiVector shares = Shares().leftCols(1);
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(shares.rows());
  Eigen::MatrixXd second = Eigen::MatrixXd::Zero(shares.rows(), shares.rows());
  for (int number = 0; number < Count; ++number)
  {
    const Eigen::VectorXd rotated = RotateWithinGroups(shares, Constants, 3, number);
    mean += rotated / Count;
    second += rotated * rotated.transpose() / Count;
  }
  constexpr double Errors = 5.0; // standard errors
  for (const auto& [first, count] : Groups)
  {
    const double part = shares.middleRows(first, count).squaredNorm() / double(count);
    const Eigen::MatrixXd block = second.block(first, first, count, count);
    EXPECT_LT(mean.segment(first, count).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
      Errors * std::sqrt(part / Count));
    EXPECT_LT((block - part * Eigen::MatrixXd::Identity(count, count))
                .cwiseAbs()
                .maxCoeff<Eigen::PropagateNaN>(),
      Errors * std::sqrt(2.0 / Count) * part);
  }
}
