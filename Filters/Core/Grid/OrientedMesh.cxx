#include "Grid/OrientedMesh.h"

#include "Base/Errors.h"
#include "Base/Grouping.h"
#include "Grid/CopiedTriangles.h"
#include "Grid/CornerClasses.h"
#include "Grid/SurfaceEdges.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace gridfem
{
namespace
{

/// Whether no two triangles run along an edge in the same direction.
bool FaceAlike(const TriangleMesh& mesh, const CornerClasses& classes, int threads)
{
  const auto triangles = static_cast<Id>(mesh.triangles.size());
  RequireIndices(3.0 * static_cast<double>(triangles), "sides of triangles");
  Array<Index> from(3 * triangles); // of side k of triangle t: 3 t + k
  ParallelRanges(triangles, threads,
    [&](Id begin, Id end)
    {
      for (Id t = begin; t < end; ++t)
      {
        const std::array<Index, 3> corners = classes(t);
        std::copy(corners.begin(), corners.end(), from.begin() + 3 * t);
      }
    });
  const Groups sides = GroupItems(from, static_cast<Id>(mesh.points.size()), threads);
  const auto endOf = [&](Index side) { return from[side - side % 3 + (side + 1) % 3]; };
  const auto isDegenerate = [&](Index side)
  {
    const Index* const corners = &from[side - side % 3];
    return IsDegenerate({ corners[0], corners[1], corners[2] });
  };
  return ParallelSum(static_cast<Id>(mesh.points.size()), threads, Id{ 0 },
           [&](Id begin, Id end)
           {
             Id pointsWithTwo = 0; // with two sides to the same other point
             std::vector<Index> ends;
             for (Id point = begin; point < end; ++point)
             {
               ends.clear();
               for (Index k = sides.begin[point]; k < sides.begin[point + 1]; ++k)
               {
                 if (!isDegenerate(sides.item[k]))
                 {
                   ends.push_back(endOf(sides.item[k]));
                 }
               }
               std::sort(ends.begin(), ends.end());
               const bool hasTwo = std::adjacent_find(ends.begin(), ends.end()) != ends.end();
               pointsWithTwo += hasTwo ? 1 : 0;
             }
             return pointsWithTwo;
           }) == 0;
}

/// Returns the mesh with the first of all triangles that have the same corners.
TriangleMesh WithoutCopies(const TriangleMesh& mesh, const Array<Index>& pointClass, int threads)
{
  const std::vector<char> isCopy = CopiedTriangles(mesh, pointClass, threads);
  TriangleMesh kept = mesh;
  if (!isCopy.empty())
  {
    std::vector<Id> numbers(mesh.triangles.size());
    KeepTriangles(kept, numbers, [&](std::size_t triangle) { return !isCopy[triangle]; });
  }
  return kept;
}

/// @param without  the mesh without copies
std::vector<Id> PointsWithTriangle(
  const TriangleMesh& mesh, const TriangleMesh& without, const Array<Index>& pointClass)
{
  const std::vector<char> had = UsedPoints(mesh);
  const std::vector<char> used = UsedPoints(without);
  std::vector<Id> ofClass(mesh.points.size(), -1);
  for (std::size_t point = 0; point < pointClass.size(); ++point)
  {
    if (used[point])
    {
      ofClass[pointClass[point]] = static_cast<Id>(point);
    }
  }
  std::vector<Id> points(mesh.points.size());
  for (std::size_t point = 0; point < points.size(); ++point)
  {
    const bool lostAll = had[point] && !used[point] && !pointClass.empty();
    const Id other = lostAll ? ofClass[pointClass[point]] : -1;
    points[point] = other < 0 ? static_cast<Id>(point) : other;
  }
  return points;
}

} // namespace

OrientedMesh Orient(const TriangleMesh& mesh, bool weldCoincidentPoints, int threads)
{
  OrientedMesh oriented;
  const Array<Index> pointClass =
    weldCoincidentPoints ? WeldCoincidentPoints(mesh.points, {}, threads) : Array<Index>();
  if (FaceAlike(mesh, { mesh, pointClass }, threads))
  {
    return oriented;
  }
  TriangleMesh turned = WithoutCopies(mesh, pointClass, threads);
  oriented.copies = static_cast<Id>(mesh.triangles.size() - turned.triangles.size());
  if (oriented.copies > 0)
  {
    oriented.pointWithTriangle = PointsWithTriangle(mesh, turned, pointClass);
  }
  const SurfaceEdges edges = FindSurfaceEdges(turned, weldCoincidentPoints, threads);
  oriented.oneSided = edges.numberOfOneSided;
  for (std::size_t t = 0; t < turned.triangles.size(); ++t)
  {
    if (edges.side[t] < 0)
    {
      std::swap(turned.triangles[t][1], turned.triangles[t][2]);
      ++oriented.turned;
    }
  }
  oriented.mesh = std::move(turned);
  return oriented;
}

} // namespace gridfem
