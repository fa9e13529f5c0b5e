// Lines in space as segments of the triangles of a surface, and the edges that they cross.
#ifndef GridFEM_LineTracer_h
#define GridFEM_LineTracer_h

#include "Distance/EdgeGraph.h"
#include "Distance/SurfaceCurve.h"

#include <array>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace gridfem
{

/// Follows lines as DivideByLines describes, and counts how often they cross each edge. Keeps
/// references.
class LineTracer
{
public:
  LineTracer(const TriangleMesh& mesh, const EdgeGraph& graph, const Array<Index>& place,
    const NearestPlaces& nearest);

  /// Adds a line. Throws InvalidInput if it jumps from one part of the surface to another.
  /// @param line  at least one point
  void Follow(const std::vector<Vec3>& line);

  /// Lets lines that end on the border of the surface, or in triangles next to it, leave the
  /// surface there.
  void LeaveAtBorders();

  /// Throws InvalidInput if a line ends, or three lines meet, within the surface.
  void RequireNoEnds() const;

  /// Throws InvalidInput for a line within a triangle that is not closed. It checks the components
  /// that no line divides.
  /// @param isDivided  per place
  void RequireClosed(const std::vector<char>& isDivided) const;

  /// Whether each edge is crossed an odd number of times.
  std::vector<char> Crossed() const;

  /// Whether a line passes through each place.
  const std::vector<char>& IsOnLine() const { return isOnLine_; }

  std::vector<TriangleSegment> segments;

private:
  using Places = std::vector<SurfacePlace>;

  /// The part of a line from one point to the next.
  struct Piece
  {
    SurfacePlace begin;
    SurfacePlace end;
  };

  struct Origin
  {
    Id from;
    Index edge;
  };
  using Origins = std::unordered_map<Id, Origin>;

  struct Repeated
  {
    Id count;
    Id line; // the last line that contains it
  };

  Vec3 CenterOf(Id triangle) const;
  bool IsOdd(Id triangle) const;
  bool IsCrossed(Index edge) const;
  void Cross(Index edge, Id from, Id to);
  std::vector<Piece> ChoicesOf(
    const Places& from, const Places& to, const std::optional<SurfacePlace>& at) const;
  Id TurnOf(const Vec3& from, const Vec3& to, Id choices);
  bool IsAtEdge(Id triangle, const Places& places) const;
  Id AnchorOf(Id triangle, const Places& places) const;
  SurfacePlace MovedToAnchor(const SurfacePlace& place, const Places& places);
  SurfacePlace PlaceBetween(const Vec3& middle, const SurfacePlace& a, const SurfacePlace& b) const;
  void Connect(const SurfacePlace& a, const Vec3& fromA, const SurfacePlace& b, const Vec3& fromB);
  void Append(Id triangle, const Vec3& from, const Vec3& to);
  Vec3 CrossingOf(Index edge, const Vec3& a, const Vec3& b) const;
  void WalkAround(const SurfacePlace& a, const SurfacePlace& b);
  template<class MayCross, class IsThere>
  std::pair<Id, Origins> Explore(Id start, const MayCross& mayCross, const IsThere& isThere) const;
  template<class MayCross, class IsThere>
  bool Walk(Id start, const MayCross& mayCross, const IsThere& isThere);
  double DistanceFrom(Index edge, const Vec3& position) const;
  bool IsNear(Index edge, const Vec3& position) const;
  void Leave(const SurfacePlace& end);
  bool LeaveOnBorder(const SurfacePlace& end);
  void CrossBorder(Index edge);
  Index NearestBorderEdge(Id triangle, const Vec3& position) const;
  Index NearestCorner(const SurfacePlace& end) const;

  const TriangleMesh& mesh_;
  const EdgeGraph& graph_;
  const Array<Index>& place_;
  const NearestPlaces& nearest_;
  std::vector<char> isCrossedFrom_; // per side of an edge: crossed from its triangle
  std::vector<char> isOnLine_;
  std::map<std::array<double, 6>, Repeated> seen_;
  std::vector<SurfacePlace> ends_;
  Id line_ = 0;
  double resolution_;
  double reach_; // distance within which a line touches a place or an edge
};

} // namespace gridfem

#endif
