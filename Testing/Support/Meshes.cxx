#include "Meshes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <utility>

namespace gridfem::testing
{

namespace
{

constexpr double Pi = 3.14159265358979323846;

/// Points of an integer lattice. A point gets its id when it is first requested.
class LatticePoints
{
public:
  Id At(const std::array<int, 3>& lattice)
  {
    return ids_.emplace(lattice, static_cast<Id>(ids_.size())).first->second;
  }

  template<class Place>
  std::vector<Vec3> Positions(Place&& place) const
  {
    std::vector<Vec3> points(ids_.size());
    for (const auto& [lattice, id] : ids_)
    {
      points[id] = place(Vec3(lattice[0], lattice[1], lattice[2]));
    }
    return points;
  }

private:
  std::map<std::array<int, 3>, Id> ids_;
};

void AddQuad(TriangleMesh& mesh, Id a, Id b, Id c, Id d)
{
  mesh.triangles.push_back({ a, b, c });
  mesh.triangles.push_back({ a, c, d });
}

/// Connects the points i * m + j, 0 <= i < n, 0 <= j < m, to a torus of quads. i x j points
/// outward.
void ConnectClosedGrid(TriangleMesh& mesh, int n, int m)
{
  const auto at = [=](int i, int j) { return static_cast<Id>(i % n) * m + j % m; };
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < m; ++j)
    {
      AddQuad(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
}

/// Turns a closed profile around z. Its points are (distance from the axis, z), counterclockwise.
TriangleMesh Revolve(const std::vector<std::pair<double, double>>& profile, int around)
{
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i)
  {
    const double angle = 2 * Pi * i / around;
    for (const auto& [radius, z] : profile)
    {
      mesh.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  ConnectClosedGrid(mesh, around, static_cast<int>(profile.size()));
  return mesh;
}

} // namespace

TriangleMesh LatLongSphere(int longitudes, int latitudes, double radius, const Vec3& center)
{
  TriangleMesh mesh;
  for (int j = 1; j <= latitudes; ++j)
  {
    const double theta = Pi * j / (latitudes + 1);
    for (int i = 0; i < longitudes; ++i)
    {
      const double phi = 2 * Pi * i / longitudes;
      mesh.points.push_back(center + radius * Vec3(std::sin(theta) * std::cos(phi),
                                                std::sin(theta) * std::sin(phi), std::cos(theta)));
    }
  }
  const Id north = static_cast<Id>(mesh.points.size());
  const Id south = north + 1;
  mesh.points.push_back(center + Vec3(0, 0, radius));
  mesh.points.push_back(center - Vec3(0, 0, radius));

  const auto at = [=](int ring, int i)
  { return static_cast<Id>(ring) * longitudes + i % longitudes; };
  for (int i = 0; i < longitudes; ++i)
  {
    mesh.triangles.push_back({ north, at(0, i), at(0, i + 1) });
    for (int ring = 0; ring + 1 < latitudes; ++ring)
    {
      AddQuad(mesh, at(ring, i), at(ring + 1, i), at(ring + 1, i + 1), at(ring, i + 1));
    }
    mesh.triangles.push_back({ at(latitudes - 1, i), south, at(latitudes - 1, i + 1) });
  }
  return mesh;
}

TriangleMesh GeodesicSphere(int subdivisions, double radius)
{
  // The subdivided octahedron is the set of lattice points with |x| + |y| + |z| = subdivisions.
  TriangleMesh mesh;
  LatticePoints lattice;
  for (int octant = 0; octant < 8; ++octant)
  {
    const std::array<int, 3> sign = { octant & 1 ? -1 : 1, octant & 2 ? -1 : 1,
      octant & 4 ? -1 : 1 };
    const bool isMirrored = sign[0] * sign[1] * sign[2] < 0;
    const auto at = [&](int i, int j) {
      return lattice.At({ sign[0] * i, sign[1] * j, sign[2] * (subdivisions - i - j) });
    };
    const auto add = [&](Id a, Id b, Id c)
    {
      if (isMirrored)
      {
        std::swap(b, c);
      }
      mesh.triangles.push_back({ a, b, c });
    };
    for (int i = 0; i < subdivisions; ++i)
    {
      for (int j = 0; i + j < subdivisions; ++j)
      {
        add(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 1 < subdivisions)
        {
          add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
      }
    }
  }
  mesh.points = lattice.Positions([&](const Vec3& p) -> Vec3 { return radius * p.normalized(); });
  return mesh;
}

TriangleMesh Box(int n, const Vec3& low, const Vec3& high)
{
  TriangleMesh mesh;
  LatticePoints lattice;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const int side : { 0, n })
    {
      // (u, v) is chosen so that u x v points out of the box on both sides.
      const int u = side == 0 ? (axis + 2) % 3 : (axis + 1) % 3;
      const int v = side == 0 ? (axis + 1) % 3 : (axis + 2) % 3;
      const auto at = [&](int i, int j)
      {
        std::array<int, 3> p;
        p[axis] = side;
        p[u] = i;
        p[v] = j;
        return lattice.At(p);
      };
      for (int i = 0; i < n; ++i)
      {
        for (int j = 0; j < n; ++j)
        {
          AddQuad(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
      }
    }
  }
  // Written so that the ends are exactly low and high.
  mesh.points = lattice.Positions([&](const Vec3& p) -> Vec3
    { return (low.array() * (n - p.array()) + high.array() * p.array()) / n; });
  return mesh;
}

TriangleMesh FlatRectangle(int nx, int ny, double width, double height)
{
  TriangleMesh mesh;
  for (int j = 0; j <= ny; ++j)
  {
    for (int i = 0; i <= nx; ++i)
    {
      mesh.points.emplace_back(width * i / nx, height * j / ny, 0.0);
    }
  }
  const auto at = [=](int i, int j) { return static_cast<Id>(j) * (nx + 1) + i; };
  for (int j = 0; j < ny; ++j)
  {
    for (int i = 0; i < nx; ++i)
    {
      AddQuad(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return mesh;
}

TriangleMesh Disk(int fineness)
{
  return Mapped(FlatRectangle(fineness, fineness, 2.0, 2.0),
    [](const Vec3& p)
    {
      const Vec3 q = p - Vec3(1.0, 1.0, 0.0);
      const double ring = std::max(std::abs(q[0]), std::abs(q[1]));
      return q.norm() > 0.0 ? Vec3(ring / q.norm() * q) : q;
    });
}

TriangleMesh Halves(int left, int right)
{
  return Join(FlatRectangle(left / 2, left, 0.5, 1.0),
    Transform(FlatRectangle(right / 2, right, 0.5, 1.0), Vec3::UnitX(), 0.0, 1.0, { 0.5, 0, 0 }));
}

TriangleMesh TrefoilTube(int along, int around, double tubeRadius)
{
  // The knot lies on a torus of radii 2 and 1. The normal of the torus, and its cross product with
  // the tangent, form a frame that closes up.
  TriangleMesh mesh;
  for (int i = 0; i < along; ++i)
  {
    const double t = 2 * Pi * i / along;
    const double c2 = std::cos(2 * t), s2 = std::sin(2 * t);
    const double c3 = std::cos(3 * t), s3 = std::sin(3 * t);
    const Vec3 center((2 + c3) * c2, (2 + c3) * s2, s3);
    const Vec3 tangent(-3 * s3 * c2 - 2 * (2 + c3) * s2, -3 * s3 * s2 + 2 * (2 + c3) * c2, 3 * c3);
    const Vec3 normal(c3 * c2, c3 * s2, s3);
    const Vec3 side = normal.cross(tangent).normalized();
    for (int j = 0; j < around; ++j)
    {
      const double angle = 2 * Pi * j / around;
      mesh.points.push_back(
        center + tubeRadius * (std::cos(angle) * normal + std::sin(angle) * side));
    }
  }
  ConnectClosedGrid(mesh, along, around);
  return mesh;
}

TriangleMesh Torus(int along, int around, double radius, double tubeRadius)
{
  std::vector<std::pair<double, double>> profile;
  for (int j = 0; j < around; ++j)
  {
    const double angle = 2 * Pi * j / around;
    profile.emplace_back(radius + tubeRadius * std::cos(angle), tubeRadius * std::sin(angle));
  }
  return Revolve(profile, along);
}

TriangleMesh CubeArray(int counts, int facesPerEdge, double gap)
{
  TriangleMesh mesh;
  for (int k = 0; k < counts; ++k)
  {
    for (int j = 0; j < counts; ++j)
    {
      for (int i = 0; i < counts; ++i)
      {
        const Vec3 low = (1 + gap) * Vec3(i, j, k);
        mesh = Join(mesh, Box(facesPerEdge, low, low + Vec3::Ones()));
      }
    }
  }
  return mesh;
}

TriangleMesh TwoSheets(int n, double gap)
{
  const TriangleMesh sheet = FlatRectangle(n, n);
  return Join(sheet, Transform(sheet, Vec3::UnitZ(), 0.0, 1.0, Vec3(0, 0, gap)));
}

TriangleMesh Pulley(int around, double wallThickness)
{
  const double w = wallThickness;
  // Upper half of the section, from the bore outward: hub, web, flange, groove.
  const std::vector<std::pair<double, double>> upper = { { 0.15, 0.25 }, { 0.15 + w, 0.25 },
    { 0.15 + w, w / 2 }, { 0.6, w / 2 }, { 1.0, 0.25 + w / 2 }, { 1.0, 0.25 - w / 2 } };
  std::vector<std::pair<double, double>> corners;
  for (const auto& [radius, z] : upper)
  {
    corners.emplace_back(radius, -z);
  }
  corners.emplace_back(0.6 + w, 0.0);
  corners.insert(corners.end(), upper.rbegin(), upper.rend());

  std::vector<std::pair<double, double>> profile;
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const auto& [r0, z0] = corners[k];
    const auto& [r1, z1] = corners[(k + 1) % corners.size()];
    const double length = std::hypot(r1 - r0, z1 - z0);
    const int parts = static_cast<int>(std::ceil(length * around / (2 * Pi)));
    for (int part = 0; part < parts; ++part)
    {
      const double s = double(part) / parts;
      profile.emplace_back(r0 + s * (r1 - r0), z0 + s * (z1 - z0));
    }
  }
  return Revolve(profile, around);
}

TriangleMesh Mapped(TriangleMesh mesh, const std::function<Vec3(const Vec3&)>& map)
{
  std::transform(mesh.points.begin(), mesh.points.end(), mesh.points.begin(), map);
  return mesh;
}

Vec3 Bend(const Vec3& p)
{
  return p + Vec3(0.3 * p[1] * p[2], 0.2 * std::sin(2.0 * p[0]), -0.25 * p[0] * p[1]);
}

std::vector<Id> EveryPoint(const TriangleMesh& mesh, Id step)
{
  std::vector<Id> points;
  for (Id point = 0; point < static_cast<Id>(mesh.points.size()); point += step)
  {
    points.push_back(point);
  }
  return points;
}

TriangleMesh SubdivideInPlane(const TriangleMesh& mesh)
{
  TriangleMesh result;
  result.points = mesh.points;
  std::map<std::pair<Id, Id>, Id> midpoints;
  const auto midpoint = [&](Id a, Id b)
  {
    const auto [entry, isNew] = midpoints.emplace(std::minmax(a, b), result.points.size());
    if (isNew)
    {
      result.points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
    }
    return entry->second;
  };
  for (const auto& [a, b, c] : mesh.triangles)
  {
    const Id ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
    result.triangles.push_back({ a, ab, ca });
    result.triangles.push_back({ ab, b, bc });
    result.triangles.push_back({ ca, bc, c });
    result.triangles.push_back({ ab, bc, ca });
  }
  return result;
}

TriangleMesh Unweld(const TriangleMesh& mesh)
{
  TriangleMesh soup;
  for (const auto& triangle : mesh.triangles)
  {
    const Id first = static_cast<Id>(soup.points.size());
    for (const Id corner : triangle)
    {
      soup.points.push_back(mesh.points[corner]);
    }
    soup.triangles.push_back({ first, first + 1, first + 2 });
  }
  return soup;
}

TriangleMesh TurnSome(TriangleMesh mesh, double part, unsigned seed)
{
  std::mt19937 random(seed);
  std::bernoulli_distribution isTurned(part);
  for (auto& triangle : mesh.triangles)
  {
    if (isTurned(random))
    {
      std::reverse(triangle.begin(), triangle.end());
    }
  }
  return mesh;
}

TriangleMesh Transform(
  const TriangleMesh& mesh, const Vec3& axis, double angle, double scale, const Vec3& shift)
{
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  TriangleMesh result = mesh;
  for (Vec3& point : result.points)
  {
    point = scale * (rotation * point) + shift;
  }
  return result;
}

TriangleMesh Join(const TriangleMesh& a, const TriangleMesh& b)
{
  TriangleMesh joined = a;
  const Id offset = static_cast<Id>(a.points.size());
  joined.points.insert(joined.points.end(), b.points.begin(), b.points.end());
  for (const auto& [p, q, r] : b.triangles)
  {
    joined.triangles.push_back({ p + offset, q + offset, r + offset });
  }
  return joined;
}

} // namespace gridfem::testing
