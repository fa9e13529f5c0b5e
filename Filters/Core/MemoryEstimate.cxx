#include "MemoryEstimate.h"

#include "Grid.h"
#include "MeshEdges.h"

#include <fstream>
#include <limits>
#include <string>

namespace gridfem
{

namespace
{

// Bytes held at the peak, from the sizes of the arrays that live together; Testing/Benchmarks
// measures the estimate against the real peak.
constexpr double BytesPerPoint = 150.0;
constexpr double BytesPerTriangle = 180.0;
constexpr double BytesPerPiece = 170.0;
constexpr double BytesPerPatch = 4000.0;

} // namespace

MemoryEstimate EstimateMemory(const TriangleMesh& mesh, int depth)
{
  const Grid grid = EmbedInGrid(mesh.points, UsedPoints(mesh), depth);
  // Lines are the stretches along which planes cut a triangle; crossings the points where two
  // planes do. A triangle falls into 1 + lines + crossings pieces and 1 + 2 (lines + crossings)
  // triangles. The number of crossings is the triangle's area projected along each axis, on
  // average.
  double lines = 0.0;
  double crossings = 0.0;
  for (const auto& triangle : mesh.triangles)
  {
    const Vec3 a = grid.ToGrid(mesh.points[triangle[0]]);
    const Vec3 b = grid.ToGrid(mesh.points[triangle[1]]);
    const Vec3 c = grid.ToGrid(mesh.points[triangle[2]]);
    const Vec3 low = a.cwiseMin(b).cwiseMin(c);
    const Vec3 high = a.cwiseMax(b).cwiseMax(c);
    for (int axis = 0; axis < 3; ++axis)
    {
      lines += PlanesBetween(low[axis], high[axis]).count;
    }
    crossings += 0.5 * (b - a).cross(c - a).cwiseAbs().sum();
  }
  MemoryEstimate estimate;
  const double triangles = static_cast<double>(mesh.triangles.size());
  const double pieces = triangles + lines + crossings;
  estimate.clippedTriangles = triangles + 2.0 * (lines + crossings);
  // A plane meets as many cells as grid lines cross it; a surface has at least one patch.
  estimate.patches = crossings + 1.0;
  estimate.functions = 2.0 * estimate.patches + FunctionsPerPatch;
  estimate.bytes = BytesPerPoint * static_cast<double>(mesh.points.size()) +
                   BytesPerTriangle * triangles + BytesPerPiece * pieces +
                   BytesPerPatch * estimate.patches;
  return estimate;
}

double AvailableMemory()
{
  double available = std::numeric_limits<double>::infinity();
  std::ifstream info("/proc/meminfo");
  for (std::string name; info >> name;)
  {
    if (name == "MemAvailable:")
    {
      double kibibytes = 0.0;
      info >> kibibytes;
      available = 1024.0 * kibibytes;
      break;
    }
    info.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  // A container may allow less than the machine has.
  double limit = 0.0;
  double used = 0.0;
  if (std::ifstream("/sys/fs/cgroup/memory.max") >> limit &&
      std::ifstream("/sys/fs/cgroup/memory.current") >> used && limit - used < available)
  {
    available = limit - used;
  }
  return available < std::numeric_limits<double>::infinity() ? available : 0.0;
}

} // namespace gridfem
