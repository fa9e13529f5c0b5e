// Triangles that a mesh has several times.
#include "Grid/CopiedTriangles.h"
#include "Meshes.h"

#include <gtest/gtest.h>

#include <numeric>

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
