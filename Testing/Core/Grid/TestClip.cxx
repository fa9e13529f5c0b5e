// Tests clipping: nothing is lost or doubled, every piece is inside its cell, and neighbors agree
// on cut points.
#include "Grid/Clip.h"

#include "Base/Errors.h"
#include "Support/Meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

struct NamedMesh
{
  std::string name;
  TriangleMesh mesh;
};

std::vector<NamedMesh> MakeMeshes()
{
  const TriangleMesh sphere = LatLongSphere(40, 21);
  return {
    { "sphere", sphere },
    { "geodesic", GeodesicSphere(9) },
    { "cube on grid planes", Box(8) },
    { "cube off grid planes", Box(3) },
    { "cube of twelve triangles", Box(1) },
    { "cube turned by 45 degrees", Transform(Box(4), { 0, 0, 1 }, std::acos(-1.0) / 4) },
    { "cube barely turned", Transform(Box(4), { 1, 1, 1 }, 1e-3) },
    { "rectangle", FlatRectangle(5, 3, 2.0, 1.0) },
    { "trefoil", TrefoilTube(120, 12, 0.4) },
    { "soup", Unweld(sphere) },
    { "far away", Transform(sphere, { 0, 0, 1 }, 0.0, 1.0, { 5e6, -5e6, 5e6 }) },
    { "tiny", Transform(sphere, { 0, 0, 1 }, 0.3, 1e-9) },
    { "huge", Transform(sphere, { 0, 0, 1 }, 0.3, 1e9) },
  };
}

ClippedMesh ClipAt(const TriangleMesh& mesh, int depth, int threads = 0)
{
  ClipOptions options;
  options.depth = depth;
  options.threads = threads;
  return Clip(mesh, options);
}

double ClippedArea(const ClippedMesh& clipped)
{
  double area = 0.0;
  for (Id piece = 0; piece < clipped.NumberOfPieces(); ++piece)
  {
    area += PieceArea(clipped, piece);
  }
  return area * clipped.grid.spacing * clipped.grid.spacing;
}

/// Returns a rectangle in a grid of 16 cells per side. Its heights differ from a grid plane by up
/// to half of `deviation` (in cells), so that points and cuts are snapped to the plane one by one.
TriangleMesh NearlyOnAGridPlane(unsigned seed, double deviation)
{
  const double cell = 1.0 / 16.0;
  std::mt19937 generator(seed);
  TriangleMesh mesh = FlatRectangle(3, 2, 1.0, 0.3);
  for (Vec3& point : mesh.points)
  {
    const double part = double(generator()) / double(std::mt19937::max());
    point[2] = cell * (4.0 + deviation * (part - 0.5));
  }
  return Join(mesh, Transform(FlatRectangle(1, 1), { 1, 0, 0 }, std::acos(-1.0) / 2)); // fixes the
                                                                                       // heights of
                                                                                       // the grid
}

/// Returns the cells that each link connects, in ascending order.
std::vector<std::pair<MortonKey, MortonKey>> LinkedCells(const ClippedMesh& clipped)
{
  const Array<Index> cell = PieceCells(clipped);
  std::vector<std::pair<MortonKey, MortonKey>> linked;
  for (const Link& link : clipped.links)
  {
    linked.push_back(
      std::minmax(clipped.cells[cell[link.first]], clipped.cells[cell[link.second]]));
  }
  std::sort(linked.begin(), linked.end());
  return linked;
}

} // namespace

TEST(Clip, AreasAddUp)
{
  for (const auto& [name, mesh] : MakeMeshes())
  {
    for (const int depth : { 2, 4, 6 })
    {
      const double area = SurfaceArea(mesh);
      EXPECT_NEAR(ClippedArea(ClipAt(mesh, depth)), area, 1e-12 * area) << name << " " << depth;
    }
  }
}

TEST(Clip, AreasOfEveryTriangleAddUp)
{
  const TriangleMesh mesh = Transform(LatLongSphere(30, 15), { 1, 2, 3 }, 0.7);
  const ClippedMesh clipped = ClipAt(mesh, 5);
  std::vector<double> area(mesh.triangles.size(), 0.0);
  for (Id piece = 0; piece < clipped.NumberOfPieces(); ++piece)
  {
    area[clipped.pieceTriangle[piece]] += PieceArea(clipped, piece);
  }
  for (std::size_t t = 0; t < area.size(); ++t)
  {
    const Vec3& a = mesh.points[mesh.triangles[t][0]];
    const double whole =
      0.5 *
      (mesh.points[mesh.triangles[t][1]] - a).cross(mesh.points[mesh.triangles[t][2]] - a).norm();
    EXPECT_NEAR(area[t] * std::pow(clipped.grid.spacing, 2), whole, 1e-12 * whole) << t;
  }
}

