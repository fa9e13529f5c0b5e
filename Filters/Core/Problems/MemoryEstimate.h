// How much memory a job will take, before it is allocated.
#ifndef GridFEM_MemoryEstimate_h
#define GridFEM_MemoryEstimate_h

#include "Grid/TriangleMesh.h"

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

/// Bytes that can be allocated on this machine now; 0 when unknown.
double AvailableMemory();

} // namespace gridfem

#endif
