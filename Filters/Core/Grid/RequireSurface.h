// What a mesh has to be for problems to be solved on it.
#ifndef GridFEM_RequireSurface_h
#define GridFEM_RequireSurface_h

#include "Grid/TriangleMesh.h"

namespace gridfem
{

/// Throws InvalidInput where Validate does; when coordinates, or the longest side of the bounding
/// box of the triangles, leave the range from 1e-70 to 1e70; and when the area is below 1e-11 of
/// the square of the box's diagonal. Without this a problem may give numbers that are not finite.
void RequireSurface(const TriangleMesh& mesh);

} // namespace gridfem

#endif
