#include "Solvers/MemoryEstimate.h"

#include "Grid/MeshEdges.h"
#include "Grid/PatchLevel.h"

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace gridfem
{

namespace
{

// Bytes in use at the peak, fitted to the growth of the process (Testing/Benchmarks, group
// `memory`). The sizes of the arrays are in brackets. They explain all but two parts: the slack of
// growing vectors, and freed memory that is not yet used again.

// Memory while clipping:
constexpr double ClipPerPoint = 70.0;    // position, the same on planes, welded id, sort entry (68)
constexpr double ClipPerTriangle = 40.0; // its sides and the pieces along them (36)
// Pieces, corners and links, by thread and joined, and cut points.
constexpr double ClipPerPiece = 102.0;
// Memory that stays:
constexpr double HeldPerPoint = 28.0; // position, patch (28)
constexpr double HeldPerPiece = 50.0; // piece 12, corners 4 each, cut points 48 (49)
// Function space, system and hierarchy, for all levels (4/3 of the finest). Tables take 150,
// element matrices 770, patterns and matrices of 2 functions with 18 entries each 600. Stencils and
// inverses take 1110 (inverses alone 390 to 770), prolongations and their transposes 240.
constexpr double HeldPerPatch = 3300.0;
// Ten vectors for one right-hand side.
constexpr double HeldPerFunction = 80.0;

// Hats, whose points have six neighbors. Tables take 40, matrices with 7 entries per row 160, the
// combined and ordered matrices 130. The transfer of 8 entries and its transpose takes 210, groups
// of eight and their factors 60, vectors 80.
constexpr double HatsPerPoint = 680.0;
constexpr double HatsPerFunction = 10.0;

// Quadratic functions, for all levels. There are half as many patches as functions. Tables 90, mass
// and stiffness with 75 entries per row 2,000, the matrix of the hierarchy 800, prolongations and
// their transposes 400, inverses 4,000.
constexpr double SmoothPerFunction = 7300.0;

/// Bytes of cached files in a container's use. The system frees them when memory is needed.
double BytesOfFiles()
{
  std::ifstream statistics("/sys/fs/cgroup/memory.stat");
  double bytes = 0.0;
  for (std::string name; statistics >> name >> bytes;)
  {
    if (name == "inactive_file")
    {
      return bytes;
    }
  }
  return 0.0;
}

} // namespace

/// If triangles share no points, the mesh is counted as welded: two triangles per point.
double WeldedPoints(const TriangleMesh& mesh)
{
  const double welded = 0.5 * static_cast<double>(mesh.triangles.size()) + 3.0;
  return std::min(static_cast<double>(mesh.points.size()), welded);
}

double FunctionsOfPatches(double patches)
{
  return 2.0 * patches + FunctionsPerPatch;
}

MemoryEstimate EstimateMemory(const TriangleMesh& mesh, int depth)
{
  return EstimateMemory(mesh, EmbedInGrid(mesh.points, UsedPoints(mesh), depth));
}

MemoryEstimate EstimateMemory(const TriangleMesh& mesh, const Grid& grid)
{
  // Counts the lines in which planes cut a triangle, and the crossings of two planes in it. A
  // triangle falls into 1 + lines + crossings pieces and 1 + 2 (lines + crossings) triangles. The
  // number of crossings is, on average, the triangle's area projected along each axis.
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
  // A plane meets as many cells as grid lines cross it. A surface has at least one patch.
  estimate.patches = crossings + 1.0;
  estimate.functions = FunctionsOfPatches(estimate.patches);
  const double points = static_cast<double>(mesh.points.size());
  const double clip = ClipPerPoint * points + ClipPerTriangle * triangles + ClipPerPiece * pieces;
  const double solve = HeldPerPoint * points + HeldPerPiece * pieces +
                       HeldPerPatch * estimate.patches + HeldPerFunction * estimate.functions;
  estimate.bytes = std::max(clip, solve);
  return estimate;
}

int SuggestedDepth(double points, const std::function<double(int depth)>& functions)
{
  int depth = CoarsestSuggestion;
  while (depth < MaximumDepth && functions(depth + 1) <= points)
  {
    ++depth;
  }
  return depth;
}

int SuggestedDepth(const TriangleMesh& mesh)
{
  return SuggestedDepth(
    WeldedPoints(mesh), [&](int depth) { return EstimateMemory(mesh, depth).functions; });
}

int DepthForPoints(const TriangleMesh& mesh, int most, double functionsPerPoint)
{
  const double functions = functionsPerPoint * WeldedPoints(mesh);
  return FinestDepth(most, MinimumDepth,
    [&](int depth) { return EstimateMemory(mesh, depth).functions <= functions; });
}

double EstimateHatMemory(const TriangleMesh& mesh, double functions)
{
  return HatsPerPoint * WeldedPoints(mesh) + HatsPerFunction * functions;
}

double EstimateSmoothMemory(double functions)
{
  return SmoothPerFunction * functions;
}

double MemoryOfMachine()
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
  // A container may allow less memory than the machine has. Files that it has read do not count.
  double limit = 0.0;
  double used = 0.0;
  if (std::ifstream("/sys/fs/cgroup/memory.max") >> limit &&
      std::ifstream("/sys/fs/cgroup/memory.current") >> used)
  {
    used -= BytesOfFiles();
    available = std::min(available, std::max(limit - used, 0.0));
  }
  return available;
}

double MemoryOfProcess()
{
#ifdef __linux__
  rlimit limit{};
  double pages = 0.0;
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
      std::ifstream("/proc/self/statm") >> pages)
  {
    return std::max(double(limit.rlim_cur) - pages * double(sysconf(_SC_PAGESIZE)), 0.0);
  }
#endif
  return std::numeric_limits<double>::infinity();
}

double AvailableMemory()
{
  return std::min(MemoryOfMachine(), MemoryOfProcess());
}

} // namespace gridfem
