#include "IndependentSets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace gridfem::benchmarks
{

namespace
{

constexpr int MostNeighbors = 12;
constexpr double Pi = 3.14159265358979323846;

using Vec2 = Eigen::Vector2d;
using Entries = std::vector<Eigen::Triplet<double>>;

double Cross(const Vec2& a, const Vec2& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

/// A mesh whose triangles come and go; `around` may name triangles that are gone.
struct ChangingMesh
{
  std::vector<Vec3> points;
  std::vector<std::array<Id, 3>> triangles; // corner -1: gone
  std::vector<std::vector<Id>> around;      // triangles of each vertex

  explicit ChangingMesh(const TriangleMesh& mesh)
    : points(mesh.points), triangles(mesh.triangles), around(mesh.points.size())
  {
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
      this->Register(static_cast<Id>(t));
    }
  }

  void Register(Id triangle)
  {
    for (const Id corner : triangles[triangle])
    {
      around[corner].push_back(triangle);
    }
  }

  bool AreNeighbors(Id a, Id b) const
  {
    return std::any_of(around[a].begin(), around[a].end(),
      [&](Id t) { return std::count(triangles[t].begin(), triangles[t].end(), b) > 0; });
  }

  /// Neighbors in order around a vertex; empty unless they form one closed ring.
  std::vector<Id> Ring(Id vertex) const
  {
    std::vector<std::pair<Id, Id>> edges; // opposite to the vertex
    for (const Id t : around[vertex])
    {
      const auto& corners = triangles[t];
      for (int c = 0; c < 3 && corners[0] >= 0; ++c)
      {
        if (corners[c] == vertex)
        {
          edges.emplace_back(corners[(c + 1) % 3], corners[(c + 2) % 3]);
        }
      }
    }
    std::vector<Id> ring;
    Id next = edges.empty() ? -1 : edges.front().first;
    while (ring.size() < edges.size())
    {
      const auto leaving = std::find_if(
        edges.begin(), edges.end(), [&](const auto& edge) { return edge.first == next; });
      if (leaving == edges.end() || std::count(ring.begin(), ring.end(), next) > 0)
      {
        return {};
      }
      ring.push_back(next);
      next = leaving->second;
    }
    const bool closed = ring.size() >= 3 && next == ring.front();
    return closed && ring.size() <= MostNeighbors ? ring : std::vector<Id>();
  }
};

/// The ring around the vertex, laid into the plane.
std::vector<Vec2> Flatten(const ChangingMesh& mesh, Id vertex, const std::vector<Id>& ring)
{
  std::vector<double> angle{ 0.0 };
  for (std::size_t k = 0; k < ring.size(); ++k)
  {
    const Vec3 a = mesh.points[ring[k]] - mesh.points[vertex];
    const Vec3 b = mesh.points[ring[(k + 1) % ring.size()]] - mesh.points[vertex];
    angle.push_back(angle.back() + std::atan2(a.cross(b).norm(), a.dot(b)));
  }
  std::vector<Vec2> plane;
  for (std::size_t k = 0; k < ring.size(); ++k)
  {
    const double turned = angle[k] * 2.0 * Pi / angle.back();
    plane.push_back((mesh.points[ring[k]] - mesh.points[vertex]).norm() *
                    Vec2(std::cos(turned), std::sin(turned)));
  }
  return plane;
}

/// The fan that fills a hole, and where the removed vertex lies in it.
struct Fan
{
  std::size_t apex; // all as places in the ring
  std::array<std::size_t, 3> triangle;
  std::array<double, 3> weight;
};

/// The fan from one vertex of the ring, when no triangle of it is folded over.
std::optional<Fan> TryFan(const std::vector<Vec2>& plane, std::size_t apex)
{
  Fan fan{ apex, {}, {} };
  const std::size_t n = plane.size();
  double best = -1.0;
  for (std::size_t k = 1; k + 1 < n; ++k)
  {
    const std::array<std::size_t, 3> corner{ apex, (apex + k) % n, (apex + k + 1) % n };
    const std::array<Vec2, 3> p{ plane[corner[0]], plane[corner[1]], plane[corner[2]] };
    const double area = Cross(p[1] - p[0], p[2] - p[0]);
    if (!(area > 1e-6 * (p[1] - p[0]).norm() * (p[2] - p[0]).norm()))
    {
      return std::nullopt;
    }
    const std::array<double, 3> weight{ Cross(p[1], p[2]) / area, Cross(p[2], p[0]) / area,
      Cross(p[0], p[1]) / area };
    const double inside = *std::min_element(weight.begin(), weight.end());
    if (inside > best)
    {
      best = inside;
      fan.triangle = corner;
      fan.weight = weight;
    }
  }
  return best >= -1e-9 ? std::optional<Fan>(fan) : std::nullopt;
}

/// The fan from the nearest neighbor that makes a mesh again: its new edges must not exist yet.
std::optional<Fan> FindFan(const ChangingMesh& mesh, Id vertex, const std::vector<Id>& ring)
{
  const std::vector<Vec2> plane = Flatten(mesh, vertex, ring);
  std::vector<std::size_t> order(ring.size());
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    order[k] = k;
  }
  std::sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return plane[a].norm() < plane[b].norm(); });
  const std::size_t n = ring.size();
  for (const std::size_t apex : order)
  {
    bool isNew = true;
    for (std::size_t k = 2; k + 1 < n && isNew; ++k)
    {
      isNew = !mesh.AreNeighbors(ring[apex], ring[(apex + k) % n]);
    }
    const std::optional<Fan> fan = isNew ? TryFan(plane, apex) : std::nullopt;
    if (fan)
    {
      return fan;
    }
  }
  return std::nullopt;
}

