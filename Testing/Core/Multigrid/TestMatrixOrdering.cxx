// The order in which hats are relaxed, and their groups.
#include "Multigrid/MatrixOrdering.h"

#include "Meshes.h"
#include "SampledHierarchy.h"
#include "Spaces/HatMatrices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// The blocks of an order that contain each unknown.
std::vector<std::set<Id>> BlocksOfUnknowns(const PatchOrder& order, Index unknowns)
{
  std::vector<std::set<Id>> blocks(unknowns);
  for (Id block = 0; block + 1 < static_cast<Id>(order.blockBegin.size()); ++block)
  {
    for (Id k = order.blockBegin[block]; k < order.blockBegin[block + 1]; ++k)
    {
      for (const Index unknown : order.dof[k])
      {
        if (unknown >= 0)
        {
          blocks[unknown].insert(block);
        }
      }
    }
  }
  return blocks;
}

/// Blocks of one color are relaxed at the same time.
void ExpectColorsSeparateBlocks(const PatchOrder& order, const SparseMatrix& A)
{
  const std::vector<std::set<Id>> blocks = BlocksOfUnknowns(order, A.rows);
  std::vector<std::size_t> color(order.blockBegin.size() - 1);
  EXPECT_GE(color.size(), 6u); // there is something to color
  for (std::size_t c = 0; c + 1 < order.colorBegin.size(); ++c)
  {
    std::fill(color.begin() + order.colorBegin[c], color.begin() + order.colorBegin[c + 1], c);
  }
  for (Index i = 0; i < A.rows; ++i)
  {
    for (Id k = A.rowBegin[i]; k < A.rowBegin[i + 1]; ++k)
    {
      for (const Id a : blocks[i])
      {
        for (const Id b : blocks[A.column[k]])
        {
          ASSERT_TRUE(a == b || color[a] != color[b]) << i << " " << A.column[k];
        }
      }
    }
  }
}

/// 18 points around a large ring at each of `along` places.
TriangleMesh Ring(int along)
{
  return Torus(along, 18, 10.0, 0.3);
}

SparseMatrix HatStiffness(const TriangleMesh& mesh)
{
  return AssembleHatMatrices(mesh, NumberHatFunctions(mesh)).stiffness;
}

} // namespace

TEST(HatOrdering, VisitsEveryUnknownOnceAndSeparatesBlocksOfAColor)
{
  const SparseMatrix A = HatStiffness(GeodesicSphere(30)); // 3602 functions
  const PatchOrder order = OrderInBlocks(A);
  std::vector<int> visits(A.rows, 0);
  for (const Index unknown : order.dof.unknown)
  {
    visits[std::max(unknown, 0)] += unknown >= 0;
  }
  EXPECT_EQ(visits, std::vector<int>(A.rows, 1));
  ExpectColorsSeparateBlocks(order, A);
}

TEST(HatOrdering, GroupsReachEveryUnknownAndSeparateBlocksOfAColor)
{
  for (const TriangleMesh& mesh : { GeodesicSphere(30), Ring(150), Ring(600) })
  {
    const SparseMatrix A = HatStiffness(mesh);
    for (const int size : { 8, 27 })
    {
      const PatchOrder groups = GroupByCoupling(A, 0, size);
      EXPECT_EQ(groups.dof.size, size);
      const std::vector<std::set<Id>> blocks = BlocksOfUnknowns(groups, A.rows);
      EXPECT_TRUE(std::none_of(
        blocks.begin(), blocks.end(), [](const std::set<Id>& b) { return b.empty(); }));
      EXPECT_TRUE(std::any_of(blocks.begin(), blocks.end(),
        [](const std::set<Id>& b) { return b.size() > 1; })); // some groups cross borders
      ExpectColorsSeparateBlocks(groups, A);
    }
  }
}

TEST(HatOrdering, ThreadsDoNotChangeABitOfGroupsOfAnySize)
{
  const SparseMatrix A = HatStiffness(GeodesicSphere(30));
  const auto smoother = MakePatchSmoother(A, GroupByCoupling(A, 0, 27));
  const MultiVector b = RandomValues(A.rows, 3, 1);
  MultiVector one = RandomValues(A.rows, 3, 2);
  MultiVector two = one;
  smoother->Sweep(A, b, one, SweepDirection::Forward, 1);
  smoother->Sweep(A, b, two, SweepDirection::Forward, 2);
  EXPECT_EQ(one, two);
}

TEST(HatOrdering, GroupsFollowStrongCouplings)
{
  // Triangles are four times as long along the ring as around the tube. All 18 points at one place
  // are strongly coupled, so no group of eight leaves the place.
  constexpr double Pi = 3.14159265358979323846;
  constexpr int Along = 150;
  const TriangleMesh mesh = Ring(Along);
  const HatFunctions hats = NumberHatFunctions(mesh);
  std::vector<long> place(hats.Count());
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
  {
    const double angle = std::atan2(mesh.points[p][1], mesh.points[p][0]);
    place[hats.ofPoint[p]] = std::lround(angle / (2.0 * Pi) * Along + Along) % Along;
  }
  const UnknownGroups groups = GroupByCoupling(HatStiffness(mesh)).dof;
  for (Id group = 0; group < groups.Count(); ++group)
  {
    for (const Index member : groups[group])
    {
      ASSERT_GE(member, 0);
      EXPECT_EQ(place[member], place[groups[group][0]]);
    }
  }
}
