// The unique edges of a triangle mesh, and the numbers of the points where grid planes cut them.
// An edge is named by its two end points (after welding), so triangles on both sides of it agree on
// every cut point without searching.
#ifndef GridFEM_MeshEdges_h
#define GridFEM_MeshEdges_h

#include "Types.h"

#include <vector>

namespace gridfem
{

struct MeshEdges
{
  /// Per triangle: the edges from corner 0 to 1, 1 to 2, 2 to 0.
  std::vector<std::array<Id, 3>> ofTriangle;
  /// Ends of each edge, lower welded point id first.
  std::vector<std::array<Id, 2>> ends;
  /// Cut points of edge e are numbered cutBegin[e] .. cutBegin[e + 1): planes across x in ascending
  /// order, then y, then z.
  std::vector<Id> cutBegin;

  Id NumberOfCuts() const { return cutBegin.back(); }
};

/// First integer plane strictly above `low`, and how many lie strictly between the two values.
struct PlaneRange
{
  int first;
  int count;
};
PlaneRange PlanesBetween(double a, double b);

/// @param pointClass  welded id of each point
/// @param position    of each point, grid units, snapped to the planes
MeshEdges BuildMeshEdges(const std::vector<std::array<Id, 3>>& triangles,
  const std::vector<Id>& pointClass, const std::vector<Vec3>& position, int threads);

} // namespace gridfem

#endif