TEST(Clip, AreasAddUpNearAGridPlane)
{
  for (unsigned seed = 1; seed <= 100; ++seed)
  {
    const TriangleMesh mesh = NearlyOnAGridPlane(seed, 6e-10);
    const double area = SurfaceArea(mesh);
    ASSERT_NEAR(ClippedArea(ClipAt(mesh, 4)), area, 1e-9 * area) << seed;
  }
}

TEST(Clip, LinksTheSameCellsWhenTrianglesAreTurnedOver)
{
  for (const double deviation : { 6e-10, 1e-9, 3e-9, 1e-8 })
  {
    for (unsigned seed = 1; seed <= 25; ++seed)
    {
      const TriangleMesh mesh = NearlyOnAGridPlane(seed, deviation);
      TriangleMesh turned = mesh;
      for (auto& corner : turned.triangles)
      {
        std::swap(corner[1], corner[2]);
      }
      const ClippedMesh clipped = ClipAt(mesh, 4);
      const ClippedMesh other = ClipAt(turned, 4);
      ASSERT_EQ(clipped.cells, other.cells) << seed << " " << deviation;
      ASSERT_EQ(LinkedCells(clipped), LinkedCells(other)) << seed << " " << deviation;
    }
  }
}

TEST(Clip, PiecesStayInsideTheirCells)
{
  for (const auto& [name, mesh] : MakeMeshes())
  {
    const ClippedMesh clipped = ClipAt(mesh, 5);
    // A coordinate within the rounding of the input of a plane counts as lying on it.
    const double tolerance = name == "far away" ? 1e-6 : 1e-9;
    for (Id piece = 0; piece < clipped.NumberOfPieces(); ++piece)
    {
      const CellIndex cell = MortonDecode(clipped.cells[clipped.CellOf(piece)]);
      for (Id k = clipped.pieceBegin[piece]; k < clipped.pieceBegin[piece + 1]; ++k)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          const double local = clipped.position[clipped.corners[k]][axis] - cell[axis];
          ASSERT_GE(local, -tolerance) << name;
          ASSERT_LE(local, 1.0 + tolerance) << name;
        }
      }
    }
  }
}

TEST(Clip, PiecesAreSortedByCellThenTriangle)
{
  const ClippedMesh clipped = ClipAt(TrefoilTube(120, 12, 0.4), 5);
  for (std::size_t c = 1; c < clipped.cells.size(); ++c)
  {
    ASSERT_LT(clipped.cells[c - 1], clipped.cells[c]);
  }
  const Array<Index> cell = PieceCells(clipped);
  EXPECT_EQ(cell.front(), 0);
  EXPECT_EQ(cell.back() + 1, static_cast<Index>(clipped.cells.size()));
  for (Id piece = 1; piece < clipped.NumberOfPieces(); ++piece)
  {
    ASSERT_EQ(cell[piece], clipped.CellOf(piece));
    const auto key = [&](Id p) { return std::pair(cell[p], clipped.pieceTriangle[p]); };
    ASSERT_LE(key(piece - 1), key(piece));
  }
}

// On a closed surface, every edge of every piece has exactly one partner with the same point ids.
// This means that cut points shared by neighbors are a single point.
TEST(Clip, ClosedMeshStaysClosed)
{
  for (const auto& [name, mesh] : MakeMeshes())
  {
    if (name == "rectangle" || name == "soup")
    {
      continue;
    }
    const ClippedMesh clipped = ClipAt(mesh, 5);
    std::map<std::pair<Id, Id>, int> balance;
    for (Id piece = 0; piece < clipped.NumberOfPieces(); ++piece)
    {
      const Id begin = clipped.pieceBegin[piece];
      const Id end = clipped.pieceBegin[piece + 1];
      for (Id k = begin; k < end; ++k)
      {
        const Id a = clipped.corners[k];
        const Id b = clipped.corners[k + 1 == end ? begin : k + 1];
        balance[std::minmax(a, b)] += a < b ? 1 : -1;
      }
    }
    for (const auto& [edge, sum] : balance)
    {
      ASSERT_EQ(sum, 0) << name << ": edge " << edge.first << " " << edge.second;
    }
    // Every edge has two sides, and each pair of sides is linked.
    std::set<std::pair<Id, Id>> links;
    for (const Link& link : clipped.links)
    {
      ASSERT_LT(link.first, link.second);
      links.insert({ link.first, link.second });
    }
    EXPECT_EQ(balance.size(), clipped.links.size()) << name;
  }
}

