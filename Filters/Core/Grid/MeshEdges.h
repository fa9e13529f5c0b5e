// The unique edges of a triangle mesh, and the numbers of the points where grid planes cut them.
// An edge is named by its two end points (after welding), so triangles on both sides of it agree on
// every cut point without searching.
#ifndef GridFEM_MeshEdges_h
#define GridFEM_MeshEdges_h

#include "Base/Array.h"
#include "Base/Types.h"

#include <cmath>
#include <vector>

namespace gridfem
{

/// One triangle's side of an edge. Planes of the grid cut the edge in cut points, which divide it
/// into stretches. Stretch 0 begins at the lower end of the edge, stretch 1 + n at cut point n.
struct EdgeSide
{
  Index cut;     // number of the edge's first cut point; ~cut on all sides but the first
  Index stretch; // number of this side's stretch 0; None on an edge without length

  static constexpr Index None = -1;
  bool IsFirst() const { return cut >= 0; }
  Index FirstCut() const { return this->IsFirst() ? cut : ~cut; }
};

/// An edge of more than two triangles. Its sides follow each other from `begin` on, each with its
/// stretches.
struct ManySidedEdge
{
  Index begin;
  Index sides;
  Index stretches;
};

/// Edges are in the order of their lower end, then of the higher one. Cut points of an edge are
/// numbered consecutively: planes across x in ascending order, then y, then z.
struct MeshEdges
{
  /// Per triangle: the sides from corner 0 to 1, 1 to 2, 2 to 0.
  Array<std::array<EdgeSide, 3>> ofTriangle;
  Index numberOfCuts = 0;
  /// Places of stretches begin with the pairs: one for each stretch of an edge with one or two
  /// sides.
  Index numberOfPairs = 0;
  Index numberOfPlaces = 0; // of stretches
  Array<ManySidedEdge> manySided;

  /// From one stretch of a side to the next.
  Index StrideOf(const EdgeSide& side) const { return side.stretch < 2 * numberOfPairs ? 2 : 1; }
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

/// The same for any number of threads. Throws InvalidInput when there are more than 2^31 - 1 sides,
/// cut points or stretches.
/// @param pointClass  welded id of each point
/// @param position    of each point, grid units, snapped to the planes
MeshEdges BuildMeshEdges(const std::vector<std::array<Id, 3>>& triangles,
  const Array<Index>& pointClass, const Array<Vec3>& position, int threads);

} // namespace gridfem

#endif
