// From places in space to points of a mesh.
#ifndef GridFEM_NearestPoints_h
#define GridFEM_NearestPoints_h

#include "Grid/TriangleMesh.h"

#include <string>

class vtkDataSet;

namespace gridfem
{

/// For every point of `places` the nearest point of the mesh that a triangle uses. Throws
/// InvalidInput naming a point of `places` that is not finite; `input` is the name the message
/// gives.
std::vector<Id> NearestPoints(
  const TriangleMesh& mesh, vtkDataSet* places, const std::string& input);

} // namespace gridfem

#endif
