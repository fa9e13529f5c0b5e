// Closes the seams of a surface in place, so that everything that looks for shared edges finds
// them.
#ifndef GridFEM_JoinSeams_h
#define GridFEM_JoinSeams_h

#include "Grid/Seams.h"

namespace gridfem
{

/// A point that stands at the place of another point of the mesh.
struct MovedPoint
{
  Id point;
  Id twin;
};

/// What JoinSeams changed.
struct JoinedSeams
{
  std::vector<MovedPoint> moved; // ascending by point
  /// The triangle that each triangle is, or is a part of; ascending. Empty if none was divided.
  std::vector<Id> sourceTriangle;
};

/// Gives points that coincide except for rounding the same coordinates, and divides triangles at
/// the hanging nodes on their sides (see FindSeams). The points keep their numbers, and the
/// triangles their order. The result is the same for any number of threads. A closed surface stays
/// as it is. Throws InvalidInput (see Validate).
JoinedSeams JoinSeams(TriangleMesh& mesh, int threads = 0);

/// Moves the points of a mesh that has some of the places, and returns which moved. The twin of a
/// point is the point itself if the mesh has no other point there.
std::vector<MovedPoint> MovePoints(
  const std::vector<Seams::Move>& moves, TriangleMesh& mesh, int threads = 0);

} // namespace gridfem

#endif
