// Finds where open edges of a surface lie on each other: seams whose points coincide except for
// rounding, and hanging nodes. Only open edges are searched.
//
// Two ends of open edges count as one if their distance is at most SeamTolerance times the longest
// side of the surface's bounding box. Points that went through single precision, about 1e-7 of the
// box, are thus one. The distance is also at most SeamShare times the shortest side of a triangle
// at either point. A fold or a thin strip that the mesh resolves is therefore never closed.
#ifndef GridFEM_Seams_h
#define GridFEM_Seams_h

#include "Grid/OpenEdges.h"

namespace gridfem
{

inline constexpr double SeamTolerance = 1e-6;
inline constexpr double SeamShare = 1e-3;

/// What closes the seams of a surface. Places are exact coordinates of its points.
struct Seams
{
  /// Points at a place that move to the place of another end of an open edge.
  struct Move
  {
    Place from;
    Place to;
  };

  /// An edge that other open edges share in part. Its nodes, in order from its first end to its
  /// second, are the ends of these edges.
  struct Division
  {
    OpenEdge ends;
    std::vector<Place> nodes; // at least one
  };

  std::vector<Move> moves;         // ascending by `from`
  std::vector<Division> divisions; // ascending by `ends`, after the moves
};

/// Finds the seams among open edges. The result depends on the surface alone.
/// @param open         as from FindOpenEdges
/// @param shortest     shortest sides at the ends of these edges (NumberEnds, ShortestSides)
/// @param longestSide  of the bounding box of the surface
Seams FindSeams(const std::vector<OpenEdge>& open, const std::vector<double>& shortest,
  double longestSide, int threads = 0);

} // namespace gridfem

#endif
