#include "Distance/SurfaceCurve.h"

#include "Base/Errors.h"
#include "Base/Grouping.h"
#include "Distance/EdgeGraph.h"
#include "Distance/LineTracer.h"
#include "Grid/TriangleArea.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

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

//--------------------------------------------------------------------------------------------------
// Regions.

/// The side of each place: -1 if everything that meets there is inside, 1 if everything is outside,
/// 0 if both meet.
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

/// Cuts a triangle halfway along the edges from inside to outside, and through corners on both
/// sides.
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

/// The border of a region of triangles: edges between triangles inside and outside.
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

/// Spreads sides over the surface. They change across crossed edges.
class SideFinder
{
public:
  SideFinder(const TriangleMesh& mesh, const EdgeGraph& graph, const std::vector<char>& isCrossed,
    const std::vector<char>& isOnLine, const Array<Index>& place)
    : graph_(graph), isCrossed_(isCrossed), side_(mesh.points.size(), 0),
      isDivided_(mesh.points.size(), 0)
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
        const double share = isOnLine[place[point]] ? 0.0 : 1.0 / 3.0; // counts for neither side
        area_[place[point]] += share * AreaOf(mesh, static_cast<Id>(t));
      }
    }
  }

  /// The side of every place.
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

  /// Whether the component of each place has two sides. Valid after Find.
  const std::vector<char>& IsDivided() const { return isDivided_; }

private:
  void Spread(Index start)
  {
    std::vector<Index> reached = { start };
    side_[start] = 1;
    bool isDivided = false;
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
        isDivided = isDivided || isCrossed_[edge];
        if (side_[to] == 0)
        {
          side_[to] = wanted;
          reached.push_back(to);
        }
        else if (side_[to] != wanted)
        {
          throw InvalidInput("The lines do not divide the surface: a path through point " +
                             std::to_string(to) + " leads around them from one side to the other.");
        }
      }
    }
    for (const Index there : reached)
    {
      isDivided_[there] = isDivided ? 1 : 0;
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
  std::vector<char> isDivided_;
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
  const NearestPlaces& nearest, bool weldCoincidentPoints)
{
  const Array<Index> place = PlacesOf(mesh, weldCoincidentPoints);
  const EdgeGraph graph(mesh, place);
  LineTracer tracer(mesh, graph, place, nearest);
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
  const std::vector<char> isCrossed = tracer.Crossed();
  SideFinder finder(mesh, graph, isCrossed, tracer.IsOnLine(), place);
  const std::vector<signed char>& side = finder.Find();
  tracer.RequireClosed(finder.IsDivided());
  return CurveOf(std::move(tracer.segments), side, place);
}

} // namespace gridfem
