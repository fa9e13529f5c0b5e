// Finds the points of a mesh that distances start from.
#ifndef GridFEM_SourcePoints_h
#define GridFEM_SourcePoints_h

#include "Grid/TriangleMesh.h"

#include <string>
#include <vector>

class vtkDataSet;

namespace gridfem
{

/// Returns the given point ids and the mesh points nearest to the points and lines of `places` (may
/// be null), ascending, every point once. Points that no polygon uses do not count. Throws
/// InvalidInput naming an id that no polygon uses, or a point of `places` that is not finite.
/// @param warnings  one sentence if places are far from the surface (NearestPoints)
std::vector<Id> SourcePoints(const TriangleMesh& mesh, const std::vector<Id>& ids,
  vtkDataSet* places, std::vector<std::string>& warnings);

} // namespace gridfem

#endif
