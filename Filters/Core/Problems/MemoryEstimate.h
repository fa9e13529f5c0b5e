// How much memory a job will take, before it is allocated.
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

/// Expected sizes for a valid mesh at a depth, from the areas and extents of its triangles: usually
/// within a few percent, the bytes within a fifth. Triangles that share points, or coincident ones
/// that are welded, are taken to be connected; a soup that is not welded has more patches. Cost
/// O(triangles).
MemoryEstimate EstimateMemory(const TriangleMesh& mesh, int depth);

/// The same for a part of a surface, in the grid of the whole.
MemoryEstimate EstimateMemory(const TriangleMesh& mesh, const Grid& grid);

/// The functions that so many patches are expected to have.
double FunctionsOfPatches(double patches);

/// How many points a mesh is taken to have once coincident ones are welded.
double WeldedPoints(const TriangleMesh& mesh);

/// The finest depth from `most` down at which a condition holds, or `least`.
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

/// Costs next to nothing and serves the faces of coarse meshes.
inline constexpr int CoarsestSuggestion = 6;

/// The finest depth at which the grid is expected to have no more functions than the surface has
/// points, coincident ones counted once: what the mesh can tell, at the cost of the mesh. At least
/// CoarsestSuggestion.
int SuggestedDepth(const TriangleMesh& mesh);

/// The same where the functions at a depth and the points are known otherwise.
int SuggestedDepth(double points, const std::function<double(int depth)>& functions);

/// The finest depth, from `most` down, at which the grid is expected to have no more functions than
/// this for each point of the surface, coincident ones counted once; or the least depth.
int DepthForPoints(const TriangleMesh& mesh, int most, double functionsPerPoint);

/// Bytes that the hat functions of a mesh take on top: their matrices, the transfer to the grid and
/// their part of the hierarchy, with one right-hand side. Within a third on meshes whose triangles
/// share their points. Cost O(1).
/// @param functions  of the grid below, which the transfer has a row for each of
double EstimateHatMemory(const TriangleMesh& mesh, double functions);

/// Bytes that all processes of this machine together can allocate now; in a container at most what
/// its limit leaves. Infinity when unknown.
double MemoryOfMachine();

/// Bytes that the limit of this process (`ulimit -v`) leaves; infinity without one.
double MemoryOfProcess();

/// The smaller one of both.
double AvailableMemory();

} // namespace gridfem

#endif
