// Locally shortest paths along the triangles of a surface.
#ifndef GridFEM_SurfacePath_h
#define GridFEM_SurfacePath_h

#include "Base/Job.h"
#include "Distance/PathSearch.h"
#include "Distance/TriangleStrip.h"

#include <vector>

namespace gridfem
{

struct SurfacePath
{
  /// The ends, and all points where the path crosses an edge or goes through a point of the mesh.
  std::vector<PathPoint> points;
  double length = 0.0; // world units
};

/// The position of a point of a path.
Vec3 PositionOf(const TriangleMesh& mesh, const PathPoint& point);

/// Pulls a way tight, like a string with fixed ends. The result is straight across every edge. At
/// every point of the mesh on the path, the angle on each side is at least π, so no path nearby is
/// shorter. The path is never longer than the way.
///
/// The shortest path within a strip of triangles turns at corners of the strip. If the angle on the
/// other side of a corner is less than π, the strip moves to this side. [Xin and Wang 2007] Each
/// step shortens the path. Throws Aborted.
/// @param way  at least one node. The path of a single node has two equal points, or none if no
///   triangle with three different places is there.
SurfacePath PullTight(
  const PathGraph& graph, const std::vector<PathSearch::Node>& way, const Job& job = {});

/// Pulls each strip tight by itself. A strip begins where the one before ends.
SurfacePath PullTight(
  const PathGraph& graph, const std::vector<TriangleStrip>& strips, const Job& job = {});

} // namespace gridfem

#endif
