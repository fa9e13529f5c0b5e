// The input of everything: a triangle soup with shared points, in world coordinates, and the
// identification of its coincident points.
#ifndef GridFEM_TriangleMesh_h
#define GridFEM_TriangleMesh_h

#include "Base/Array.h"
#include "Base/Types.h"

#include <vector>

namespace gridfem
{

struct TriangleMesh
{
  std::vector<Vec3> points;                 // world units
  std::vector<std::array<Id, 3>> triangles; // indices into points
};

/// Throws InvalidInput naming the first triangle with an index out of range, or the first
/// triangle corner with a NaN or infinite coordinate.
void Validate(const TriangleMesh& mesh, int threads = 0);

/// For each point that `used` marks (all when empty) the lowest id of such a point with the same
/// three coordinates; other points stand for themselves. Coordinates are compared
/// exactly (-0 = 0).
/// Cost O(n log n).
Array<Index> WeldCoincidentPoints(
  const std::vector<Vec3>& points, const std::vector<char>& used = {}, int threads = 0);

/// 1 for points that a triangle uses.
std::vector<char> UsedPoints(const TriangleMesh& mesh, int threads = 0);

struct Bounds
{
  Vec3 low;
  Vec3 high;
};

/// Of the points that `used` marks (all when empty); low is infinite and high is -infinite when
/// there are none.
Bounds BoundsOf(
  const std::vector<Vec3>& points, const std::vector<char>& used = {}, int threads = 0);

/// Surface area, world units.
double SurfaceArea(const TriangleMesh& mesh);

} // namespace gridfem

#endif
