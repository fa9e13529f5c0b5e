#include "RandomMesh.h"

#include "Meshes.h"

#include <limits>
#include <utility>

namespace gridfem::testing
{
namespace
{

using Triangle = std::array<Id, 3>;

void AddTriangle(TriangleMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Id first = static_cast<Id>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), { a, b, c });
  mesh.triangles.push_back({ first, first + 1, first + 2 });
}

TriangleMesh Empty(Choice& choice)
{
  TriangleMesh mesh;
  mesh.points.resize(choice.Integer(0, 3), Vec3::Zero());
  return mesh;
}

TriangleMesh Soup(Choice& choice)
{
  TriangleMesh mesh;
  for (Id k = choice.Integer(1, 15); k > 0; --k)
  {
    const Vec3 a = choice.Vector();
    const Vec3 b = choice.Vector();
    AddTriangle(mesh, a, b, choice.Vector());
  }
  return mesh;
}

TriangleMesh SeparateTriangles(Choice& choice)
{
  TriangleMesh mesh;
  const double size = choice.PowerOfTen(-4.0, 0.0);
  for (Id k = choice.Integer(1, 10); k > 0; --k)
  {
    const Vec3 a = choice.Vector();
    const Vec3 b = a + size * choice.Vector();
    AddTriangle(mesh, a, b, a + size * choice.Vector());
  }
  return mesh;
}

/// Corners are whole numbers, so that many of them coincide or lie on faces and edges of the grid.
TriangleMesh OnLattice(Choice& choice)
{
  TriangleMesh mesh;
  const auto corner = [&]
  {
    const double x = double(choice.Integer(0, 4));
    const double y = double(choice.Integer(0, 4));
    return Vec3(x, y, double(choice.Integer(0, 4)));
  };
  for (Id k = choice.Integer(1, 10); k > 0; --k)
  {
    const Vec3 a = corner();
    const Vec3 b = corner();
    AddTriangle(mesh, a, b, corner());
  }
  return mesh;
}

/// Connects any three of a few points.
TriangleMesh Tangle(Choice& choice)
{
  TriangleMesh mesh;
  for (Id k = choice.Integer(3, 12); k > 0; --k)
  {
    mesh.points.push_back(choice.Vector());
  }
  const Id last = static_cast<Id>(mesh.points.size()) - 1;
  for (Id k = choice.Integer(1, 15); k > 0; --k)
  {
    const Id a = choice.Integer(0, last);
    const Id b = choice.Integer(0, last);
    mesh.triangles.push_back({ a, b, choice.Integer(0, last) });
  }
  return mesh;
}

/// Makes triangles around one edge.
TriangleMesh Fan(Choice& choice)
{
  TriangleMesh mesh;
  mesh.points = { Vec3(0, 0, 0), Vec3(0, 0, 1) };
  for (Id k = choice.Integer(1, 9); k > 0; --k)
  {
    mesh.points.push_back(choice.Vector());
    mesh.triangles.push_back({ 0, 1, static_cast<Id>(mesh.points.size()) - 1 });
  }
  return mesh;
}

TriangleMesh Slivers(Choice& choice)
{
  TriangleMesh mesh;
  const double height = choice.PowerOfTen(-14.0, -1.0);
  for (Id k = choice.Integer(1, 10); k > 0; --k)
  {
    const Vec3 a = choice.Vector();
    const Vec3 b = choice.Vector();
    const double along = choice.Real(-0.5, 1.5);
    AddTriangle(mesh, a, b, a + along * (b - a) + height * choice.Vector());
  }
  return mesh;
}

TriangleMesh Octahedron(double radius, const Vec3& center)
{
  return Transform(GeodesicSphere(1, radius), Vec3(0, 0, 1), 0.0, 1.0, center);
}

/// Makes a chain of octahedra that touch only at corners.
TriangleMesh Octahedra(Choice& choice)
{
  TriangleMesh mesh = Octahedron(1.0, Vec3::Zero());
  Vec3 center = Vec3::Zero();
  for (Id k = choice.Integer(1, 5); k > 0; --k)
  {
    center[choice.Integer(0, 2)] += 2.0;
    mesh = Join(mesh, Octahedron(1.0, center));
  }
  return mesh;
}

