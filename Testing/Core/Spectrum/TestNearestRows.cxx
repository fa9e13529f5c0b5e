// Nearest rows beside a search through all of them.
#include "Spectrum/NearestRows.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;

namespace
{

/// Rows on a surface in twelve dimensions.
MultiVector OnASurface(Id count, double shift)
{
  MultiVector rows(count, 12);
  for (Id row = 0; row < count; ++row)
  {
    const double u = std::fmod(0.618034 * double(row) + shift, 1.0);
    const double v = (double(row) + 0.5) / double(count);
    for (Id k = 0; k < rows.cols(); ++k)
    {
      rows(row, k) = std::cos(double(k + 1) * u) + std::sin(double(2 * k + 1) * v);
    }
  }
  return rows;
}

Id NearestOfAll(const MultiVector& rows, const Eigen::RowVectorXd& query)
{
  Id nearest = 0;
  (rows.rowwise() - query).rowwise().squaredNorm().minCoeff(&nearest);
  return nearest;
}

} // namespace

/// On the surface, near it, and far from it.
TEST(NearestRows, AreThoseOfASearchThroughAll)
{
  const MultiVector rows = OnASurface(900, 0.0);
  const NearestRows tree(rows);
  for (const double away : { 0.0, 0.3, 30.0 })
  {
    MultiVector queries = OnASurface(200, 0.1);
    queries.array() += away;
    const std::vector<Id> found = tree.Find(queries);
    for (Id query = 0; query < queries.rows(); ++query)
    {
      EXPECT_EQ(found[query], NearestOfAll(rows, queries.row(query))) << query << " " << away;
    }
    EXPECT_EQ(tree.Find(queries, 1), tree.Find(queries, 3));
  }
}

TEST(NearestRows, FewRowsAndEqualRows)
{
  EXPECT_EQ(NearestRows(MultiVector::Ones(1, 4)).Find(MultiVector::Zero(3, 4)),
    std::vector<Id>({ 0, 0, 0 }));
  MultiVector rows = OnASurface(50, 0.0);
  rows.row(40) = rows.row(7);
  EXPECT_EQ(NearestRows(rows).Find(rows.row(40)), std::vector<Id>{ 7 });
}
