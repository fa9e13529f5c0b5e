// Curves that divide a surface into two sides, and the side that every point is on: borders of
// regions, and lines in space that run along the surface.
#ifndef GridFEM_SurfaceCurve_h
#define GridFEM_SurfaceCurve_h

#include "Grid/Field.h"
#include "Grid/SurfaceEdges.h"

#include <functional>
#include <vector>

namespace gridfem
{

struct SurfaceCurve
{
  std::vector<TriangleSegment> segments;
  std::vector<signed char> side; // per point: -1 inside, 1 outside, 0 for certain on the curve
  std::vector<Index> place;      // per point the first one in its place
};

/// The border between a region and the rest. A region of points ends half way along the edges that
/// leave it, one of triangles at edges. Of coincident points that are welded, each side may have
/// its own: the border runs through them.
/// @param isInside  one column on points or triangles: not 0 in the region
/// Throws InvalidInput when all of the surface is inside or nothing, or the field does not fit.
SurfaceCurve BorderOfRegion(
  const TriangleMesh& mesh, const Field& isInside, bool weldCoincidentPoints);

/// The same for the region where labels, integers, have this value. Throws InvalidInput for a label
/// that is none, too.
SurfaceCurve BorderOfLabel(
  const TriangleMesh& mesh, const Field& labels, int inside, bool weldCoincidentPoints);

/// A point of a triangle, world units.
struct SurfacePlace
{
  Id triangle;
  Vec3 position;
};

/// The place on the surface nearest to a point in space, first, and that of every other triangle
/// which is nearer to it than a tolerance. Not on triangles two of whose corners are one point.
using NearestPlaces =
  std::function<std::vector<SurfacePlace>(const Vec3& wanted, double tolerance)>;

/// Lines from point to point, each of which is moved to its nearest place on the surface. They may
/// cross, come in pieces, and end in triangles at the border of the surface, but nowhere else. On
/// each connected component the smaller area is inside; of equal ones, that without the first
/// point.
/// Every edge of the mesh that lines cross an odd number of times has two sides: a line that
/// ends within the surface leaves a triangle with an odd number of such edges, and around lines
/// that do not divide it, such as a meridian of a torus, one comes back on the other side.
/// A piece from point to point whose ends are in one triangle is in that one, best in one from edge
/// to edge of which it leads: so the lines of a slice are each on their own part of the surface
/// where parts touch. The same piece again is in the next such triangle, as where triangles are
/// double; where there is none, one of another line counts once.
/// Throws InvalidInput that says where for both, for a line that jumps between parts of the
/// surface, and for one that is within a triangle and not closed. Cost O(triangles + crossings),
/// and some calls of `nearest` for each crossing.
SurfaceCurve DivideByLines(const TriangleMesh& mesh, const std::vector<std::vector<Vec3>>& lines,
  const NearestPlaces& nearest, bool weldCoincidentPoints);

} // namespace gridfem

#endif
