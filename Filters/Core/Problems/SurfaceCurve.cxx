#include "Problems/SurfaceCurve.h"

#include "Base/Errors.h"
#include "Base/Grouping.h"
#include "Grid/TriangleArea.h"
#include "Grid/TriangleSides.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <unordered_map>

namespace gridfem
{
namespace
{

Array<Index> PlacesOf(const TriangleMesh& mesh, bool weld)
{
  if (weld)
  {
    return WeldCoincidentPoints(mesh.points, UsedPoints(mesh));
  }
  Array<Index> place(static_cast<Id>(mesh.points.size()));
  std::iota(place.begin(), place.end(), Index{ 0 });
  return place;
}

std::string TextOf(const Vec3& position)
{
  std::ostringstream text;
  text << "(" << position[0] << ", " << position[1] << ", " << position[2] << ")";
  return text.str();
}

//--------------------------------------------------------------------------------------------------
// Regions.

/// Per place: -1 where all that meets there is inside, 1 where all is outside, 0 where both are.
std::vector<signed char> SidesOfPlaces(
  const TriangleMesh& mesh, const Field& isInside, const Array<Index>& place)
{
  constexpr signed char Unseen = 2;
  std::vector<signed char> side(mesh.points.size(), Unseen);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const auto& corner = mesh.triangles[t];
    const auto rows = isInside.RowsOf(static_cast<Id>(t), corner);
    for (int k = 0; k < 3; ++k)
    {
      const signed char own = isInside.values(rows[k], 0) != 0.0 ? -1 : 1;
      signed char& there = side[place[corner[k]]];
      there = there == Unseen || there == own ? own : 0;
    }
  }
  std::replace(side.begin(), side.end(), Unseen, static_cast<signed char>(1));
  return side;
}

/// Half way along the edges from inside to outside, and through corners that are both.
void CutTriangle(
  Id triangle, const std::array<signed char, 3>& side, std::vector<TriangleSegment>& segments)
{
  std::vector<Vec3> ends;
  for (int k = 0; k < 3; ++k)
  {
    if (side[k] == 0)
    {
      ends.push_back(Vec3::Unit(k));
    }
    else if (side[k] * side[(k + 1) % 3] < 0)
    {
      ends.push_back(0.5 * (Vec3::Unit(k) + Vec3::Unit((k + 1) % 3)));
    }
  }
  const bool hasInside = std::count(side.begin(), side.end(), -1) > 0; // an edge is cut once
  if (ends.size() == 2 && hasInside)
  {
    segments.push_back({ triangle, ends[0], ends[1] });
  }
}

std::vector<TriangleSegment> CutTriangles(
  const TriangleMesh& mesh, const std::vector<signed char>& sideOfPlace, const Array<Index>& place)
{
  std::vector<TriangleSegment> segments;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    std::array<signed char, 3> side;
    for (int k = 0; k < 3; ++k)
    {
      side[k] = sideOfPlace[place[mesh.triangles[t][k]]];
    }
    CutTriangle(static_cast<Id>(t), side, segments);
  }
  return segments;
}

/// Of triangles: the edges between those inside and those outside.
std::vector<TriangleSegment> EdgesBetween(
  const TriangleMesh& mesh, const Field& isInside, const Array<Index>& place)
{
  std::vector<TriangleEdge> edges;
  ForEachEdge(SortedSides(mesh, place),
    [&](const TriangleSide* side, Id count)
    {
      const auto inside = std::count_if(side, side + count,
        [&](const TriangleSide& own) { return isInside.values(own.edge.triangle, 0) != 0.0; });
      if (inside > 0 && inside < count)
      {
        edges.push_back(side->edge);
      }
    });
  return SegmentsOf(edges, mesh);
}

//--------------------------------------------------------------------------------------------------
// Lines.

/// Edges of the mesh between places, and the triangles on them.
class EdgeGraph
{
public:
  static constexpr Index None = -1;

