// Tests the test meshes themselves: topology, orientation, sizes. Other tests rely on these facts.
#include "Meshes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr double Pi = 3.14159265358979323846;

using DirectedEdges = std::map<std::pair<Id, Id>, int>;

DirectedEdges CountDirectedEdges(const TriangleMesh& mesh)
{
  DirectedEdges count;
  for (const auto& t : mesh.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      ++count[{ t[k], t[(k + 1) % 3] }];
    }
  }
  return count;
}

/// Whether every directed edge and its opposite occur once. The mesh is then closed and oriented,
/// with manifold edges.
bool IsClosedAndOriented(const TriangleMesh& mesh)
{
  const DirectedEdges edges = CountDirectedEdges(mesh);
  for (const auto& [edge, count] : edges)
  {
    const auto opposite = edges.find({ edge.second, edge.first });
    if (count != 1 || opposite == edges.end())
    {
      return false;
    }
  }
  return true;
}

Id EulerCharacteristic(const TriangleMesh& mesh)
{
  std::set<std::pair<Id, Id>> edges;
  for (const auto& [edge, count] : CountDirectedEdges(mesh))
  {
    edges.insert(std::minmax(edge.first, edge.second));
  }
  return static_cast<Id>(mesh.points.size()) - static_cast<Id>(edges.size()) +
         static_cast<Id>(mesh.triangles.size());
}

/// Returns the enclosed volume, positive if the triangles point outward.
double EnclosedVolume(const TriangleMesh& mesh)
{
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    volume += mesh.points[a].dot(mesh.points[b].cross(mesh.points[c])) / 6;
  }
  return volume;
}

struct ClosedCase
{
  const char* name;
  TriangleMesh mesh;
  Id eulerCharacteristic;
};

std::vector<ClosedCase> ClosedMeshes()
{
  return { { "LatLongSphere", LatLongSphere(12, 7), 2 }, { "GeodesicSphere", GeodesicSphere(5), 2 },
    { "Box", Box(3), 2 }, { "TrefoilTube", TrefoilTube(120, 12), 0 },
    { "Torus", Torus(30, 12, 2.0, 0.5), 0 }, { "CubeArray", CubeArray(2, 2, 0.25), 16 },
    { "Pulley", Pulley(40, 0.05), 0 },
    { "SubdivideInPlane", SubdivideInPlane(GeodesicSphere(3)), 2 },
    { "Transform", Transform(Box(2), Vec3(1, 2, 3), 0.7, 3.0, Vec3(9, 8, 7)), 2 },
    { "Join", Join(Box(1), Torus(12, 8, 2.0, 0.5)), 2 } };
}

} // namespace

TEST(Meshes, ClosedOnesAreClosedOrientedOutwardsAndHaveTheirGenus)
{
  for (const ClosedCase& test : ClosedMeshes())
  {
    SCOPED_TRACE(test.name);
    EXPECT_TRUE(IsClosedAndOriented(test.mesh));
    EXPECT_EQ(EulerCharacteristic(test.mesh), test.eulerCharacteristic);
    EXPECT_GT(EnclosedVolume(test.mesh), 0.0);
  }
}

TEST(Meshes, FlatOnesAreDiscsThatPointUp)
{
  const TriangleMesh flat = FlatRectangle(4, 3, 2.0, 1.5);
  EXPECT_EQ(EulerCharacteristic(flat), 1);
  EXPECT_DOUBLE_EQ(SurfaceArea(flat), 3.0);
  for (const auto& [a, b, c] : flat.triangles)
  {
    const Vec3 u = flat.points[b] - flat.points[a], v = flat.points[c] - flat.points[a];
    EXPECT_GT(u.cross(v).z(), 0.0);
  }

  const TriangleMesh sheets = TwoSheets(3, 0.125);
  EXPECT_EQ(EulerCharacteristic(sheets), 2);
  EXPECT_EQ(sheets.points.back().z(), 0.125);
}

