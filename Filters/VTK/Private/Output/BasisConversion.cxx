#include "Output/BasisConversion.h"

#include "Base/Errors.h"
#include "Grid/SegmentTree.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace gridfem
{
namespace
{

/// Returns the largest distance, in cells, of a clipped triangle's center from its source triangle.
/// Cut points may have been stored in single precision.
double SameTriangle(const Grid& grid, const Vec3& center)
{
  constexpr double Largest = 0.05; // rounding of a surface far from the origin
  const double size = grid.ToWorld(center).cwiseAbs().maxCoeff() / grid.spacing;
  return std::min(Largest, 1e-6 + 4.0 * std::numeric_limits<float>::epsilon() * size);
}

[[noreturn]] void RefuseForeignBasis(const std::string& reason)
{
  throw InvalidInput(
    "The basis was made from another mesh: " + reason +
    " Connect the mesh that went into the basis filter, or the output of the basis filter itself.");
}

/// Returns the corners of the clipped triangles: the fan of every piece. The points are exactly the
/// points that the basis filter outputs in double precision.
TriangleMesh FanTriangles(const SurfaceBasis& basis)
{
  const ClippedMesh& clipped = basis.space->clipped;
  TriangleMesh mesh;
  mesh.points = basis.mesh->points;
  mesh.points.reserve(clipped.position.size());
  for (std::size_t point = mesh.points.size(); point < clipped.position.size(); ++point)
  {
    mesh.points.push_back(clipped.grid.ToWorld(clipped.position[point]));
  }
  mesh.triangles.reserve(clipped.NumberOfTriangles());
  for (Id piece = 0; piece < clipped.NumberOfPieces(); ++piece)
  {
    const Id first = clipped.pieceBegin[piece];
    for (Id k = first + 1; k + 1 < clipped.pieceBegin[piece + 1]; ++k)
    {
      mesh.triangles.push_back(
        { clipped.corners[first], clipped.corners[k], clipped.corners[k + 1] });
    }
  }
  return mesh;
}

/// Replaces the pieces by clipped triangles.
void SplitPieces(const TriangleMesh& mesh, GridFunctions& space)
{
  ClippedMesh& clipped = space.clipped;
  const Id count = static_cast<Id>(mesh.triangles.size());
  Array<Index> patch;
  patch.reserve(count);
  for (Id piece = 0; piece < clipped.NumberOfPieces(); ++piece)
  {
    const Id triangles = clipped.pieceBegin[piece + 1] - clipped.pieceBegin[piece] - 2;
    patch.insert(patch.end(), triangles, space.piecePatch[piece]);
  }
  for (Index& begin : clipped.cellBegin)
  {
    begin = static_cast<Index>(clipped.FirstTriangle(begin));
  }
  space.piecePatch = std::move(patch);
  clipped.pieceTriangle.resize(count);
  clipped.pieceBegin.resize(count + 1);
  clipped.corners.resize(3 * count);
  for (Id t = 0; t < count; ++t)
  {
    clipped.pieceTriangle[t] = static_cast<Index>(t);
    clipped.pieceBegin[t + 1] = static_cast<Index>(3 * (t + 1));
    for (int k = 0; k < 3; ++k)
    {
      clipped.corners[3 * t + k] = static_cast<Index>(mesh.triangles[t][k]);
    }
  }
  clipped.pieceBegin[0] = 0;
  clipped.links.clear(); // the levels are built already
}

/// Returns the barycentric coordinates of the point of the triangle's plane nearest to `position`.
/// A triangle without area gives its centroid.
std::array<double, 3> Barycentric(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& position)
{
  const Vec3 normal = (b - a).cross(c - a);
  const double square = normal.squaredNorm();
  if (!(square > 0.0))
  {
    return { 1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0 };
  }
  const double wb = (position - a).cross(c - a).dot(normal) / square;
  const double wc = (b - a).cross(position - a).dot(normal) / square;
  return { 1.0 - wb - wc, wb, wc };
}

std::array<double, 3> WeightsIn(
  const TriangleMesh& mesh, const Grid& grid, Id triangle, const Vec3& position)
{
  const auto& corner = mesh.triangles[triangle];
  return Barycentric(grid.ToGrid(mesh.points[corner[0]]), grid.ToGrid(mesh.points[corner[1]]),
    grid.ToGrid(mesh.points[corner[2]]), position);
}

/// Returns the distance in cells. It includes the edges, because barycentric coordinates in slivers
/// are pure rounding.
double DistanceFromTriangle(
  const TriangleMesh& mesh, const Grid& grid, Id triangle, const Vec3& position)
{
  std::array<Vec3, 3> corner;
  for (int k = 0; k < 3; ++k)
  {
    corner[k] = grid.ToGrid(mesh.points[mesh.triangles[triangle][k]]);
  }
  const auto weight = Barycentric(corner[0], corner[1], corner[2], position);
  double distance = std::min({ DistanceFromSegment({ corner[0], corner[1] }, position),
    DistanceFromSegment({ corner[1], corner[2] }, position),
    DistanceFromSegment({ corner[2], corner[0] }, position) });
  if (std::min({ weight[0], weight[1], weight[2] }) >= 0.0)
  {
    const Vec3 nearest = weight[0] * corner[0] + weight[1] * corner[1] + weight[2] * corner[2];
    distance = std::min(distance, (nearest - position).norm());
  }
  return distance;
}

/// Returns the triangle of a source cell that contains the piece's center best. Throws if the piece
/// does not lie on it.
Id FindSourceTriangle(
  const ClippedMesh& clipped, Id piece, std::pair<Id, Id> candidates, const TriangleMesh& source)
{
  const Index* corner = &clipped.corners[clipped.pieceBegin[piece]];
  const Vec3 center =
    (clipped.position[corner[0]] + clipped.position[corner[1]] + clipped.position[corner[2]]) / 3.0;
  Id best = candidates.first;
  double bestInside = -std::numeric_limits<double>::infinity();
  for (Id triangle = candidates.first; triangle < candidates.second; ++triangle)
  {
    const auto weight = WeightsIn(source, clipped.grid, triangle, center);
    const double inside = std::min({ weight[0], weight[1], weight[2] });
    if (inside > bestInside)
    {
      bestInside = inside;
      best = triangle;
    }
  }
  const double distance = DistanceFromTriangle(source, clipped.grid, best, center);
  if (!(distance <= SameTriangle(clipped.grid, center)))
  {
    RefuseForeignBasis("its cells are in another order or join other points.");
  }
  return best;
}

/// Whether a point was stored from the given one, in double or in single precision.
bool IsStored(const Vec3& stored, const Vec3& given)
{
  return stored == given || stored == Vec3(given.cast<float>().cast<double>());
}

/// Returns the corner of a triangle that a stored point is, or -1. Among several corners at one
/// place, it prefers the corner with the point's number. Otherwise it takes the first that the
/// piece lacks among its corners taken .. end.
Id FindCorner(Id point, const TriangleMesh& stored, const TriangleMesh& given,
  const std::array<Id, 3>& corners, const Index* taken, const Index* end)
{
  Id found = -1;
  bool isFree = false;
  for (const Id corner : corners)
  {
    if (!IsStored(stored.points[point], given.points[corner]))
    {
      continue;
    }
    if (corner == point)
    {
      return corner;
    }
    if (!isFree)
    {
      found = corner;
      isFree = std::find(taken, end, static_cast<Index>(corner)) == end;
    }
  }
  return found;
}

void RequireAllFound(const TriangleMesh& source, const std::vector<char>& isFound)
{
  const std::vector<char> used = UsedPoints(source);
  for (std::size_t point = 0; point < used.size(); ++point)
  {
    if (used[point] && !isFound[point])
    {
      RefuseForeignBasis("point " + std::to_string(point) + " is elsewhere.");
    }
  }
}

void RequireSameArea(const TriangleMesh& clipped, const TriangleMesh& source)
{
  const double clippedArea = SurfaceArea(clipped);
  const double sourceArea = SurfaceArea(source);
  // Cut points in single precision change areas by far less.
  if (!(std::abs(clippedArea - sourceArea) <= 1e-3 * sourceArea))
  {
    RefuseForeignBasis("its surface has area " + std::to_string(clippedArea) +
                       ", this mesh has area " + std::to_string(sourceArea) + ".");
  }
}

} // namespace

SurfaceBasis OnClippedMesh(const SurfaceBasis& basis)
{
  GridFunctions space = *basis.space;
  auto mesh = std::make_shared<TriangleMesh>(FanTriangles(basis));
  SplitPieces(*mesh, space);
  space.clipped.numberOfInputPoints = static_cast<Id>(mesh->points.size());
  space.clipped.cutPoints.clear();
  space.pointPatch = FindPointPatches(space.clipped, space.piecePatch,
    space.Finest().NumberOfPatches(), space.clipped.numberOfInputPoints);

  SurfaceBasis result =
    MakeSurfaceBasis(std::move(mesh), std::move(space), basis.weldCoincidentPoints);
  result.operators = basis.operators;
  return result;
}

SurfaceBasis OnSourceMesh(
  const SurfaceBasis& basis, const std::vector<Id>& sourceCell, const InputMesh& source)
{
  const TriangleMesh& stored = *basis.mesh;
  const TriangleMesh& given = *source.triangles;
  RequireSameArea(stored, given);

  GridFunctions space = *basis.space;
  ClippedMesh& clipped = space.clipped;
  const ClippedMesh& before = basis.space->clipped;
  const auto inputs = static_cast<Index>(given.points.size());
  clipped.numberOfInputPoints = inputs;
  clipped.cutPoints.clear();
  clipped.position.clear();
  for (const Vec3& point : given.points)
  {
    clipped.position.push_back(clipped.grid.ToGrid(point));
  }
  std::vector<char> isFound(given.points.size(), 0);
  std::vector<Index> cutPoint(stored.points.size(), -1); // the cut point of each stored point
  for (Id piece = 0; piece < clipped.NumberOfPieces(); ++piece)
  {
    const Id cell = sourceCell[before.pieceTriangle[piece]];
    const auto candidates = TrianglesOfCell(source, cell);
    if (candidates.first == candidates.second)
    {
      RefuseForeignBasis(
        "it refers to cell " + std::to_string(cell) + ", which is not a polygon of this mesh.");
    }
    const Id triangle = FindSourceTriangle(before, piece, candidates, given);
    const auto& corners = given.triangles[triangle];
    clipped.pieceTriangle[piece] = static_cast<Index>(triangle);
    for (Id k = clipped.pieceBegin[piece]; k < clipped.pieceBegin[piece + 1]; ++k)
    {
      const Index point = before.corners[k];
      const Vec3& position = before.position[point];
      const Id input = FindCorner(point, stored, given, corners,
        &clipped.corners[clipped.pieceBegin[piece]], &clipped.corners[k]);
      if (input >= 0)
      {
        clipped.corners[k] = static_cast<Index>(input);
        clipped.position[input] = position;
        isFound[input] = 1;
        continue;
      }
      if (cutPoint[point] < 0)
      {
        cutPoint[point] = static_cast<Index>(clipped.position.size());
        clipped.position.push_back(position);
        clipped.cutPoints.push_back(
          { static_cast<Index>(triangle), WeightsIn(given, clipped.grid, triangle, position) });
      }
      clipped.corners[k] = cutPoint[point];
    }
  }
  RequireAllFound(given, isFound);
  space.pointPatch = FindPointPatches(space.clipped, space.piecePatch,
    space.Finest().NumberOfPatches(), space.clipped.numberOfInputPoints);
  SurfaceBasis result =
    MakeSurfaceBasis(source.triangles, std::move(space), basis.weldCoincidentPoints);
  result.operators = basis.operators;
  return result;
}

} // namespace gridfem
