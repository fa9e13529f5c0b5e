// Curves that divide a surface into two sides, and the side of every point. The curves are borders
// of regions, or lines in space that run along the surface.
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
  std::vector<signed char> side; // per point: -1 inside, 1 outside, 0 if certainly on the curve
  std::vector<Index> place;      // per point, the first point in its place
};

/// The border between a region and the rest. A region of points ends halfway along the edges that
/// leave it; a region of triangles ends at edges. Coincident points that are welded may be on
/// different sides; the border then runs through them.
/// @param isInside  one column on points or triangles: not 0 in the region
/// Throws InvalidInput when all of the surface is inside or nothing is, or the field does not fit.
SurfaceCurve BorderOfRegion(
  const TriangleMesh& mesh, const Field& isInside, bool weldCoincidentPoints);

/// The same for the region where integer labels have this value. A label that is not an integer
/// throws InvalidInput, too.
SurfaceCurve BorderOfLabel(
  const TriangleMesh& mesh, const Field& labels, int inside, bool weldCoincidentPoints);

/// A point of a triangle, world units.
struct SurfacePlace
{
  Id triangle;
  Vec3 position;
};

/// Finds places on the surface near a point in space. The nearest place comes first. Then comes the
/// nearest place on every other triangle within a tolerance. Triangles with two corners in one
/// place are left out.
using NearestPlaces =
  std::function<std::vector<SurfacePlace>(const Vec3& wanted, double tolerance)>;

/// Divides the surface by lines. Each point of a line is moved to its nearest place on the surface.
/// Lines may cross and come in pieces. They may end in triangles at the border of the surface, but
/// nowhere else. On each connected component, the smaller area is inside. If both parts are equal,
/// the part without the first point is inside.
///
/// An edge of the mesh that lines cross an odd number of times separates two sides. A line that
/// ends within the surface leaves a triangle with an odd number of such edges. Some lines do not
/// divide the surface, such as a meridian of a torus: a path around them comes back on the other
/// side. Both throw InvalidInput with the place.
///
/// If two successive points of a line lie in one triangle, the piece between them is in that
/// triangle. Triangles that the piece crosses from edge to edge are preferred. The lines of a slice
/// are then each on their own part of the surface where parts touch. A repeated piece goes to the
/// next such triangle, for doubled triangles. If there is none, a piece repeated by another line
/// counts once.
///
/// A line that jumps between parts of the surface throws InvalidInput, too, and so does an open
/// line within a triangle. Cost O(triangles + crossings), and some calls of `nearest` for each
/// crossing.
SurfaceCurve DivideByLines(const TriangleMesh& mesh, const std::vector<std::vector<Vec3>>& lines,
  const NearestPlaces& nearest, bool weldCoincidentPoints);

} // namespace gridfem

#endif