/// Makes cubes that share faces, edges, corners, or nothing.
TriangleMesh Cubes(Choice& choice)
{
  TriangleMesh mesh;
  const int parts = static_cast<int>(choice.Integer(1, 2));
  for (Id k = choice.Integer(1, 5); k > 0; --k)
  {
    const double x = double(choice.Integer(0, 2));
    const double y = double(choice.Integer(0, 2));
    const Vec3 low(x, y, double(choice.Integer(0, 2)));
    mesh = Join(mesh, Box(parts, low, low + Vec3::Ones()));
  }
  return mesh;
}

TriangleMesh Sheets(Choice& choice)
{
  return TwoSheets(static_cast<int>(choice.Integer(1, 4)), choice.PowerOfTen(-12.0, 0.0));
}

TriangleMesh Plane(Choice& choice)
{
  const int columns = static_cast<int>(choice.Integer(1, 5));
  return FlatRectangle(
    columns, static_cast<int>(choice.Integer(1, 5)), choice.PowerOfTen(-3.0, 3.0), 1.0);
}

TriangleMesh Sphere(Choice& choice)
{
  return GeodesicSphere(static_cast<int>(choice.Integer(1, 4)));
}

TriangleMesh Ring(Choice& choice)
{
  const int along = static_cast<int>(choice.Integer(3, 12));
  return Torus(along, static_cast<int>(choice.Integer(3, 6)), 1.0, choice.PowerOfTen(-4.0, -0.1));
}

/// Makes a strip that is closed after half a turn.
TriangleMesh MoebiusStrip(Choice& choice)
{
  TriangleMesh mesh;
  const Id count = choice.Integer(3, 12);
  for (Id k = 0; k < count; ++k)
  {
    const double angle = 2.0 * 3.14159265358979 * double(k) / double(count);
    const Vec3 outward(std::cos(angle), std::sin(angle), 0.0);
    const Vec3 across =
      0.3 * (std::cos(0.5 * angle) * outward + std::sin(0.5 * angle) * Vec3(0, 0, 1));
    mesh.points.push_back(outward - across);
    mesh.points.push_back(outward + across);
  }
  for (Id k = 0; k < count; ++k)
  {
    const bool isLast = k + 1 == count;
    const Id low = isLast ? 1 : 2 * k + 2;
    const Id high = isLast ? 0 : 2 * k + 3;
    mesh.triangles.push_back({ 2 * k, low, high });
    mesh.triangles.push_back({ 2 * k, high, 2 * k + 1 });
  }
  return mesh;
}

void Flatten(Choice& choice, TriangleMesh& mesh)
{
  const Id axis = choice.Integer(0, 2);
  const double factor = choice.Of({ 0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3 });
  for (Vec3& point : mesh.points)
  {
    point[axis] *= factor;
  }
}

void Turn(Choice& choice, TriangleMesh& mesh)
{
  const Vec3 axis = choice.Vector();
  mesh = Transform(mesh, axis, choice.Of({ 1e-9, 1e-6, 0.1, 1.0, 2.5 }));
}

void Scale(Choice& choice, TriangleMesh& mesh)
{
  const double factor = choice.OneIn(2) ? choice.Of({ 1e-300, 1e-150, 1e-60, 1e60, 1e150, 1e300 })
                                        : choice.PowerOfTen(-12.0, 12.0);
  for (Vec3& point : mesh.points)
  {
    point *= factor;
  }
}

void Move(Choice& choice, TriangleMesh& mesh)
{
  const Vec3 shift = choice.PowerOfTen(0.0, 16.0) * choice.Vector();
  for (Vec3& point : mesh.points)
  {
    point += shift;
  }
}

/// Repeats some triangles, as they are or turned over.
void Repeat(Choice& choice, TriangleMesh& mesh)
{
  const Id last = static_cast<Id>(mesh.triangles.size()) - 1;
  for (Id k = choice.Integer(1, last + 1); k > 0; --k)
  {
    Triangle triangle = mesh.triangles[choice.Integer(0, last)];
    if (choice.OneIn(2))
    {
      std::swap(triangle[0], triangle[1]);
    }
    mesh.triangles.push_back(triangle);
  }
}