  EdgeGraph(const TriangleMesh& mesh, const Array<Index>& place)
    : sides_(SortedSides(mesh, place)), edgeOf_(mesh.triangles.size(), { None, None, None })
  {
    ForEachEdge(sides_,
      [&](const TriangleSide* side, Id count)
      {
        for (Id k = 0; k < count; ++k)
        {
          edgeOf_[side[k].edge.triangle][side[k].edge.corner] = static_cast<Index>(begin_.size());
        }
        begin_.push_back(static_cast<Index>(side - sides_.data()));
      });
    begin_.push_back(static_cast<Index>(sides_.size()));
  }

  Index Count() const { return static_cast<Index>(begin_.size()) - 1; }

  /// Of a triangle: from each corner to the next; None on one with equal corners.
  const std::array<Index, 3>& EdgesOf(Id triangle) const { return edgeOf_[triangle]; }

  Index Low(Index edge) const { return sides_[begin_[edge]].low; }
  Index High(Index edge) const { return sides_[begin_[edge]].high; }
  bool IsBorder(Index edge) const { return begin_[edge + 1] - begin_[edge] == 1; }

  template<class Body>
  void ForTriangles(Index edge, Body&& body) const
  {
    for (Index k = begin_[edge]; k < begin_[edge + 1]; ++k)
    {
      body(sides_[k].edge.triangle);
    }
  }

  /// None where they share no edge.
  Index EdgeBetween(Id a, Id b) const
  {
    for (const Index edge : edgeOf_[a])
    {
      if (edge != None && std::count(edgeOf_[b].begin(), edgeOf_[b].end(), edge) > 0)
      {
        return edge;
      }
    }
    return None;
  }

private:
  std::vector<TriangleSide> sides_;
  std::vector<std::array<Index, 3>> edgeOf_;
  std::vector<Index> begin_; // sides of each edge
};

/// Weights of the corners of a triangle for a point in it.
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

/// Lines as segments of triangles, and how often they cross each edge.
class Tracer
{
public:
  Tracer(const TriangleMesh& mesh, const EdgeGraph& graph, const NearestPlace& nearest)
    : mesh_(mesh), graph_(graph), nearest_(nearest), isCrossed_(graph.Count(), 0)
  {
    const Bounds bounds = BoundsOf(mesh.points, UsedPoints(mesh));
    resolution_ = 1e-7 * (bounds.high - bounds.low).norm();
  }

  void Follow(const std::vector<Vec3>& line)
  {
    SurfacePlace last = nearest_(line.front());
    ends_.push_back(last);
    for (std::size_t k = 1; k < line.size(); ++k)
    {
      const SurfacePlace next = nearest_(line[k]);
      this->Connect(last, line[k - 1], next, line[k]);
      last = next;
    }
    ends_.push_back(last);
  }

  /// Lines that end in triangles at the border of the surface leave it there.
  void LeaveAtBorders()
  {
    for (const SurfacePlace& end : ends_)
    {
      if (this->IsOdd(end.triangle))
      {
        this->Leave(end);
      }
    }
  }

  void RequireNoEnds() const
  {
    for (Id t = 0; t < static_cast<Id>(mesh_.triangles.size()); ++t)
    {
      if (this->IsOdd(t))
      {
        throw InvalidInput("A line ends, or three meet, within the surface near " +
                           TextOf(this->CentreOf(t)) +
                           ": no side of it is inside. Close it, or lead it to the border.");
      }
    }
  }

  /// Per edge.
  const std::vector<char>& Crossed() const { return isCrossed_; }

  std::vector<TriangleSegment> segments;

private:
  Vec3 CentreOf(Id triangle) const
  {
    const auto& corner = mesh_.triangles[triangle];
    return (mesh_.points[corner[0]] + mesh_.points[corner[1]] + mesh_.points[corner[2]]) / 3.0;
  }

  bool IsOdd(Id triangle) const
  {
    int crossings = 0;
    for (const Index edge : graph_.EdgesOf(triangle))
    {
      crossings += edge != EdgeGraph::None ? isCrossed_[edge] : 0;
    }
    return crossings % 2 == 1;
  }

  void Cross(Index edge) { isCrossed_[edge] ^= 1; }

