#include "TriangleMesh.h"

#include "Errors.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <string>

namespace gridfem
{

void Validate(const TriangleMesh& mesh)
{
  const Id numberOfPoints = static_cast<Id>(mesh.points.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (const Id corner : mesh.triangles[t])
    {
      if (corner < 0 || corner >= numberOfPoints)
      {
        throw InvalidInput("Triangle " + std::to_string(t) + " uses point " +
                           std::to_string(corner) + ", but there are " +
                           std::to_string(numberOfPoints) + " points.");
      }
      if (!mesh.points[corner].allFinite())
      {
        throw InvalidInput(
          "Point " + std::to_string(corner) +
          " has a coordinate that is not a finite number. Remove it or clean the mesh first.");
      }
    }
  }
}

namespace
{

bool LexicographicLess(const Vec3& a, const Vec3& b)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (a[axis] != b[axis])
    {
      return a[axis] < b[axis];
    }
  }
  return false;
}

} // namespace

std::vector<Id> WeldCoincidentPoints(const std::vector<Vec3>& points, const std::vector<char>& used)
{
  std::vector<Id> representative(points.size());
  std::iota(representative.begin(), representative.end(), Id{ 0 });
  std::vector<Id> order;
  order.reserve(points.size());
  std::copy_if(representative.begin(), representative.end(), std::back_inserter(order),
    [&](Id point) { return used.empty() || used[point]; });
  std::sort(order.begin(), order.end(),
    [&](Id a, Id b)
    {
      if (LexicographicLess(points[a], points[b]))
      {
        return true;
      }
      return !LexicographicLess(points[b], points[a]) && a < b;
    });
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    const bool same = k > 0 && points[order[k]] == points[order[k - 1]];
    representative[order[k]] = same ? representative[order[k - 1]] : order[k];
  }
  return representative;
}

std::vector<char> UsedPoints(const TriangleMesh& mesh)
{
  std::vector<char> used(mesh.points.size(), 0);
  for (const auto& triangle : mesh.triangles)
  {
    for (const Id corner : triangle)
    {
      used[corner] = 1;
    }
  }
  return used;
}

double SurfaceArea(const TriangleMesh& mesh)
{
  double area = 0.0;
  for (const auto& t : mesh.triangles)
  {
    const Vec3& a = mesh.points[t[0]];
    area += 0.5 * (mesh.points[t[1]] - a).cross(mesh.points[t[2]] - a).norm();
  }
  return area;
}

} // namespace gridfem
