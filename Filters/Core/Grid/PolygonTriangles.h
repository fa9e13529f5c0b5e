// Polygons of any number of corners, concave ones too, as triangles.
#ifndef GridFEM_PolygonTriangles_h
#define GridFEM_PolygonTriangles_h

#include "Base/Types.h"

#include <vector>

namespace gridfem
{

using Triangle = std::array<Id, 3>;

/// A quadrilateral along the shorter diagonal, unless only the other one lies inside. Of larger
/// polygons the ear of the best shape is cut off until a triangle is left; one that is too
/// degenerate for it becomes a fan.
/// @param cell     the number of the polygon, for messages
/// @param corners  ids of three or more points, in order
/// @return  as many triangles as there are corners, less two
/// Throws InvalidInput when the polygon has so many corners that point inward that it would take
/// more than some seconds.
std::vector<Triangle> TrianglesOfPolygon(
  const std::vector<Vec3>& points, Id cell, const std::vector<Id>& corners);

} // namespace gridfem

#endif