  /// Halves the way until its ends are in one triangle or in neighbours.
  void Connect(const SurfacePlace& a, const Vec3& fromA, const SurfacePlace& b, const Vec3& fromB)
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
      this->Cross(edge);
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
    const SurfacePlace half = nearest_(middle);
    this->Connect(a, fromA, half, middle);
    this->Connect(half, middle, b, fromB);
  }

  void Append(Id triangle, const Vec3& from, const Vec3& to)
  {
    if (from != to)
    {
      segments.push_back(
        { triangle, WeightsOf(mesh_, triangle, from), WeightsOf(mesh_, triangle, to) });
    }
  }

  /// The shortest way over the edge.
  Vec3 CrossingOf(Index edge, const Vec3& a, const Vec3& b) const
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

  /// From triangle to triangle where a line goes through a point of the mesh.
  void WalkAround(const SurfacePlace& a, const SurfacePlace& b)
  {
    const bool arrives = this->Walk(
      a.triangle, [&](Index edge) { return this->IsNear(edge, a.position); },
      [&](Id triangle) { return triangle == b.triangle; });
    if (!arrives)
    {
      throw InvalidInput("A line jumps from one part of the surface to another near " +
                         TextOf(a.position) +
                         ": its points have to lie nearer to the surface, or nearer to each "
                         "other.");
    }
  }

  /// Crosses the edges on the shortest way over such edges to such a triangle, if there is one.
  template<class MayCross, class IsThere>
  bool Walk(Id start, const MayCross& mayCross, const IsThere& isThere)
  {
    struct Origin
    {
      Id from;
      Index edge;
    };
    std::unordered_map<Id, Origin> origins = { { start, { start, EdgeGraph::None } } };
    std::vector<Id> reached = { start };
    for (std::size_t k = 0; k < reached.size(); ++k)
    {
      const Id from = reached[k];
      if (isThere(from))
      {
        for (Id t = from; t != start; t = origins[t].from)
        {
          this->Cross(origins[t].edge);
        }
        return true;
      }
      for (const Index edge : graph_.EdgesOf(from))
      {
        if (edge != EdgeGraph::None && mayCross(edge))
        {
          graph_.ForTriangles(edge,
            [&](Id next)
            {
              if (origins.emplace(next, Origin{ from, edge }).second)
              {
                reached.push_back(next);
              }
            });
        }
      }
    }
    return false;
  }

  double DistanceFrom(Index edge, const Vec3& position) const
  {
    return (position - this->CrossingOf(edge, position, position)).norm();
  }

  /// An edge of a triangle that a line goes through within its resolution.
  bool IsNear(Index edge, const Vec3& position) const
  {
    return this->DistanceFrom(edge, position) <= 100.0 * resolution_;
  }

  /// Over the nearest border edge of its triangle, else around the nearest corner to one.
  void Leave(const SurfacePlace& end)
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
    if (leaving != EdgeGraph::None)
    {
      this->Cross(leaving);
    }
  }

  Index NearestBorderEdge(Id triangle, const Vec3& position) const
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

  /// Its place.
  Index NearestCorner(const SurfacePlace& end) const
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

  const TriangleMesh& mesh_;
  const EdgeGraph& graph_;
  const NearestPlace& nearest_;
  std::vector<char> isCrossed_;
  std::vector<SurfacePlace> ends_;
  double resolution_;
};

