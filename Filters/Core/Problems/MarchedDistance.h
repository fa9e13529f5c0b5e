// Distance along a mesh from some of its points as far as a limit: a front that marches from
// triangle to triangle. Rougher than GeodesicDistance, for widths of transitions, where it takes no
// solution and looks at no triangle beyond the limit.
#ifndef GridFEM_MarchedDistance_h
#define GridFEM_MarchedDistance_h

#include "Grid/TriangleMesh.h"
#include "Spaces/HatFunctions.h"

#include <vector>

namespace gridfem
{

/// The distance of every point from the nearest source, world units; 0 at sources, infinite where
/// it is more than the limit or no path leads. Fast marching on triangles (Kimmel and Sethian
/// 1998): a front crosses a triangle as a straight line, or runs along its edges where that is no
/// way from the two points that it has reached. Never less than the distance through space.
/// @param hats      of the mesh: which triangles are around a point, coincident ones welded or not
/// @param isSource  per point of the mesh; of coincident ones that are welded any counts for all
/// @param limit     world units, 0 or more
/// Cost O(points) and O(k log k) for k points within the limit.
std::vector<double> MarchDistance(const TriangleMesh& mesh, const HatFunctions& hats,
  const std::vector<char>& isSource, double limit);

} // namespace gridfem

#endif
