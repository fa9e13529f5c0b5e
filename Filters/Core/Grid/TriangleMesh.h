// The input of everything: a list of triangles with shared points in world coordinates. Coincident
// points are found here, too.
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

/// Throws InvalidInput that names the first triangle with an index out of range or with a NaN or
/// infinite coordinate.
void Validate(const TriangleMesh& mesh, int threads = 0);

/// Returns for each point the lowest id of a point with the same three coordinates. Only points
/// marked by `used` count (all if it is empty); other points keep their own id. Coordinates are
/// compared exactly (-0 = 0). Cost O(n log n).
Array<Index> WeldCoincidentPoints(
  const std::vector<Vec3>& points, const std::vector<char>& used = {}, int threads = 0);

/// Returns 1 for every point that a triangle uses, and 0 for the others.
std::vector<char> UsedPoints(const TriangleMesh& mesh, int threads = 0);

struct Bounds
{
  Vec3 low;
  Vec3 high;
};

/// Returns the bounding box of the points marked by `used` (of all if it is empty). Without such
/// points, low is infinite and high is -infinite.
Bounds BoundsOf(
  const std::vector<Vec3>& points, const std::vector<char>& used = {}, int threads = 0);

/// Returns the surface area in world units.
double SurfaceArea(const TriangleMesh& mesh);

} // namespace gridfem

#endif