/// Spreads sides over the surface; they change across edges that are crossed.
class SideFinder
{
public:
  SideFinder(const TriangleMesh& mesh, const EdgeGraph& graph, const std::vector<char>& isCrossed,
    const Array<Index>& place)
    : graph_(graph), isCrossed_(isCrossed), side_(mesh.points.size(), 0)
  {
    std::vector<Index> end;
    for (Index edge = 0; edge < graph.Count(); ++edge)
    {
      end.push_back(graph.Low(edge));
      end.push_back(graph.High(edge));
    }
    ends_ =
      GroupItems(end.data(), static_cast<Id>(end.size()), static_cast<Id>(mesh.points.size()));
    area_.assign(mesh.points.size(), 0.0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    {
      for (const Id point : mesh.triangles[t])
      {
        area_[place[point]] += AreaOf(mesh, static_cast<Id>(t)) / 3.0;
      }
    }
  }

  /// Per place.
  const std::vector<signed char>& Find()
  {
    for (Index start = 0; start < static_cast<Index>(side_.size()); ++start)
    {
      if (side_[start] == 0)
      {
        this->Spread(start);
      }
    }
    return side_;
  }

private:
  void Spread(Index start)
  {
    std::vector<Index> reached = { start };
    side_[start] = 1;
    double difference = 0.0;
    double sum = 0.0;
    for (std::size_t k = 0; k < reached.size(); ++k)
    {
      const Index from = reached[k];
      difference += side_[from] * area_[from];
      sum += area_[from];
      for (Index e = ends_.begin[from]; e < ends_.begin[from + 1]; ++e)
      {
        const Index edge = ends_.item[e] / 2;
        const Index to = graph_.Low(edge) == from ? graph_.High(edge) : graph_.Low(edge);
        const auto wanted = static_cast<signed char>(isCrossed_[edge] ? -side_[from] : side_[from]);
        if (side_[to] == 0)
        {
          side_[to] = wanted;
          reached.push_back(to);
        }
        else if (side_[to] != wanted)
        {
          throw InvalidInput("The lines do not divide the surface: there is a way around from one "
                             "side of them to the other, through point " +
                             std::to_string(to) + ".");
        }
      }
    }
    constexpr double Rounding = 1e-6; // halves of a symmetric surface are equal
    if (difference < -Rounding * sum)
    {
      for (const Index there : reached)
      {
        side_[there] = static_cast<signed char>(-side_[there]);
      }
    }
  }

  const EdgeGraph& graph_;
  const std::vector<char>& isCrossed_;
  Groups ends_; // per place: 2 edge + end
  std::vector<double> area_;
  std::vector<signed char> side_;
};

SurfaceCurve CurveOf(std::vector<TriangleSegment> segments,
  const std::vector<signed char>& sideOfPlace, const Array<Index>& place)
{
  SurfaceCurve curve;
  curve.segments = std::move(segments);
  curve.place.assign(place.begin(), place.end());
  curve.side.resize(curve.place.size());
  std::transform(curve.place.begin(), curve.place.end(), curve.side.begin(),
    [&](Index own) { return sideOfPlace[own]; });
  return curve;
}

} // namespace

SurfaceCurve BorderOfRegion(
  const TriangleMesh& mesh, const Field& isInside, bool weldCoincidentPoints)
{
  RequireScale(&isInside, mesh);
  const Array<Index> place = PlacesOf(mesh, weldCoincidentPoints);
  const std::vector<signed char> side = SidesOfPlaces(mesh, isInside, place);
  std::vector<TriangleSegment> segments = isInside.association == FieldAssociation::Triangles
                                            ? EdgesBetween(mesh, isInside, place)
                                            : CutTriangles(mesh, side, place);
  if (segments.empty())
  {
    throw InvalidInput("The region has no border: no edge leads from inside to outside.");
  }
  return CurveOf(std::move(segments), side, place);
}

SurfaceCurve BorderOfLabel(
  const TriangleMesh& mesh, const Field& labels, int inside, bool weldCoincidentPoints)
{
  Field isInside = labels;
  for (Id row = 0; row < isInside.values.rows(); ++row)
  {
    double& value = isInside.values(row, 0);
    if (value != std::floor(value))
    {
      throw InvalidInput(
        "There is a value " + std::to_string(value) + "; labels must be integers.");
    }
    value = value == inside ? 1.0 : 0.0;
  }
  return BorderOfRegion(mesh, isInside, weldCoincidentPoints);
}

SurfaceCurve DivideByLines(const TriangleMesh& mesh, const std::vector<std::vector<Vec3>>& lines,
  const NearestPlace& nearest, bool weldCoincidentPoints)
{
  const Array<Index> place = PlacesOf(mesh, weldCoincidentPoints);
  const EdgeGraph graph(mesh, place);
  Tracer tracer(mesh, graph, nearest);
  for (const std::vector<Vec3>& line : lines)
  {
    if (!line.empty())
    {
      tracer.Follow(line);
    }
  }
  if (tracer.segments.empty())
  {
    throw InvalidInput("The lines have no length on the surface.");
  }
  tracer.LeaveAtBorders();
  tracer.RequireNoEnds();
  SideFinder finder(mesh, graph, tracer.Crossed(), place);
  return CurveOf(std::move(tracer.segments), finder.Find(), place);
}

} // namespace gridfem
