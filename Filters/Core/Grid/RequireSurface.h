// The conditions that a mesh must fulfill so that problems can be solved on it.
#ifndef GridFEM_RequireSurface_h
#define GridFEM_RequireSurface_h

#include "Grid/TriangleMesh.h"

namespace gridfem
{

/// Throws InvalidInput in the cases of Validate, and in two more. First, coordinates or the longest
/// side of the triangles' bounding box are outside 1e-70 .. 1e70. Second, the area is below 1e-11
/// of the square of the box's diagonal. Such a surface might lead to results that are not finite.
void RequireSurface(const TriangleMesh& mesh);

} // namespace gridfem

#endif
