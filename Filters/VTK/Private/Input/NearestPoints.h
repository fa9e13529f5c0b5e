// Finds the mesh points nearest to places in space.
#ifndef GridFEM_NearestPoints_h
#define GridFEM_NearestPoints_h

#include "Grid/TriangleMesh.h"

#include <string>

class vtkDataSet;

namespace gridfem
{

/// Returns, for every point of `places`, the nearest point of the mesh that a triangle uses. Throws
/// InvalidInput naming a point of `places` that is not finite.
/// @param input     its name in messages
/// @param warnings  one sentence if places are far from the surface: farther from its points than
///   a twentieth of its longest side and than its longest edge. Empty otherwise. No place on the
///   surface is that far from the corners of its triangle.
std::vector<Id> NearestPoints(const TriangleMesh& mesh, vtkDataSet* places,
  const std::string& input, std::vector<std::string>& warnings);

/// Returns the same points, followed by the mesh points nearest to places between the points of
/// the lines of `places`. Neighboring places are at most half as far apart as their nearest points.
/// Places far from the surface do not count, so a line through space does not count there.
std::vector<Id> NearestPointsAlongLines(const TriangleMesh& mesh, vtkDataSet* places,
  const std::string& input, std::vector<std::string>& warnings);

} // namespace gridfem

#endif