TEST(Meshes, SphereOfTable43HasItsCounts)
{
  const TriangleMesh sphere = LatLongSphere(140, 69);
  EXPECT_EQ(sphere.points.size(), 9662u);
  EXPECT_EQ(sphere.triangles.size(), 2u * 140u * 69u);
  Vec3 low = sphere.points[0], high = low;
  for (const Vec3& point : sphere.points)
  {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  EXPECT_EQ(low, Vec3::Zero());
  EXPECT_EQ(high, Vec3::Ones());
}

TEST(Meshes, SphereAreaConvergesWithSecondOrder)
{
  // An inscribed polyhedron misses an area proportional to h², so half of h gives a quarter of the
  // error.
  const double exact = 4 * Pi;
  const double coarse = exact - SurfaceArea(GeodesicSphere(8));
  const double fine = exact - SurfaceArea(GeodesicSphere(16));
  EXPECT_GT(fine, 0.0);
  EXPECT_NEAR(coarse / fine, 4.0, 0.2); // higher-order terms are a few percent at this h
  const double longitudes = exact - SurfaceArea(LatLongSphere(32, 15, 1.0));
  EXPECT_NEAR(longitudes / (exact - SurfaceArea(LatLongSphere(64, 31, 1.0))), 4.0, 0.2);
}

TEST(Meshes, TorusAreaApproachesTheExactOne)
{
  // The relative error of an inscribed torus is below (π/n)² for the smaller count n per circle.
  const double exact = 4 * Pi * Pi * 2.0 * 0.5;
  EXPECT_NEAR(SurfaceArea(Torus(160, 80, 2.0, 0.5)) / exact, 1.0, std::pow(Pi / 80, 2));
}

TEST(Meshes, TrefoilStrandsNearlyTouchButDoNot)
{
  const int along = 400, around = 24;
  const double radius = 0.8;
  const TriangleMesh knot = TrefoilTube(along, around, radius);
  std::vector<Vec3> center(along, Vec3::Zero());
  for (int i = 0; i < along; ++i)
  {
    for (int j = 0; j < around; ++j)
    {
      center[i] += knot.points[i * around + j] / around;
    }
  }
  // Points at least a quarter of the knot apart along it belong to different strands.
  double nearest = 1e9;
  for (int i = 0; i < along; ++i)
  {
    for (int k = along / 4; k <= 3 * along / 4; ++k)
    {
      nearest = std::min(nearest, (center[i] - center[(i + k) % along]).norm());
    }
  }
  EXPECT_GT(nearest, 2 * radius);
  EXPECT_LT(nearest, 2.1 * radius);
}

TEST(Meshes, SubdivisionKeepsTheSurface)
{
  const TriangleMesh mesh = Pulley(24, 0.1);
  const TriangleMesh fine = SubdivideInPlane(mesh);
  EXPECT_EQ(fine.triangles.size(), 4 * mesh.triangles.size());
  // Sums of a few thousand numbers near 1e-3 round to far less than 1e-12 of their sum.
  EXPECT_NEAR(SurfaceArea(fine), SurfaceArea(mesh), 1e-12 * SurfaceArea(mesh));
  EXPECT_NEAR(EnclosedVolume(fine), EnclosedVolume(mesh), 1e-12);
}

TEST(Meshes, UnweldGivesEveryTriangleItsOwnPoints)
{
  const TriangleMesh mesh = Box(2);
  const TriangleMesh soup = Unweld(mesh);
  EXPECT_EQ(soup.points.size(), 3 * mesh.triangles.size());
  EXPECT_EQ(SurfaceArea(soup), SurfaceArea(mesh));
}

TEST(Meshes, TransformScalesAreaAndVolume)
{
  const TriangleMesh box = Box(2);
  const TriangleMesh moved = Transform(box, Vec3(1, 1, 1), 0.3, 2.0, Vec3(5, 6, 7));
  EXPECT_NEAR(SurfaceArea(moved), 24.0, 1e-12); // rounding of coordinates up to 10
  EXPECT_NEAR(EnclosedVolume(moved), 8.0, 1e-11);
}

TEST(Meshes, RealFilesAreReadAsTheirFolderDescribesThem)
{
  struct FileCase
  {
    const char* name;
    std::size_t points;
    std::size_t triangles;
  };
  // One file of each kind: binary PLY, PLY with colors, ASCII STL, binary STL, OFF.
  for (const FileCase& test : { FileCase{ "rocker_arm.ply", 10044, 20088 },
         FileCase{ "laurana_colour_50k.ply", 27861, 49954 }, FileCase{ "pulley.stl", 8520, 2840 },
         FileCase{ "conrod.stl", 19326, 6442 }, FileCase{ "small/prim.off", 0, 0 } })
  {
    SCOPED_TRACE(test.name);
    const std::string path = RealMesh(test.name);
    if (path.empty())
    {
      GTEST_SKIP() << "no folder of real meshes: set GRIDFEM_DATA_DIR";
    }
    const TriangleMesh mesh = ReadMesh(path);
    Validate(mesh);
    EXPECT_GT(mesh.triangles.size(), 0u);
    if (test.points > 0)
    {
      EXPECT_EQ(mesh.points.size(), test.points);
      EXPECT_EQ(mesh.triangles.size(), test.triangles);
    }
  }
}

TEST(Meshes, UnreadableFilesAreRefused)
{
  EXPECT_THROW(ReadMesh("no such file.ply"), std::runtime_error);
  EXPECT_THROW(ReadMesh("mesh.unknown"), std::runtime_error);
}