TEST(Clip, CutPointsAreUsedAndLieOnTheirTriangle)
{
  const TriangleMesh mesh = Transform(Box(4), { 0, 0, 1 }, std::acos(-1.0) / 4);
  const ClippedMesh clipped = ClipAt(mesh, 5);
  std::vector<int> used(clipped.position.size(), 0);
  for (const Id corner : clipped.corners)
  {
    used[corner] = 1;
  }
  for (std::size_t k = 0; k < clipped.cutPoints.size(); ++k)
  {
    const CutPoint& cut = clipped.cutPoints[k];
    const std::array<double, 3> weight = cut.Weights();
    EXPECT_TRUE(used[clipped.numberOfInputPoints + k]);
    Vec3 position = Vec3::Zero();
    double sum = 0.0;
    for (int corner = 0; corner < 3; ++corner)
    {
      EXPECT_GE(weight[corner], -1e-15);
      sum += weight[corner];
      position +=
        weight[corner] * clipped.grid.ToGrid(mesh.points[mesh.triangles[cut.triangle][corner]]);
    }
    EXPECT_NEAR(sum, 1.0, 1e-14);
    EXPECT_LT((position - clipped.position[clipped.numberOfInputPoints + k]).norm(), 1e-13);
  }
}

// The cube's faces lie in planes of the grid. Each face belongs to one layer of cells.
TEST(Clip, CubeOnGridPlanesIsHandledOnce)
{
  for (const int n : { 1, 2, 3, 8 })
  {
    const ClippedMesh clipped = ClipAt(Box(n), 4);
    EXPECT_EQ(clipped.cells.size(), 16u * 16 * 16 - 14u * 14 * 14) << n;
    EXPECT_NEAR(ClippedArea(clipped), 6.0, 1e-12) << n;
  }
  const ClippedMesh aligned = ClipAt(Box(16), 4);
  EXPECT_EQ(aligned.NumberOfPieces(), 6 * 16 * 16 * 2);
  EXPECT_TRUE(aligned.cutPoints.empty());
}

TEST(Clip, PlaneThroughGridLinesMakesNoSlivers)
{
  // On x + y = constant through lattice points, rounding must not add cells beside the diagonal
  // cells.
  TriangleMesh diagonal;
  diagonal.points = { { 0, 0, 0 }, { 1, 1, 0 }, { 1, 1, 1 }, { 0, 0, 1 } };
  diagonal.triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  const TriangleMesh turned = Transform(diagonal, { 0, 0, 1 }, 1e-13, 0.3, { 7.1, 0.3, 0.2 });
  EXPECT_EQ(ClipAt(diagonal, 4).cells.size(), 16u * 16);
  EXPECT_EQ(ClipAt(turned, 4).cells.size(), 16u * 16);
}

TEST(Clip, SphereOfThesisTable43)
{
  const ClippedMesh clipped = ClipAt(LatLongSphere(140, 69), 5);
  EXPECT_EQ(clipped.cells.size(), 4760u);
}

TEST(Clip, SoupGivesTheCellsAndLinksOfItsWeldedMesh)
{
  const TriangleMesh mesh = LatLongSphere(40, 21);
  const ClippedMesh welded = ClipAt(mesh, 5);
  const ClippedMesh soup = ClipAt(Unweld(mesh), 5);
  EXPECT_EQ(welded.cells, soup.cells);
  EXPECT_EQ(welded.pieceTriangle, soup.pieceTriangle);
  EXPECT_EQ(welded.links.size(), soup.links.size());
  ClipOptions options;
  options.depth = 5;
  options.weldCoincidentPoints = false;
  EXPECT_LT(Clip(Unweld(mesh), options).links.size(), welded.links.size());
}

TEST(Clip, IsTheSameForAnyNumberOfThreads)
{
  const TriangleMesh mesh = TrefoilTube(600, 24, 0.4);
  const ClippedMesh one = ClipAt(mesh, 6, 1);
  const ClippedMesh three = ClipAt(mesh, 6, 3);
  EXPECT_EQ(one.corners, three.corners);
  EXPECT_EQ(one.pieceTriangle, three.pieceTriangle);
  EXPECT_EQ(one.position, three.position);
  ASSERT_EQ(one.links.size(), three.links.size());
  for (std::size_t k = 0; k < one.links.size(); ++k)
  {
    ASSERT_EQ(one.links[k].first, three.links[k].first);
    ASSERT_EQ(one.links[k].second, three.links[k].second);
  }
}

