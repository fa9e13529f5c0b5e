// Polygons of any number of corners, concave ones too, as triangles.
#ifndef GridFEM_PolygonTriangles_h
#define GridFEM_PolygonTriangles_h

#include "Base/Types.h"

#include <vector>

namespace gridfem
{

using Triangle = std::array<Id, 3>;

/// Along the shorter diagonal, unless only the other one lies inside.
/// @param q  ids of the four corners, in order
std::array<Triangle, 2> TrianglesOfQuad(const std::vector<Vec3>& points, const Id* q);

/// Cuts off the ear of the best shape until a triangle is left, and a fan where the polygon is too
/// degenerate for it.
/// @param cell     the number of the polygon, for messages
/// @param corners  ids of three or more points, in order
/// @return  as many triangles as there are corners, less two
/// Throws InvalidInput when the polygon has so many corners that point inward that it would take
/// more than some seconds.
std::vector<Triangle> TrianglesOfPolygon(
  const std::vector<Vec3>& points, Id cell, const std::vector<Id>& corners);

} // namespace gridfem

#endif
