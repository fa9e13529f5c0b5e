// Estimates how much memory a job will take, before it is allocated.
#ifndef GridFEM_MemoryEstimate_h
#define GridFEM_MemoryEstimate_h

#include "Grid/Grid.h"
#include "Grid/TriangleMesh.h"

#include <functional>

namespace gridfem
{

struct MemoryEstimate
{
  double clippedTriangles = 0; // expected counts
  double patches = 0;
  double functions = 0;
  double bytes = 0; // peak of clip, space, system and hierarchy for one right-hand side
};

/// Expected sizes for a valid mesh at a depth, from the areas and extents of its triangles. Counts
/// are usually within a few percent, the bytes within a fifth. Triangles that share points, or
/// coincident points that are welded, are assumed to be connected. A soup that is not welded has
/// more patches. Cost O(triangles).
MemoryEstimate EstimateMemory(const TriangleMesh& mesh, int depth);

/// The same for a part of a surface, in the grid of the whole surface.
MemoryEstimate EstimateMemory(const TriangleMesh& mesh, const Grid& grid);

/// The expected number of functions on this number of patches.
double FunctionsOfPatches(double patches);

/// The expected number of points of a mesh once coincident points are welded.
double WeldedPoints(const TriangleMesh& mesh);

/// The finest depth, from `most` down to `least`, at which a condition holds; `least` if it never
/// holds.
template<class Condition>
int FinestDepth(int most, int least, Condition&& holds)
{
  int depth = most;
  while (depth > least && !holds(depth))
  {
    --depth;
  }
  return depth;
}

/// Coarsest depth that is suggested. It costs next to nothing and serves the faces of coarse
/// meshes.
inline constexpr int CoarsestSuggestion = 6;

/// The finest depth at which the grid is expected to have no more functions than the surface has
/// points, with coincident points counted once. The solution then has the resolution of the mesh,
/// at the cost of the mesh. At least CoarsestSuggestion.
int SuggestedDepth(const TriangleMesh& mesh);

/// The same for given numbers of points and of functions at each depth.
int SuggestedDepth(double points, const std::function<double(int depth)>& functions);

/// The finest depth, from `most` down, at which the grid is expected to have at most this many
/// functions per point of the surface. Coincident points count once. Returns the least depth if
/// there is none.
int DepthForPoints(const TriangleMesh& mesh, int most, double functionsPerPoint);

/// Additional bytes for the hat functions of a mesh: their matrices, the transfer to the grid and
/// their part of the hierarchy, with one right-hand side. Within a third on meshes whose triangles
/// share their points. Cost O(1).
/// @param functions  of the grid below; the transfer has a row for each
double EstimateHatMemory(const TriangleMesh& mesh, double functions);

/// Additional bytes for the quadratic functions of a grid with this many trilinear ones: their
/// matrices and their hierarchy. Within a third.
double EstimateSmoothMemory(double functions);

/// Bytes that all processes of this machine together can allocate now. In a container it is at most
/// the rest of the container's limit. Infinity when unknown.
double MemoryOfMachine();

/// Bytes that this process may still allocate under its limit (`ulimit -v`); infinity without a
/// limit.
double MemoryOfProcess();

/// The smaller of both.
double AvailableMemory();

} // namespace gridfem

#endif