/// Repeats the whole mesh at a tiny distance.
void Double(Choice& choice, TriangleMesh& mesh)
{
  const Vec3 shift = choice.PowerOfTen(-16.0, -2.0) * choice.Vector();
  mesh = Join(mesh, Transform(mesh, Vec3(0, 0, 1), 0.0, 1.0, shift));
}

void TurnOver(Choice& choice, TriangleMesh& mesh)
{
  for (Triangle& triangle : mesh.triangles)
  {
    if (choice.OneIn(3))
    {
      std::swap(triangle[0], triangle[1]);
    }
  }
}

/// Adds triangles with two or three corners at one point.
void AddWithoutArea(Choice& choice, TriangleMesh& mesh)
{
  const Id last = static_cast<Id>(mesh.points.size()) - 1;
  for (Id k = choice.Integer(1, 4); k > 0; --k)
  {
    const Id a = choice.Integer(0, last);
    mesh.triangles.push_back({ a, a, choice.Integer(0, last) });
  }
}

/// Adds points that no triangle uses, or that coincide with others.
void AddPoints(Choice& choice, TriangleMesh& mesh)
{
  const Id last = static_cast<Id>(mesh.points.size()) - 1;
  for (Id k = choice.Integer(1, 4); k > 0; --k)
  {
    mesh.points.push_back(
      choice.OneIn(2) ? 100.0 * choice.Vector() : mesh.points[choice.Integer(0, last)]);
  }
}

void Jitter(Choice& choice, TriangleMesh& mesh)
{
  const double size = choice.PowerOfTen(-16.0, -1.0);
  for (Vec3& point : mesh.points)
  {
    point += size * choice.Vector();
  }
}

void Split(Choice&, TriangleMesh& mesh)
{
  mesh = Unweld(mesh);
}

void Break(Choice& choice, TriangleMesh& mesh)
{
  constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  const Id last = static_cast<Id>(mesh.points.size()) - 1;
  if (choice.OneIn(3))
  {
    mesh.triangles[choice.Integer(0, static_cast<Id>(mesh.triangles.size()) - 1)][1] =
      choice.Of<Id>({ -1, last + 1, std::numeric_limits<Id>::max() });
    return;
  }
  mesh.points[choice.Integer(0, last)][choice.Integer(0, 2)] =
    choice.Of({ NaN, Infinity, -Infinity });
}

struct Maker
{
  const char* name;
  TriangleMesh (*make)(Choice&);
};

constexpr Maker Makers[] = { { "empty", Empty }, { "soup", Soup }, { "soup", Soup },
  { "separate triangles", SeparateTriangles }, { "on a lattice", OnLattice }, { "tangle", Tangle },
  { "fan", Fan }, { "slivers", Slivers }, { "octahedra", Octahedra }, { "cubes", Cubes },
  { "sheets", Sheets }, { "plane", Plane }, { "sphere", Sphere }, { "ring", Ring },
  { "Moebius strip", MoebiusStrip } };

struct Change
{
  const char* name;
  void (*apply)(Choice&, TriangleMesh&);
  Id rarity; // applied to one in this many meshes
};

constexpr Change Changes[] = { { "flattened", Flatten, 8 }, { "jittered", Jitter, 10 },
  { "repeated", Repeat, 10 }, { "doubled", Double, 15 }, { "turned over", TurnOver, 10 },
  { "without area", AddWithoutArea, 10 }, { "split", Split, 10 }, { "more points", AddPoints, 10 },
  { "turned", Turn, 6 }, { "moved", Move, 15 }, { "scaled", Scale, 15 }, { "broken", Break, 60 } };

} // namespace

RandomMesh MakeRandomMesh(Choice& choice)
{
  const Maker& maker = Makers[choice.Integer(0, std::size(Makers) - 1)];
  RandomMesh result{ maker.name, maker.make(choice) };
  if (result.mesh.triangles.empty())
  {
    return result;
  }
  for (const Change& change : Changes)
  {
    if (choice.OneIn(change.rarity))
    {
      change.apply(choice, result.mesh);
      result.name += std::string(", ") + change.name;
    }
  }
  return result;
}

} // namespace gridfem::testing
