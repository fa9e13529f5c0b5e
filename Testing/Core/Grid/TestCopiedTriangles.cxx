// Triangles that a mesh has several times.
#include "Grid/CopiedTriangles.h"
#include "Meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

std::vector<Id> Numbers(const TriangleMesh& mesh)
{
  std::vector<Id> numbers(mesh.triangles.size());
  std::iota(numbers.begin(), numbers.end(), Id(0));
  return numbers;
}

} // namespace

TEST(DropCopies, KeepsTheFirstOfEachAndCountsTheOthers)
{
  for (const TriangleMesh& mesh : { GeodesicSphere(4), FlatRectangle(5, 3), Box(2) })
  {
    TriangleMesh doubled = mesh;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
    {
      const auto& [a, b, c] = mesh.triangles[t];
      doubled.triangles.push_back({ b, c, a }); // as it is
      doubled.triangles.push_back({ b, a, c }); // turned over
    }
    const auto copies = static_cast<Id>(doubled.triangles.size() - mesh.triangles.size());
    std::vector<Id> source = Numbers(doubled);
    EXPECT_EQ(DropCopies(doubled, source), copies);
    EXPECT_EQ(doubled.triangles, mesh.triangles);
    EXPECT_EQ(source, Numbers(mesh));
    EXPECT_EQ(DropCopies(doubled, source), 0);
    EXPECT_EQ(doubled.triangles, mesh.triangles);
  }
}

/// A point with very many triangles, in any order and turned in any way.
TEST(DropCopies, FindsThemAroundAPointOfManyTriangles)
{
  constexpr Id Around = 100000;
  TriangleMesh fan;
  fan.points.resize(Around + 1, Vec3::Zero());
  std::mt19937 random(1);
  for (Id k = 1; k <= Around; ++k)
  {
    std::array<Id, 3> triangle = { 0, k, k % Around + 1 };
    for (Id copy = 0; copy < (k % 5 == 0 ? 3 : 1); ++copy)
    {
      std::shuffle(triangle.begin(), triangle.end(), random);
      fan.triangles.push_back(triangle);
    }
  }
  std::shuffle(fan.triangles.begin(), fan.triangles.end(), random);
  TriangleMesh kept = fan;
  std::vector<Id> source = Numbers(fan);
  EXPECT_EQ(DropCopies(kept, source), 2 * (Around / 5));
  EXPECT_TRUE(std::is_sorted(source.begin(), source.end()));
  std::vector<char> isKept(fan.triangles.size(), 0);
  for (const Id triangle : source)
  {
    isKept[triangle] = 1;
  }
  std::vector<char> isSeen(Around + 1, 0); // by the side opposite to point 0
  for (std::size_t t = 0; t < fan.triangles.size(); ++t)
  {
    std::array<Id, 3> corners = fan.triangles[t];
    std::sort(corners.begin(), corners.end());
    char& seen = isSeen[corners[2] - corners[1] > 1 ? Around : corners[1]];
    ASSERT_EQ(isKept[t], seen ? 0 : 1) << t;
    seen = 1;
  }
}
