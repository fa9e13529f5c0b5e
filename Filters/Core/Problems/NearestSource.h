// Which of the sources of a distance is the nearest: Voronoi regions on a surface.
#ifndef GridFEM_NearestSource_h
#define GridFEM_NearestSource_h

#include "Base/Job.h"
#include "Grid/TriangleMesh.h"

#include <vector>

namespace gridfem
{

/// Throws InvalidInput naming the first source that is no point of a mesh with so many of them.
void RequireSources(const std::vector<Id>& sources, std::size_t points);

/// Every point asks where its distance comes from: the steepest descent on the triangles around it
/// leads to a place between two points that are nearer, and what these know is mixed in its
/// proportion. What is handed on are the binary digits of the sources' numbers, as shares between 0
/// and 1, so that borders of regions do not follow the edges of the mesh.
///
/// @param distance  of every point of the mesh; NaN where none is
/// @param sources   points of the mesh, whose distance is 0
/// @param weldCoincidentPoints  whether points in one place are one
/// @return  per point of the mesh a source, the first in the list of those in its place; -1 where
///   the distance is NaN, and where triangles lead to no source: functions that are not aware of
///   connectivity have distances across gaps, too. Borders are right to about an edge of the mesh.
/// Throws InvalidInput when there is not one distance per point or a source is no point, and
/// Aborted.
std::vector<Id> NearestSources(const TriangleMesh& mesh, const std::vector<double>& distance,
  const std::vector<Id>& sources, bool weldCoincidentPoints, const Job& job = {});

} // namespace gridfem

#endif
