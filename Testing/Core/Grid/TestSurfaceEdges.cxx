// Tests where surfaces end, and which way they face.
#include "Grid/SurfaceEdges.h"

#include "Meshes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// Returns a band of `squares` squares. A twisted band is closed after half a turn.
TriangleMesh Band(Id squares, bool isTwisted)
{
  TriangleMesh mesh;
  for (Id i = 0; i < squares; ++i)
  {
    const double angle = 2 * M_PI * double(i) / double(squares);
    const double tilt = isTwisted ? 0.5 * angle : 0.0;
    for (const double across : { -0.3, 0.3 })
    {
      const double radius = 1.0 + across * std::sin(tilt);
      mesh.points.emplace_back(
        radius * std::cos(angle), radius * std::sin(angle), across * std::cos(tilt));
    }
    const bool isLast = i + 1 == squares;
    const Id a = 2 * i;
    const Id next = isLast ? 0 : a + 2;
    const Id c = isLast && isTwisted ? next + 1 : next;
    const Id d = isLast && isTwisted ? next : next + 1;
    mesh.triangles.push_back({ a, c, d });
    mesh.triangles.push_back({ a, d, a + 1 });
  }
  return mesh;
}

} // namespace

TEST(SurfaceEdges, AreBoundaryWhereOneTriangleEnds)
{
  const TriangleMesh sheet = FlatRectangle(4, 3);
  const SurfaceEdges edges = FindSurfaceEdges(sheet, true);
  EXPECT_EQ(edges.boundary.size(), 14u);
  EXPECT_EQ(EndsOf(edges.boundary, sheet).size(), 14u);
  EXPECT_TRUE(edges.branching.empty());
  EXPECT_TRUE(edges.IsOriented());
  EXPECT_EQ(edges.numberOfComponents, 1);

  const TriangleMesh soup = Unweld(GeodesicSphere(3));
  EXPECT_TRUE(FindSurfaceEdges(soup, true).boundary.empty());
  EXPECT_EQ(FindSurfaceEdges(soup, false).boundary.size(), 3 * soup.triangles.size());
}

TEST(SurfaceEdges, SidesFollowMostOfTheArea)
{
  TriangleMesh mesh = Join(GeodesicSphere(4), Band(12, false));
  const std::size_t sphere = GeodesicSphere(4).triangles.size();
  for (const std::size_t turned : { std::size_t(0), std::size_t(7), sphere + 1 })
  {
    std::swap(mesh.triangles[turned][0], mesh.triangles[turned][1]);
  }
  const SurfaceEdges edges = FindSurfaceEdges(mesh, true);
  EXPECT_EQ(edges.numberOfComponents, 2);
  EXPECT_EQ(edges.numberOfOneSided, 0);
  EXPECT_FALSE(edges.IsOriented());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    EXPECT_EQ(edges.side[t], t == 0 || t == 7 || t == sphere + 1 ? -1 : 1) << t;
  }
}

TEST(SurfaceEdges, KnowAMoebiusStrip)
{
  const TriangleMesh mesh = Join(Band(20, true), GeodesicSphere(2, 0.2));
  const SurfaceEdges edges = FindSurfaceEdges(mesh, true);
  EXPECT_EQ(edges.boundary.size(), 40u);
  EXPECT_EQ(edges.numberOfComponents, 2);
  EXPECT_EQ(edges.numberOfOneSided, 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    EXPECT_EQ(edges.side[t], t < 40 ? 0 : 1) << t;
  }
}

TEST(SurfaceEdges, PartComponentsWhereSheetsBranch)
{
  // Three triangles share an edge, and a triangle without area does not count.
  TriangleMesh mesh;
  mesh.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 } };
  mesh.triangles = { { 0, 1, 2 }, { 1, 0, 3 }, { 0, 1, 4 }, { 0, 1, 1 } };
  const SurfaceEdges edges = FindSurfaceEdges(mesh, true);
  EXPECT_EQ(edges.boundary.size(), 6u);
  ASSERT_EQ(edges.branching.size(), 1u);
  EXPECT_EQ(edges.branching[0].Ends(mesh), (std::array<Id, 2>{ 0, 1 }));
  EXPECT_EQ(edges.numberOfComponents, 4);
}