void Remove(ChangingMesh& mesh, Id vertex, const std::vector<Id>& ring, const Fan& fan)
{
  for (const Id t : mesh.around[vertex])
  {
    mesh.triangles[t] = { -1, -1, -1 };
  }
  const std::size_t n = ring.size();
  for (std::size_t k = 1; k + 1 < n; ++k)
  {
    mesh.triangles.push_back(
      { ring[fan.apex], ring[(fan.apex + k) % n], ring[(fan.apex + k + 1) % n] });
    mesh.Register(static_cast<Id>(mesh.triangles.size()) - 1);
  }
}

/// The vertices and triangles that are left, renumbered.
TriangleMesh Compact(const ChangingMesh& mesh, const std::vector<Id>& number)
{
  TriangleMesh result;
  for (std::size_t v = 0; v < number.size(); ++v)
  {
    if (number[v] >= 0)
    {
      result.points.push_back(mesh.points[v]);
    }
  }
  for (const auto& corners : mesh.triangles)
  {
    if (corners[0] >= 0)
    {
      result.triangles.push_back({ number[corners[0]], number[corners[1]], number[corners[2]] });
    }
  }
  return result;
}

/// Makes one level: replaces the mesh by the remaining mesh.
Prolongation RemoveOneSet(TriangleMesh& mesh)
{
  ChangingMesh changing(mesh);
  const std::size_t vertices = mesh.points.size();
  std::vector<char> stays(vertices, 0);
  Entries entries; // columns still name vertices of the finer level
  std::vector<Id> number(vertices, 0);
  for (std::size_t v = 0; v < vertices; ++v)
  {
    const std::vector<Id> ring = stays[v] ? std::vector<Id>() : changing.Ring(v);
    const std::optional<Fan> fan =
      ring.empty() ? std::nullopt : FindFan(changing, static_cast<Id>(v), ring);
    if (!fan)
    {
      entries.emplace_back(v, v, 1.0);
      continue;
    }
    for (int c = 0; c < 3; ++c)
    {
      entries.emplace_back(v, ring[fan->triangle[c]], fan->weight[c]);
    }
    number[v] = -1;
    for (const Id neighbor : ring)
    {
      stays[neighbor] = 1;
    }
    Remove(changing, static_cast<Id>(v), ring, *fan);
  }
  Id left = 0;
  for (Id& n : number)
  {
    n = n < 0 ? n : left++;
  }
  for (Eigen::Triplet<double>& entry : entries)
  {
    entry = { entry.row(), static_cast<int>(number[entry.col()]), entry.value() };
  }
  Prolongation prolongation(static_cast<Eigen::Index>(vertices), left);
  prolongation.setFromTriplets(entries.begin(), entries.end());
  mesh = Compact(changing, number);
  return prolongation;
}

} // namespace

std::vector<Prolongation> RemoveIndependentSets(const TriangleMesh& mesh, int smallest)
{
  std::vector<Prolongation> prolongations;
  TriangleMesh level = mesh;
  while (level.points.size() > static_cast<std::size_t>(smallest))
  {
    prolongations.push_back(RemoveOneSet(level));
    if (prolongations.back().cols() > 0.95 * static_cast<double>(prolongations.back().rows()))
    {
      break;
    }
  }
  return prolongations;
}

std::vector<Prolongation> Compose(const std::vector<Prolongation>& prolongations)
{
  std::vector<Prolongation> result;
  for (const Prolongation& next : prolongations)
  {
    if (result.empty() || 4 * result.back().cols() <= result.back().rows())
    {
      result.push_back(next);
    }
    else
    {
      result.back() = Prolongation(result.back() * next);
    }
  }
  return result;
}

} // namespace gridfem::benchmarks
