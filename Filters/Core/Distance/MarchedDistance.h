// Distance along a mesh from some of its points up to a limit, by a front that marches from
// triangle to triangle. It is rougher than GeodesicDistance and serves for widths of transitions.
// It solves no system and visits no triangle beyond the limit.
#ifndef GridFEM_MarchedDistance_h
#define GridFEM_MarchedDistance_h

#include "Grid/TriangleMesh.h"
#include "Spaces/HatFunctions.h"

#include <vector>

namespace gridfem
{

/// The distance of every point from the nearest source, world units; 0 at sources. It is infinite
/// beyond the limit or without a path. Fast marching on triangles (Kimmel and Sethian 1998): a
/// front crosses a triangle as a straight line from the two points it has reached. If that is
/// impossible, it runs along the edges. Never less than the distance through space.
/// @param hats      of the mesh: the triangles around each point, with coincident points welded or
///   not
/// @param isSource  per point of the mesh; among welded points, any source counts for all
/// @param limit     world units, 0 or more
/// Cost O(points) and O(k log k) for k points within the limit.
std::vector<double> MarchDistance(const TriangleMesh& mesh, const HatFunctions& hats,
  const std::vector<char>& isSource, double limit);

} // namespace gridfem

#endif
