// The unique edges of a triangle mesh, and the numbers of the points where grid planes cut them.
// An edge is named by its two end points (after welding), so triangles on both sides of it agree on
// every cut point without searching.
#ifndef GridFEM_MeshEdges_h
#define GridFEM_MeshEdges_h

#include "Array.h"
#include "Types.h"

#include <cmath>
#include <vector>

namespace gridfem
{

struct MeshEdges
{
  /// Per triangle: the edges from corner 0 to 1, 1 to 2, 2 to 0.
  Array<std::array<Index, 3>> ofTriangle;
  /// Ends of each edge, lower welded point id first.
  Array<std::array<Index, 2>> ends;
  /// Cut points of edge e are numbered cutBegin[e] .. cutBegin[e + 1): planes across x in ascending
  /// order, then y, then z.
  Array<Index> cutBegin;
  /// The sides of edge e are side[sideBegin[e] .. sideBegin[e + 1]), ascending: 3 triangle + k for
  /// the triangle's k-th edge.
  Array<Index> sideBegin;
  Array<Index> side;

  Index NumberOfEdges() const { return static_cast<Index>(ends.size()); }
  Index NumberOfCuts() const { return cutBegin.back(); }
};

/// First integer plane strictly above the lower value, and how many lie strictly between the two.
struct PlaneRange
{
  int first;
  int count;
};

inline PlaneRange PlanesBetween(double a, double b)
{
  const int first = static_cast<int>(std::floor(a < b ? a : b)) + 1;
  const int last = static_cast<int>(std::ceil(a < b ? b : a)) - 1;
  return { first, last < first ? 0 : last - first + 1 };
}

/// Edges are sorted by their lower end, then by the higher one: the same for any number of threads.
/// Throws InvalidInput when there are more than 2^31 - 1 sides or cut points.
/// @param pointClass  welded id of each point
/// @param position    of each point, grid units, snapped to the planes
MeshEdges BuildMeshEdges(const std::vector<std::array<Id, 3>>& triangles,
  const Array<Index>& pointClass, const Array<Vec3>& position, int threads);

} // namespace gridfem

#endif
