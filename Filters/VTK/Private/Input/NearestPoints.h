// Finds the mesh points nearest to places in space.
#ifndef GridFEM_NearestPoints_h
#define GridFEM_NearestPoints_h

#include "Grid/TriangleMesh.h"

#include <string>

class vtkDataSet;

namespace gridfem
{

/// Returns, for every point of `places`, the nearest point of the mesh that a triangle uses. Throws
/// InvalidInput naming a point of `places` that is not finite. `input` is the name in the message.
std::vector<Id> NearestPoints(
  const TriangleMesh& mesh, vtkDataSet* places, const std::string& input);

} // namespace gridfem

#endif
