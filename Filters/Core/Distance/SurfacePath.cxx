#include "Distance/SurfacePath.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gridfem
{
namespace
{

constexpr double AngleRounding = 1e-9;

/// Lays strips of triangles along a way.
class StripLayer
{
public:
  StripLayer(const PathGraph& graph, const std::vector<PathSearch::Node>& way)
    : graph_(graph), way_(way)
  {
    Index triangle = this->TriangleOfStep(0);
    this->Begin(triangle);
    for (std::size_t k = 1; k + 1 < way_.size(); ++k)
    {
      const Index next = this->TriangleOfStep(k);
      if (next != triangle)
      {
        this->Turn(k, triangle, next);
        triangle = next;
      }
    }
    strips_.back().to = static_cast<Index>(way_.back());
  }

  std::vector<TriangleStrip> Release() { return std::move(strips_); }

private:
  bool IsPlace(std::size_t k) const { return way_[k] < graph_.NumberOfPlaces(); }
  Index PlaceOf(std::size_t k) const { return static_cast<Index>(way_[k]); }
  Index EdgeOf(std::size_t k) const
  {
    return static_cast<Index>(way_[k] - graph_.NumberOfPlaces());
  }

  bool Touches(Index triangle, std::size_t k) const
  {
    const auto has = [&](const std::array<Index, 3>& parts, Index part)
    { return std::find(parts.begin(), parts.end(), part) != parts.end(); };
    return this->IsPlace(k) ? has(graph_.CornersOf(triangle), this->PlaceOf(k))
                            : has(graph_.Edges().EdgesOf(triangle), this->EdgeOf(k));
  }

  /// The first triangle that holds nodes k and k + 1. A point in one of its edges is no step.
  Index TriangleOfStep(std::size_t k) const
  {
    Index found = EdgeGraph::None;
    const auto look = [&](Index triangle)
    { found = found == EdgeGraph::None && this->Touches(triangle, k + 1) ? triangle : found; };
    if (this->IsPlace(k))
    {
      graph_.ForTrianglesAt(this->PlaceOf(k), look);
    }
    else
    {
      graph_.Edges().ForSides(
        this->EdgeOf(k), [&](Index, Id triangle) { look(static_cast<Index>(triangle)); });
    }
    return found;
  }

  Vec3 At(std::size_t k) const
  {
    return this->IsPlace(k) ? graph_.At(this->PlaceOf(k))
                            : Vec3(0.5 * (graph_.At(graph_.Edges().Low(this->EdgeOf(k))) +
                                           graph_.At(graph_.Edges().High(this->EdgeOf(k)))));
  }

  void Begin(Index triangle)
  {
    strips_.push_back({ static_cast<Index>(way_.front()), -1, { triangle }, {} });
  }

  /// Leads the strip around node k. A place where no triangles lead around ends the strip.
  void Turn(std::size_t k, Index from, Index to)
  {
    TriangleStrip& strip = strips_.back();
    if (!this->IsPlace(k))
    {
      strip.edges.push_back(this->EdgeOf(k));
      strip.triangles.push_back(to);
      return;
    }
    const Index place = this->PlaceOf(k);
    const StarRoute route =
      RouteAround(graph_, place, DirectionToward(graph_, from, place, this->At(k - 1)),
        DirectionToward(graph_, to, place, this->At(k + 1)));
    if (route.edges.empty())
    {
      strip.to = place;
      strips_.push_back({ place, -1, { to }, {} });
      return;
    }
    strip.edges.insert(strip.edges.end(), route.edges.begin(), route.edges.end());
    strip.triangles.insert(strip.triangles.end(), route.triangles.begin(), route.triangles.end());
    strip.triangles.push_back(to);
  }

  const PathGraph& graph_;
  const std::vector<PathSearch::Node>& way_;
  std::vector<TriangleStrip> strips_;
};

void AppendPart(const TriangleStrip& strip, Id first, Id last, TriangleStrip& to)
{
  for (Id k = first; k <= last; ++k)
  {
    to.triangles.push_back(strip.triangles[k]);
    if (k < last)
    {
      to.edges.push_back(strip.edges[k]);
    }
  }
}

/// Moves the strip to the other side of each corner if the way around the corner is shorter.
/// Corners that share triangles with one before wait for the next round.
/// @return whether anything has moved
bool MoveAroundCorners(
  const PathGraph& graph, const std::vector<StripBend>& bends, TriangleStrip& strip)
{
  constexpr double Least = double(EIGEN_PI) - AngleRounding;
  TriangleStrip moved{ strip.from, strip.to, {}, {} };
  Id done = 0; // the first triangle that is not yet in the moved strip
  for (const StripBend& bend : bends)
  {
    if (bend.first < done)
    {
      continue;
    }
    const StarRoute route = RouteAround(graph, bend.place, bend.in, bend.out, Least);
    if (route.angle < Least)
    {
      AppendPart(strip, done, bend.first, moved);
      moved.edges.insert(moved.edges.end(), route.edges.begin(), route.edges.end());
      moved.triangles.insert(moved.triangles.end(), route.triangles.begin(), route.triangles.end());
      done = bend.last;
    }
  }
  if (moved.triangles.empty())
  {
    return false;
  }
  AppendPart(strip, done, static_cast<Id>(strip.triangles.size()) - 1, moved);
  strip = std::move(moved);
  return true;
}

std::vector<PathPoint> PointsOfTightPath(
  const PathGraph& graph, TriangleStrip strip, const Job& job)
{
  RemoveDetours(graph, strip);
  for (;;)
  {
    job.Check(0.0);
    const StripPath path(graph, strip);
    TriangleStrip moved = strip;
    if (!MoveAroundCorners(graph, path.Bends(), moved))
    {
      return path.Points();
    }
    RemoveDetours(graph, moved);
    if (!(StripPath(graph, moved).Length() < path.Length())) // except for rounding
    {
      return path.Points();
    }
    strip = std::move(moved);
  }
}

} // namespace

Vec3 PositionOf(const TriangleMesh& mesh, const PathPoint& point)
{
  const auto& corner = mesh.triangles[point.triangle];
  return point.weights[0] * mesh.points[corner[0]] + point.weights[1] * mesh.points[corner[1]] +
         point.weights[2] * mesh.points[corner[2]];
}

SurfacePath PullTight(
  const PathGraph& graph, const std::vector<PathSearch::Node>& way, const Job& job)
{
  if (way.size() > 1)
  {
    return PullTight(graph, StripLayer(graph, way).Release(), job);
  }
  SurfacePath path;
  graph.ForTrianglesAt(static_cast<Index>(way.front()),
    [&](Index triangle)
    {
      PathPoint point{ triangle, Vec3::Zero() };
      const std::array<Index, 3> corner = graph.CornersOf(triangle);
      point.weights[std::find(corner.begin(), corner.end(), way.front()) - corner.begin()] = 1.0;
      path.points.assign(2, point);
    });
  return path;
}

SurfacePath PullTight(
  const PathGraph& graph, const std::vector<TriangleStrip>& strips, const Job& job)
{
  SurfacePath path;
  for (const TriangleStrip& strip : strips)
  {
    const std::vector<PathPoint> points = PointsOfTightPath(graph, strip, job);
    // The first point is the last of the strip before.
    path.points.insert(
      path.points.end(), points.begin() + (path.points.empty() ? 0 : 1), points.end());
  }
  for (std::size_t k = 1; k < path.points.size(); ++k)
  {
    path.length +=
      (PositionOf(graph.Mesh(), path.points[k]) - PositionOf(graph.Mesh(), path.points[k - 1]))
        .norm();
  }
  return path;
}

} // namespace gridfem
