// Messages that do not fit what a rank expects end on all ranks with an error. They are not read
// beyond their ends, and no rank waits forever.
#include "Surfaces.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// A sphere in pieces, one for each rank.
class Redistributed : public ::testing::Test
{
protected:
  const Communicator ranks_{ MPI_COMM_WORLD };
  const int odd_ = ranks_.Size() - 1; // the rank that differs
  const TriangleMesh mesh_ = Surfaces().front().mesh;
  const TriangleMesh own_ =
    PartOf(mesh_, Deal(mesh_, Dealing::Contiguous, ranks_.Size()), ranks_.Rank());
  const RankSpace space_{ ranks_, own_, Options(4) };
  const Redistribution& distribution_ = space_.Distribution();

  bool IsOdd() const { return ranks_.Rank() == odd_; }

  /// A field whose rows hold their numbers, with a column more on one rank.
  MultiVector Rows(Id rows, bool hasMoreColumns, bool hasMoreRows = false) const
  {
    const Id columns = hasMoreColumns && this->IsOdd() ? 3 : 2;
    MultiVector field(rows + (hasMoreRows && this->IsOdd() ? 1 : 0), columns);
    for (Id row = 0; row < field.rows(); ++row)
    {
      field.row(row).setConstant(static_cast<double>(row));
    }
    return field;
  }

  Id Points() const { return static_cast<Id>(own_.points.size()); }
  Id Triangles() const { return static_cast<Id>(own_.triangles.size()); }
};

} // namespace

TEST_F(Redistributed, FieldsOfTheRightShapeComeAndReturn)
{
  const MultiVector own = this->Rows(this->Points(), false);
  const MultiVector received = distribution_.SendPoints(own);
  MultiVector returned = MultiVector::Constant(own.rows(), own.cols(), -1.0);
  const std::vector<char> isReturned = distribution_.ReturnPoints(
    received, std::vector<char>(static_cast<std::size_t>(received.rows()), 1), returned);
  for (Id row = 0; row < own.rows(); ++row)
  {
    EXPECT_TRUE(isReturned[static_cast<std::size_t>(row)]) << row;
    EXPECT_EQ(returned.row(row), own.row(row)) << row;
  }
}

TEST_F(Redistributed, OtherColumnsOnARankAreRefusedByAll)
{
  if (ranks_.Size() == 1)
  {
    EXPECT_NO_THROW(distribution_.SendPoints(this->Rows(this->Points(), true)));
    return;
  }
  EXPECT_THROW(distribution_.SendPoints(this->Rows(this->Points(), true)), RankFailure);
  EXPECT_THROW(distribution_.SendTriangles(this->Rows(this->Triangles(), true)), RankFailure);
  const Id received = distribution_.SendTriangles(this->Rows(this->Triangles(), false)).rows();
  EXPECT_THROW(distribution_.SumTriangles(this->Rows(received, true)), RankFailure);
}

TEST_F(Redistributed, ARowTooManyIsRefusedByAll)
{
  EXPECT_THROW(distribution_.SendPoints(this->Rows(this->Points(), false, true)), RankFailure);
  EXPECT_THROW(
    distribution_.SendTriangles(this->Rows(this->Triangles(), false, true)), RankFailure);
  const Id received = distribution_.SendPoints(this->Rows(this->Points(), false)).rows();
  MultiVector own = this->Rows(this->Points(), false);
  const std::vector<char> areKnown(static_cast<std::size_t>(received) + 1, 1);
  EXPECT_THROW(
    distribution_.ReturnPoints(this->Rows(received, false, true), areKnown, own), RankFailure);
}
