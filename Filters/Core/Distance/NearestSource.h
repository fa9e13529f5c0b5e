// Finds the nearest source of a distance for every point: Voronoi regions on a surface.
#ifndef GridFEM_NearestSource_h
#define GridFEM_NearestSource_h

#include "Base/Job.h"
#include "Grid/TriangleMesh.h"

#include <string>
#include <vector>

namespace gridfem
{

/// Throws InvalidInput that names the first source that is not a point of a mesh with this many
/// points.
void RequireSources(const std::vector<Id>& sources, std::size_t points);

/// Throws InvalidInput that names the property and the first id that no triangle uses.
void RequireUsed(const std::string& property, const std::vector<Id>& ids, const TriangleMesh& mesh);

/// The least id that a triangle uses: the source where none is chosen.
Id FirstUsedPoint(const TriangleMesh& mesh);

/// The point nearest to a place in space, among the points that a triangle uses. If several are as
/// near, the one with the least id.
/// @param property  the name of the place in messages
/// Throws InvalidInput if the place is not finite.
Id NearestUsedPoint(const std::string& property, const Vec3& place, const TriangleMesh& mesh);

/// Traces every point back to the origin of its distance. The steepest descent on the triangles
/// around the point leads to a place between two nearer points. The labels of these two are mixed
/// in the proportion of the place. The labels are the binary digits of the sources' numbers, as
/// shares between 0 and 1. Borders of regions therefore do not follow the edges of the mesh.
///
/// @param distance  of every point of the mesh; NaN if it has none
/// @param sources   points of the mesh, whose distance is 0
/// @param weldCoincidentPoints  whether points in one place are one
/// @return  a source per point of the mesh; among sources in one place, the first in the list. It
///   is -1 if the distance is NaN or triangles lead to no source. Functions that ignore
///   connectivity have distances across gaps, too. Borders are right to about an edge of the mesh.
/// Throws InvalidInput when there is not one distance per point or a source is no point, and
/// Aborted.
std::vector<Id> NearestSources(const TriangleMesh& mesh, const std::vector<double>& distance,
  const std::vector<Id>& sources, bool weldCoincidentPoints, const Job& job = {});

} // namespace gridfem

#endif