TEST(Clip, NeedlesAcrossAFineGrid)
{
  TriangleMesh needle;
  needle.points = { { 0, 0, 0 }, { 1, 0.99, 0.98 }, { 1, 0.99 + 1e-4, 0.98 } };
  needle.triangles = { { 0, 1, 2 } };
  const ClippedMesh clipped = ClipAt(needle, 12);
  EXPECT_NEAR(ClippedArea(clipped), SurfaceArea(needle), 1e-12 * SurfaceArea(needle));
  EXPECT_GT(clipped.NumberOfPieces(), 3 * 4000);
}

TEST(Clip, NonManifoldEdgesConnectAllTheirTriangles)
{
  TriangleMesh fins;
  fins.points = { { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0.5 }, { -1, 0.1, 0.5 }, { 0.2, 1, 0.5 } };
  fins.triangles = { { 0, 1, 2 }, { 0, 1, 3 }, { 1, 0, 4 } };
  const ClippedMesh clipped = ClipAt(fins, 2);
  std::set<std::pair<Id, Id>> pairs;
  for (const Link& link : clipped.links)
  {
    const Id a = clipped.pieceTriangle[link.first];
    const Id b = clipped.pieceTriangle[link.second];
    if (a != b)
    {
      pairs.insert(std::minmax(a, b));
    }
  }
  // Within one cell, a tree is enough: the lowest triangle is linked to both others.
  EXPECT_TRUE(pairs.count({ 0, 1 }));
  EXPECT_TRUE(pairs.count({ 0, 2 }));
}

TEST(Clip, DegenerateTrianglesAreKept)
{
  TriangleMesh mesh = LatLongSphere(20, 9);
  mesh.triangles.push_back({ 3, 3, 3 });
  mesh.triangles.push_back({ 3, 3, 7 });
  mesh.triangles.push_back({ 3, 7, 3 });
  const ClippedMesh clipped = ClipAt(mesh, 5);
  std::set<Id> seen(clipped.pieceTriangle.begin(), clipped.pieceTriangle.end());
  EXPECT_EQ(seen.size(), mesh.triangles.size());
  const double area = SurfaceArea(mesh);
  EXPECT_NEAR(ClippedArea(clipped), area, 1e-12 * area);
}

TEST(Clip, RefusesWhatItCannotClip)
{
  TriangleMesh mesh = Box(1);
  EXPECT_THROW(ClipAt(mesh, 1), InvalidInput);
  EXPECT_THROW(ClipAt(mesh, 15), InvalidInput);
  mesh.points[3][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ClipAt(mesh, 4), InvalidInput);
  mesh = Box(1);
  mesh.triangles[2][1] = 1000;
  EXPECT_THROW(ClipAt(mesh, 4), InvalidInput);
}

TEST(Clip, StopsWhenAsked)
{
  int calls = 0;
  const Progress progress([&](double) { return ++calls < 5; });
  ClipOptions options;
  options.depth = 6;
  EXPECT_THROW(Clip(Box(20), options, progress), Aborted);
}

TEST(Clip, EmptyMeshGivesNothing)
{
  const ClippedMesh clipped = ClipAt(TriangleMesh(), 4);
  EXPECT_EQ(clipped.NumberOfPieces(), 0);
  EXPECT_EQ(clipped.NumberOfTriangles(), 0);
}

TEST(Clip, OnOneThreadWorksInsideAParallelRegion)
{
  const TriangleMesh mesh = GeodesicSphere(9);
  ClipOptions options;
  options.depth = 4;
  options.threads = 1;
  const ClippedMesh alone = Clip(mesh, options);
  std::array<bool, 4> isEqual{};
#pragma omp parallel for num_threads(4) schedule(static, 1)
  for (int k = 0; k < 4; ++k)
  {
    const ClippedMesh clipped = Clip(mesh, options);
    isEqual[k] = clipped.corners == alone.corners && clipped.links == alone.links;
  }
  for (const bool equal : isEqual)
  {
    EXPECT_TRUE(equal);
  }
}

namespace
{

class ClipOfRealMesh : public ::testing::TestWithParam<const char*>
{
};

} // namespace

TEST_P(ClipOfRealMesh, KeepsTheArea)
{
  const std::string path = RealMesh(GetParam());
  if (path.empty())
  {
    GTEST_SKIP() << "no real mesh " << GetParam();
  }
  const TriangleMesh mesh = ReadMesh(path);
  const double area = SurfaceArea(mesh);
  EXPECT_NEAR(ClippedArea(ClipAt(mesh, 6)), area, 1e-12 * area);
}

INSTANTIATE_TEST_SUITE_P(Files, ClipOfRealMesh,
  ::testing::Values("rocker_arm.ply", "cheese_18k.ply", "conrod.stl", "cycloidal_43k.ply",
    "dragon_res3_nonmanifold.ply", "stanford_bunny.ply"));
