#include "Distance/LineTracer.h"

#include "Base/Errors.h"

#include <algorithm>
#include <sstream>

namespace gridfem
{
namespace
{

std::string TextOf(const Vec3& position)
{
  std::ostringstream text;
  text << "(" << position[0] << ", " << position[1] << ", " << position[2] << ")";
  return text.str();
}

/// Barycentric weights of a point in a triangle.
Vec3 WeightsOf(const TriangleMesh& mesh, Id triangle, const Vec3& position)
{
  const auto& corner = mesh.triangles[triangle];
  const Vec3& origin = mesh.points[corner[0]];
  Eigen::Matrix<double, 3, 2> edges;
  edges << mesh.points[corner[1]] - origin, mesh.points[corner[2]] - origin;
  const Eigen::Vector2d share = edges.colPivHouseholderQr().solve(position - origin);
  const Vec3 weight = Vec3(1.0 - share.sum(), share[0], share[1]).cwiseMax(0.0);
  return weight / weight.sum();
}

} // namespace

LineTracer::LineTracer(const TriangleMesh& mesh, const EdgeGraph& graph, const Array<Index>& place,
  const NearestPlaces& nearest)
  : mesh_(mesh), graph_(graph), place_(place), nearest_(nearest),
    isCrossedFrom_(graph.NumberOfSides(), 0), isOnLine_(mesh.points.size(), 0)
{
  const Bounds bounds = BoundsOf(mesh.points, UsedPoints(mesh));
  resolution_ = 1e-7 * (bounds.high - bounds.low).norm();
  reach_ = 100.0 * resolution_;
}

/// Explores the triangles that can be reached over edges with mayCross, until isThere holds for
/// one. Returns this triangle, or -1, and the origin of each triangle reached.
template<class MayCross, class IsThere>
std::pair<Id, LineTracer::Origins> LineTracer::Explore(
  Id start, const MayCross& mayCross, const IsThere& isThere) const
{
  Origins origins = { { start, { start, EdgeGraph::None } } };
  std::vector<Id> reached = { start };
  for (std::size_t k = 0; k < reached.size(); ++k)
  {
    const Id from = reached[k];
    if (isThere(from))
    {
      return { from, origins };
    }
    for (const Index edge : graph_.EdgesOf(from))
    {
      if (edge != EdgeGraph::None && mayCross(edge))
      {
        graph_.ForSides(edge,
          [&](Index, Id next)
          {
            if (origins.emplace(next, Origin{ from, edge }).second)
            {
              reached.push_back(next);
            }
          });
      }
    }
  }
  return { -1, origins };
}

/// Crosses the edges on the shortest path over edges with mayCross to a triangle with isThere.
/// Returns false if there is no path.
template<class MayCross, class IsThere>
bool LineTracer::Walk(Id start, const MayCross& mayCross, const IsThere& isThere)
{
  const auto [end, origins] = this->Explore(start, mayCross, isThere);
  for (Id t = end; t >= 0 && t != start; t = origins.at(t).from)
  {
    this->Cross(origins.at(t).edge, origins.at(t).from, t);
  }
  return end >= 0;
}

void LineTracer::Follow(const std::vector<Vec3>& line)
{
  std::optional<SurfacePlace> at;
  Places last = nearest_(line.front(), reach_);
  for (std::size_t k = 1; k < line.size(); ++k)
  {
    Places next = nearest_(line[k], reach_);
    const std::vector<Piece> choices = this->ChoicesOf(last, next, at);
    const Id turn = this->TurnOf(line[k - 1], line[k], static_cast<Id>(choices.size()));
    if (turn >= 0)
    {
      const Piece& piece = choices[turn];
      const SurfacePlace begin = this->MovedToAnchor(piece.begin, last);
      if (!at || at->triangle != begin.triangle)
      {
        if (at)
        {
          ends_.push_back(*at);
        }
        ends_.push_back(begin);
      }
      this->Connect(piece.begin, line[k - 1], piece.end, line[k]);
      at = this->MovedToAnchor(piece.end, next);
    }
    last = std::move(next);
  }
  if (at)
  {
    ends_.push_back(*at);
  }
  ++line_;
}

void LineTracer::LeaveAtBorders()
{
  std::vector<SurfacePlace> within;
  std::copy_if(ends_.begin(), ends_.end(), std::back_inserter(within),
    [&](const SurfacePlace& end) { return !this->LeaveOnBorder(end); });
  for (const SurfacePlace& end : within)
  {
    if (this->IsOdd(end.triangle))
    {
      this->Leave(end);
    }
  }
}

void LineTracer::RequireNoEnds() const
{
  for (Id t = 0; t < static_cast<Id>(mesh_.triangles.size()); ++t)
  {
    if (this->IsOdd(t))
    {
      throw InvalidInput("A line ends, or three lines meet, within the surface near " +
                         TextOf(this->CenterOf(t)) +
                         ", so it encloses nothing. Close it, or lead it to the border.");
    }
  }
}

void LineTracer::RequireClosed(const std::vector<char>& isDivided) const
{
  std::map<std::array<double, 3>, std::pair<Id, int>> ends; // a triangle, and the number of ends
  for (const SurfacePlace& end : ends_)
  {
    const Vec3& at = end.position;
    auto& [triangle, count] = ends[{ at[0], at[1], at[2] }];
    triangle = end.triangle;
    ++count;
  }
  for (const auto& [at, end] : ends)
  {
    if (end.second % 2 == 1 && !isDivided[place_[mesh_.triangles[end.first][0]]])
    {
      throw InvalidInput("A line within a triangle near " + TextOf(Vec3(at[0], at[1], at[2])) +
                         " is not closed, so it encloses nothing. Close it, or lead it to the "
                         "border.");
    }
  }
}

std::vector<char> LineTracer::Crossed() const
{
  std::vector<char> crossed(graph_.Count());
  for (Index edge = 0; edge < graph_.Count(); ++edge)
  {
    crossed[edge] = this->IsCrossed(edge) ? 1 : 0;
  }
  return crossed;
}

Vec3 LineTracer::CenterOf(Id triangle) const
{
  const auto& corner = mesh_.triangles[triangle];
  return (mesh_.points[corner[0]] + mesh_.points[corner[1]] + mesh_.points[corner[2]]) / 3.0;
}

bool LineTracer::IsOdd(Id triangle) const
{
  int crossings = 0;
  for (const Index edge : graph_.EdgesOf(triangle))
  {
    crossings += edge != EdgeGraph::None && this->IsCrossed(edge) ? 1 : 0;
  }
  return crossings % 2 == 1;
}

/// Whether an edge is crossed from any of its triangles. If more than two triangles meet at an
/// edge, a line in each of them may end there.
bool LineTracer::IsCrossed(Index edge) const
{
  bool isCrossed = false;
  graph_.ForSides(edge, [&](Index side, Id) { isCrossed = isCrossed || isCrossedFrom_[side]; });
  return isCrossed;
}

void LineTracer::Cross(Index edge, Id from, Id to)
{
  graph_.ForSides(edge, [&](Index side, Id triangle)
    { isCrossedFrom_[side] ^= triangle == from || triangle == to ? 1 : 0; });
}

/// The possible pieces between two points of a line. Triangles that the piece crosses from edge to
/// edge come first. If there are none, the piece is in one triangle that has both points. If there
/// is none either, it leads from one triangle to another.
/// @param at  the place that the line has reached; its part of the surface goes first
std::vector<LineTracer::Piece> LineTracer::ChoicesOf(
  const Places& from, const Places& to, const std::optional<SurfacePlace>& at) const
{
  std::vector<Piece> within;
  std::vector<Piece> across;
  for (const SurfacePlace& begin : from)
  {
    for (const SurfacePlace& end : to)
    {
      if (begin.triangle == end.triangle)
      {
        within.push_back({ begin, end });
        if (this->IsAtEdge(begin.triangle, from) && this->IsAtEdge(end.triangle, to))
        {
          across.push_back({ begin, end });
        }
      }
    }
  }
  std::vector<Piece>& choices = !across.empty() ? across : within;
  if (choices.empty())
  {
    for (const SurfacePlace& begin : from)
    {
      choices.push_back({ begin, to.front() });
    }
  }
  if (choices.size() > 1)
  {
    const auto rankOf = [&](const Piece& piece)
    {
      const bool isElsewhere = at && this->AnchorOf(piece.begin.triangle, from) != at->triangle;
      return std::pair(isElsewhere, across.empty() ? 0 : piece.begin.triangle);
    };
    std::stable_sort(choices.begin(), choices.end(),
      [&](const Piece& a, const Piece& b) { return rankOf(a) < rankOf(b); });
  }
  if (across.empty())
  {
    choices.resize(1);
  }
  return choices;
}

/// The choice for a piece that may have occurred before; -1 if another line has taken them all.
Id LineTracer::TurnOf(const Vec3& from, const Vec3& to, Id choices)
{
  std::array<double, 6> key = { from[0], from[1], from[2], to[0], to[1], to[2] };
  const std::array<double, 6> back = { to[0], to[1], to[2], from[0], from[1], from[2] };
  key = std::min(key, back);
  const auto [found, isNew] = seen_.try_emplace(key, Repeated{ 0, line_ });
  Repeated& seen = found->second;
  const bool isOfOther = !isNew && seen.line != line_;
  const Id turn = seen.count++;
  seen.line = line_;
  return turn < choices ? turn : isOfOther ? -1 : turn % choices;
}

bool LineTracer::IsAtEdge(Id triangle, const Places& places) const
{
  const auto& edges = graph_.EdgesOf(triangle);
  return std::any_of(edges.begin(), edges.end(),
    [&](Index edge) { return this->IsNear(edge, places.front().position); });
}

/// The first triangle that can be reached over edges at these places. Lines in all of these
/// triangles meet there.
Id LineTracer::AnchorOf(Id triangle, const Places& places) const
{
  Id first = triangle;
  this->Explore(
    triangle, [&](Index edge) { return this->IsNear(edge, places.front().position); },
    [&](Id reached)
    {
      first = std::min(first, reached);
      return false;
    });
  return first;
}

SurfacePlace LineTracer::MovedToAnchor(const SurfacePlace& place, const Places& places)
{
  const Id anchor = this->AnchorOf(place.triangle, places);
  this->Walk(
    place.triangle, [&](Index edge) { return this->IsNear(edge, places.front().position); },
    [&](Id triangle) { return triangle == anchor; });
  return { anchor, places.front().position };
}

/// The place nearest to a point between two others, preferably in one of their triangles or next to
/// one.
SurfacePlace LineTracer::PlaceBetween(
  const Vec3& middle, const SurfacePlace& a, const SurfacePlace& b) const
{
  const Places places = nearest_(middle, reach_);
  const auto isIn = [&](const SurfacePlace& place)
  { return place.triangle == a.triangle || place.triangle == b.triangle; };
  const auto isBeside = [&](const SurfacePlace& place)
  {
    return graph_.EdgeBetween(place.triangle, a.triangle) != EdgeGraph::None ||
           graph_.EdgeBetween(place.triangle, b.triangle) != EdgeGraph::None;
  };
  auto found = std::find_if(places.begin(), places.end(), isIn);
  found = found != places.end() ? found : std::find_if(places.begin(), places.end(), isBeside);
  return found != places.end() ? *found : places.front();
}

/// Connects two places by halving the path, until its ends are in one triangle or in neighbors.
void LineTracer::Connect(
  const SurfacePlace& a, const Vec3& fromA, const SurfacePlace& b, const Vec3& fromB)
{
  if (a.triangle == b.triangle)
  {
    this->Append(a.triangle, a.position, b.position);
    return;
  }
  const Index edge = graph_.EdgeBetween(a.triangle, b.triangle);
  if (edge != EdgeGraph::None)
  {
    const Vec3 crossing = this->CrossingOf(edge, a.position, b.position);
    this->Cross(edge, a.triangle, b.triangle);
    this->Append(a.triangle, a.position, crossing);
    this->Append(b.triangle, crossing, b.position);
    return;
  }
  const Vec3 middle = 0.5 * (fromA + fromB);
  if ((fromA - fromB).norm() <= resolution_ || middle == fromA || middle == fromB)
  {
    this->WalkAround(a, b);
    return;
  }
  const SurfacePlace half = this->PlaceBetween(middle, a, b);
  this->Connect(a, fromA, half, middle);
  this->Connect(half, middle, b, fromB);
}

void LineTracer::Append(Id triangle, const Vec3& from, const Vec3& to)
{
  if (from == to)
  {
    return;
  }
  segments.push_back(
    { triangle, WeightsOf(mesh_, triangle, from), WeightsOf(mesh_, triangle, to) });
  for (const Id corner : mesh_.triangles[triangle])
  {
    const Vec3& there = mesh_.points[corner];
    if ((from - there).norm() <= reach_ || (to - there).norm() <= reach_)
    {
      isOnLine_[place_[corner]] = 1;
    }
  }
}

/// The point where the shortest path between two points crosses an edge.
Vec3 LineTracer::CrossingOf(Index edge, const Vec3& a, const Vec3& b) const
{
  const Vec3& low = mesh_.points[graph_.Low(edge)];
  const Vec3 along = mesh_.points[graph_.High(edge)] - low;
  const double square = along.squaredNorm();
  const double footA = (a - low).dot(along) / square;
  const double footB = (b - low).dot(along) / square;
  const double heightA = (a - low - footA * along).norm();
  const double heightB = (b - low - footB * along).norm();
  const double heights = heightA + heightB;
  const double t =
    heights > 0.0 ? (footA * heightB + footB * heightA) / heights : 0.5 * (footA + footB);
  return low + std::clamp(t, 0.0, 1.0) * along;
}

/// Walks from triangle to triangle where a line passes through a point of the mesh.
void LineTracer::WalkAround(const SurfacePlace& a, const SurfacePlace& b)
{
  const bool arrives = this->Walk(
    a.triangle,
    [&](Index edge) { return this->IsNear(edge, a.position) || this->IsNear(edge, b.position); },
    [&](Id triangle) { return triangle == b.triangle; });
  if (!arrives)
  {
    throw InvalidInput("A line jumps from one part of the surface to another near " +
                       TextOf(a.position) +
                       ". Its points have to be closer to the surface, or closer to each "
                       "other.");
  }
}

double LineTracer::DistanceFrom(Index edge, const Vec3& position) const
{
  return (position - this->CrossingOf(edge, position, position)).norm();
}

/// Whether an edge of a triangle is within reach of a position.
bool LineTracer::IsNear(Index edge, const Vec3& position) const
{
  return edge != EdgeGraph::None && this->DistanceFrom(edge, position) <= reach_;
}

/// Leaves the surface over the nearest border edge of the triangle, or else around its nearest
/// corner to a border edge.
void LineTracer::Leave(const SurfacePlace& end)
{
  Index leaving = this->NearestBorderEdge(end.triangle, end.position);
  if (leaving == EdgeGraph::None)
  {
    const Index corner = this->NearestCorner(end);
    const auto touches = [&](Index edge)
    { return graph_.Low(edge) == corner || graph_.High(edge) == corner; };
    this->Walk(end.triangle, touches,
      [&](Id triangle)
      {
        const Index edge = this->NearestBorderEdge(triangle, mesh_.points[corner]);
        leaving = edge != EdgeGraph::None && touches(edge) ? edge : EdgeGraph::None;
        return leaving != EdgeGraph::None;
      });
  }
  this->CrossBorder(leaving);
}

/// Leaves the surface if a line ends on the border, and returns whether it does. Two ends in one
/// place leave it and come back.
bool LineTracer::LeaveOnBorder(const SurfacePlace& end)
{
  Index leaving = EdgeGraph::None;
  const auto isNear = [&](Index edge) { return this->IsNear(edge, end.position); };
  this->Walk(end.triangle, isNear,
    [&](Id triangle)
    {
      const Index edge = this->NearestBorderEdge(triangle, end.position);
      leaving = isNear(edge) ? edge : EdgeGraph::None;
      return leaving != EdgeGraph::None;
    });
  this->CrossBorder(leaving);
  return leaving != EdgeGraph::None;
}

void LineTracer::CrossBorder(Index edge)
{
  if (edge != EdgeGraph::None)
  {
    graph_.ForSides(edge, [&](Index side, Id) { isCrossedFrom_[side] ^= 1; });
  }
}

Index LineTracer::NearestBorderEdge(Id triangle, const Vec3& position) const
{
  Index nearest = EdgeGraph::None;
  for (const Index edge : graph_.EdgesOf(triangle))
  {
    if (edge != EdgeGraph::None && graph_.IsBorder(edge) &&
        (nearest == EdgeGraph::None ||
          this->DistanceFrom(edge, position) < this->DistanceFrom(nearest, position)))
    {
      nearest = edge;
    }
  }
  return nearest;
}

/// The place of the nearest corner.
Index LineTracer::NearestCorner(const SurfacePlace& end) const
{
  Index nearest = EdgeGraph::None;
  for (const Index edge : graph_.EdgesOf(end.triangle))
  {
    for (const Index corner : { graph_.Low(edge), graph_.High(edge) })
    {
      if (nearest == EdgeGraph::None || (mesh_.points[corner] - end.position).norm() <
                                          (mesh_.points[nearest] - end.position).norm())
      {
        nearest = corner;
      }
    }
  }
  return nearest;
}

} // namespace gridfem
