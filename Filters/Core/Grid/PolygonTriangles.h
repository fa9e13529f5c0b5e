// Splits polygons with any number of corners into triangles. The polygons may be concave.
#ifndef GridFEM_PolygonTriangles_h
#define GridFEM_PolygonTriangles_h

#include "Base/Types.h"

#include <vector>

namespace gridfem
{

using Triangle = std::array<Id, 3>;

/// Splits a polygon into triangles. A quadrilateral is split along its shorter diagonal, unless
/// only the other one lies inside. From a larger polygon, the ear with the best shape is cut off
/// until a triangle is left. A polygon too degenerate for this becomes a fan.
/// @param cell     number of the polygon, for messages
/// @param corners  ids of at least three points, in order
/// @return  two triangles fewer than there are corners
/// Throws InvalidInput if the polygon has so many inward-pointing corners that it would take more
/// than a few seconds.
std::vector<Triangle> TrianglesOfPolygon(
  const std::vector<Vec3>& points, Id cell, const std::vector<Id>& corners);

} // namespace gridfem

#endif
