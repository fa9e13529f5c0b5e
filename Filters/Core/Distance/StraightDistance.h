// The distance through space from points and segments. No path along a surface is shorter.
#ifndef GridFEM_StraightDistance_h
#define GridFEM_StraightDistance_h

#include "Grid/SegmentTree.h"
#include "Grid/TriangleMesh.h"

#include <vector>

namespace gridfem
{

/// The distance from the nearest segment at every point of the mesh. It is 0 without a segment, as
/// the lower bound of a distance that nothing is known about. Same bits for any order of the
/// segments and any number of threads.
std::vector<double> DistancesThroughSpace(
  const TriangleMesh& mesh, std::vector<Segment> segments, int threads);

/// The places where paths from the sources begin. They are the sources themselves, and the rims of
/// the regions whose triangles have sources at all corners. Sources within such a region are left
/// out.
/// @param isSource  per point of the mesh
std::vector<Segment> RimOfSources(
  const TriangleMesh& mesh, const std::vector<char>& isSource, int threads);

} // namespace gridfem

#endif
