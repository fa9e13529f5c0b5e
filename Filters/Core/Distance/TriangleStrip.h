// A chain of triangles along a surface, and the shortest path within it.
#ifndef GridFEM_TriangleStrip_h
#define GridFEM_TriangleStrip_h

#include "Distance/PathGraph.h"
#include "Distance/StarRoute.h"

#include <vector>

namespace gridfem
{

/// Triangles from one place to another. Neighbors in the chain share an edge.
struct TriangleStrip
{
  Index from; // a corner of the first triangle
  Index to;   // a corner of the last triangle
  std::vector<Index> triangles;
  std::vector<Index> edges; // edges[k] is between triangles k and k + 1
};

/// Removes detours. A detour lies between two visits of the same triangle, or enters and leaves a
/// triangle by the same edge. At the ends, the strip then leaves its first place at once and stops
/// where it first reaches its last place. The shortest path within the strip never becomes longer,
/// because a triangle is flat.
void RemoveDetours(const PathGraph& graph, TriangleStrip& strip);

/// A point of a path.
struct PathPoint
{
  Index triangle; // holds the path from the point before; for the first point, to the next
  Vec3 weights;   // of the triangle's corners; at least 0, sum 1
};

/// A place within a strip where the shortest path turns. Strip triangles `first` to `last` meet
/// there.
struct StripBend
{
  Index place;
  Id first; // number within the strip; the path comes through this triangle, or along its edge
  Id last;  // the path leaves through this triangle, or along its edge
  StarDirection in;  // toward the path before the bend
  StarDirection out; // toward the path after it
};

/// The shortest path within a strip. The strip is unfolded into the plane, where a funnel of
/// visible points moves through it (Lee and Preparata 1984). Cost O(triangles).
class StripPath
{
public:
  /// @param strip  without detours
  StripPath(const PathGraph& graph, const TriangleStrip& strip);

  double Length() const { return length_; }

  std::vector<StripBend> Bends() const;

  /// The two ends, and the points where the path enters another triangle.
  std::vector<PathPoint> Points() const;

private:
  using Vec2 = Eigen::Vector2d;

  /// A corner of the strip, unfolded. The edges between triangles that end there are consecutive.
  struct Corner
  {
    Vec2 at = Vec2::Zero();
    Index place = -1;
    Id first = 0; // of the edges that end here
    Id last = 0;
    Id previous = 0; // corner of the shortest path to this one
  };

  Vec2 Unfolded(const Corner& left, const Corner& right, Index apex, double side) const;
  void Unfold();
  void RunFunnel();
  std::array<Id, 3> CornersOf(Id triangle) const;
  StarDirection DirectionAt(Id corner, Id triangle, Id toward) const;
  bool IsAtEdge(Id corner, Id edge) const
  {
    return left_[edge] == corner || right_[edge] == corner;
  }
  PathPoint PointAt(Id triangle, Index a, Index b, double share) const;
  double CrossingOf(Id edge, Id from, Id to) const;

  const PathGraph& graph_;
  const TriangleStrip& strip_;
  std::vector<Corner> corners_; // the start, both ends of the first edge, apex of every further one
  std::vector<Id> left_;        // per edge, the corner at its left end
  std::vector<Id> right_;
  std::vector<Id> path_; // corners from the start to the end
  double length_ = 0.0;
};

} // namespace gridfem

#endif
