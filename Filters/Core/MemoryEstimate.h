// How much memory a job will take, before it is allocated.
#ifndef GridFEM_MemoryEstimate_h
#define GridFEM_MemoryEstimate_h

#include "TriangleMesh.h"

namespace gridfem
{

struct MemoryEstimate
{
  double clippedTriangles = 0; // expected counts
  double patches = 0;
  double functions = 0;
  double bytes = 0; // peak of clip, space, system and hierarchy for one right-hand side
};

/// Expected sizes for a mesh at a depth, from the areas and extents of its triangles. Cost
/// O(triangles).
MemoryEstimate EstimateMemory(const TriangleMesh& mesh, int depth);

/// Bytes that can be allocated on this machine now; 0 when unknown.
double AvailableMemory();

} // namespace gridfem

#endif
