// The unique edges of a triangle mesh, and the numbers of the points where grid planes cut them. An
// edge is identified by its two end points (after welding). The triangles on both sides of an edge
// therefore agree on every cut point without a search.
#ifndef GridFEM_MeshEdges_h
#define GridFEM_MeshEdges_h

#include "Base/Array.h"
#include "Base/Types.h"

#include <cmath>
#include <vector>

namespace gridfem
{

/// One triangle's side of an edge. The planes of the grid cut the edge at cut points, which divide
/// it into stretches. Stretch 0 begins at the lower end of the edge, stretch 1 + n at cut point n.
struct EdgeSide
{
  Index cut;     // number of the edge's first cut point; ~cut on every side but the first
  Index stretch; // place of this side's stretch 0; None on an edge without length

  static constexpr Index None = -1;
  bool IsFirst() const { return cut >= 0; }
  Index FirstCut() const { return this->IsFirst() ? cut : ~cut; }
};

/// An edge of more than two triangles. The stretches of its sides are stored side after side, from
/// place `begin` on.
struct ManySidedEdge
{
  Index begin;
  Index sides;
  Index stretches;
};

/// Edges are sorted by their lower end, then by their higher end. The cut points of an edge are
/// numbered consecutively: planes across x in ascending order, then y, then z.
struct MeshEdges
{
  /// The sides of each triangle: from corner 0 to 1, from 1 to 2, from 2 to 0.
  Array<std::array<EdgeSide, 3>> ofTriangle;
  Index numberOfCuts = 0;
  /// Number of pairs of places. Each stretch of an edge with one or two sides has a pair, and the
  /// pairs precede all other places.
  Index numberOfPairs = 0;
  Index numberOfPlaces = 0; // of the stretches of all sides
  Array<ManySidedEdge> manySided;

  /// Returns the distance between the places of two consecutive stretches of a side.
  Index StrideOf(const EdgeSide& side) const { return side.stretch < 2 * numberOfPairs ? 2 : 1; }
};

/// The first integer plane strictly above the lower of two values, and the number of integer planes
/// strictly between the two.
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

/// Finds the edges of a mesh. The result is the same for any number of threads. Throws InvalidInput
/// when there are more than 2^31 - 1 sides, cut points or stretches.
/// @param pointClass  welded id of each point
/// @param position    position of each point, grid units, snapped to the planes
MeshEdges BuildMeshEdges(const std::vector<std::array<Id, 3>>& triangles,
  const Array<Index>& pointClass, const Array<Vec3>& position, int threads);

} // namespace gridfem

#endif
