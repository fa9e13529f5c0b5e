#include "Distance/TriangleStrip.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace gridfem
{
namespace
{

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

bool HasCorner(const PathGraph& graph, Index triangle, Index place)
{
  const std::array<Index, 3> corner = graph.CornersOf(triangle);
  return std::find(corner.begin(), corner.end(), place) != corner.end();
}

} // namespace

void RemoveDetours(const PathGraph& graph, TriangleStrip& strip)
{
  const auto count = static_cast<Id>(strip.triangles.size());
  Id begin = 0;
  std::unordered_map<Index, Id> lastVisit;
  for (Id k = 0; k < count; ++k)
  {
    lastVisit[strip.triangles[k]] = k;
    begin = HasCorner(graph, strip.triangles[k], strip.from) ? k : begin;
  }
  TriangleStrip direct{ strip.from, strip.to, {}, {} };
  for (Id k = begin; k < count; ++k)
  {
    direct.triangles.push_back(strip.triangles[k]);
    if (HasCorner(graph, strip.triangles[k], strip.to))
    {
      break;
    }
    k = lastVisit[strip.triangles[k]];
    if (!direct.edges.empty() && direct.edges.back() == strip.edges[k])
    {
      direct.triangles.pop_back(); // left where it was entered
    }
    else
    {
      direct.edges.push_back(strip.edges[k]);
    }
  }
  strip = std::move(direct);
}

StripPath::StripPath(const PathGraph& graph, const TriangleStrip& strip)
  : graph_(graph), strip_(strip)
{
  if (strip.triangles.size() > 1)
  {
    this->Unfold();
    this->RunFunnel();
    for (std::size_t k = 1; k < path_.size(); ++k)
    {
      length_ += (corners_[path_[k]].at - corners_[path_[k - 1]].at).norm();
    }
  }
  else
  {
    length_ = (graph.At(strip.to) - graph.At(strip.from)).norm();
  }
}

/// The place of a triangle's apex in the plane, given the edge below.
/// @param side  1: beyond the edge; -1: before it
StripPath::Vec2 StripPath::Unfolded(
  const Corner& left, const Corner& right, Index apex, double side) const
{
  const Vec3 edge = graph_.At(right.place) - graph_.At(left.place);
  const Vec3 toApex = graph_.At(apex) - graph_.At(left.place);
  const double length = edge.norm();
  const Vec2 flat = right.at - left.at;
  const Vec2 along = flat.norm() > 0.0 ? Vec2(flat.normalized()) : Vec2::UnitX();
  const Vec2 beyond(-along[1], along[0]);
  const double x = length > 0.0 ? edge.dot(toApex) / length : 0.0;
  const double y = length > 0.0 ? edge.cross(toApex).norm() / length : toApex.norm();
  return left.at + x * along + side * y * beyond;
}

void StripPath::Unfold()
{
  const EdgeGraph& edges = graph_.Edges();
  const auto count = static_cast<Id>(strip_.triangles.size());
  corners_.resize(count + 2);
  left_.resize(count - 1);
  right_.resize(count - 1);
  corners_[1].place = edges.Low(strip_.edges[0]);
  corners_[2].place = edges.High(strip_.edges[0]);
  corners_[2].at[0] = (graph_.At(corners_[2].place) - graph_.At(corners_[1].place)).norm();
  corners_[0].place = strip_.from;
  corners_[0].at = this->Unfolded(corners_[1], corners_[2], strip_.from, -1.0);
  left_[0] = 1;
  right_[0] = 2;
  for (Id k = 1; k < count; ++k)
  {
    Corner& apex = corners_[k + 2];
    const Corner& left = corners_[left_[k - 1]];
    const Corner& right = corners_[right_[k - 1]];
    apex.place = graph_.ApexOf(strip_.triangles[k], strip_.edges[k - 1]);
    apex.at = this->Unfolded(left, right, apex.place, 1.0);
    apex.first = apex.last = k;
    if (k < count - 1)
    {
      const Index edge = strip_.edges[k];
      const bool keepsLeft = edges.Low(edge) == left.place || edges.High(edge) == left.place;
      left_[k] = keepsLeft ? left_[k - 1] : k + 2;
      right_[k] = keepsLeft ? k + 2 : right_[k - 1];
      corners_[left_[k]].last = corners_[right_[k]].last = k;
    }
  }
}

/// The funnel goes from its left end over the apex to its right end. Both of its sides bend inward.
void StripPath::RunFunnel()
{
  const auto count = static_cast<Id>(strip_.triangles.size());
  std::vector<Id> funnel(2 * count + 5);
  Id apex = count + 2;
  Id low = apex - 1;
  Id high = apex + 1;
  funnel[low] = 1;
  funnel[apex] = 0;
  funnel[high] = 2;
  const auto at = [&](Id k) -> const Vec2& { return corners_[funnel[k]].at; };
  const auto add = [&](Id corner, bool isRight)
  {
    const Id step = isRight ? 1 : -1;
    const double sign = isRight ? 1.0 : -1.0;
    Id& end = isRight ? high : low;
    const Id otherEnd = isRight ? low : high;
    const Vec2& place = corners_[corner].at;
    while (end != apex && sign * Cross(at(end) - at(end - step), place - at(end - step)) >= 0.0)
    {
      end -= step;
    }
    while (end == apex && apex != otherEnd &&
           sign * Cross(at(apex - step) - at(apex), place - at(apex)) > 0.0)
    {
      apex -= step;
      end = apex;
    }
    corners_[corner].previous = funnel[end];
    end += step;
    funnel[end] = corner;
  };
  for (Id edge = 1; edge < count - 1; ++edge)
  {
    add(edge + 2, right_[edge] == edge + 2);
  }
  add(count + 1, true);
  for (Id corner = count + 1; corner != 0; corner = corners_[corner].previous)
  {
    path_.push_back(corner);
  }
  path_.push_back(0);
  std::reverse(path_.begin(), path_.end());
}

std::array<Id, 3> StripPath::CornersOf(Id triangle) const
{
  return triangle == 0
           ? std::array<Id, 3>{ 0, 1, 2 }
           : std::array<Id, 3>{ left_[triangle - 1], right_[triangle - 1], triangle + 2 };
}

StarDirection StripPath::DirectionAt(Id corner, Id triangle, Id toward) const
{
  const Corner& at = corners_[corner];
  const Vec2 direction = corners_[toward].at - at.at;
  StarDirection result{ strip_.triangles[triangle], {} };
  int k = 0;
  for (const Id other : this->CornersOf(triangle))
  {
    if (other != corner)
    {
      const Vec2 along = corners_[other].at - at.at;
      result.spokes[k++] = {
        graph_.EdgeOf(result.triangle, at.place, corners_[other].place),
        std::atan2(std::abs(Cross(direction, along)), direction.dot(along)),
      };
    }
  }
  return result;
}

std::vector<StripBend> StripPath::Bends() const
{
  std::vector<StripBend> bends;
  for (std::size_t k = 1; k + 1 < path_.size(); ++k)
  {
    const Id corner = path_[k];
    const Corner& at = corners_[corner];
    StripBend bend;
    bend.place = at.place;
    bend.first = this->IsAtEdge(path_[k - 1], at.first) ? at.first + 1 : at.first;
    bend.last = this->IsAtEdge(path_[k + 1], at.last) ? at.last : at.last + 1;
    bend.in = this->DirectionAt(corner, bend.first, path_[k - 1]);
    bend.out = this->DirectionAt(corner, bend.last, path_[k + 1]);
    bends.push_back(bend);
  }
  return bends;
}

/// The share of the way from the left to the right end of an edge where the straight line between
/// two corners crosses it. It is 0 or 1 at an end, except for rounding.
double StripPath::CrossingOf(Id edge, Id from, Id to) const
{
  constexpr double Rounding = 1e-12;
  const Vec2& origin = corners_[from].at;
  const Vec2 along = corners_[to].at - origin;
  const double left = Cross(along, corners_[left_[edge]].at - origin);
  const double right = Cross(along, corners_[right_[edge]].at - origin);
  const double share = left > right ? left / (left - right) : 0.5;
  return share < Rounding ? 0.0 : share > 1.0 - Rounding ? 1.0 : share;
}

PathPoint StripPath::PointAt(Id triangle, Index a, Index b, double share) const
{
  PathPoint point{ strip_.triangles[triangle], Vec3::Zero() };
  const std::array<Index, 3> corner = graph_.CornersOf(point.triangle);
  for (int k = 0; k < 3; ++k)
  {
    point.weights[k] = corner[k] == b ? share : corner[k] == a ? 1.0 - share : 0.0;
  }
  return point;
}

std::vector<PathPoint> StripPath::Points() const
{
  const auto count = static_cast<Id>(strip_.triangles.size());
  std::vector<PathPoint> points;
  Index lastPlace = -1; // of the last point, if it is at a place
  const auto addPlace = [&](Id triangle, Index place)
  {
    if (place != lastPlace)
    {
      points.push_back(this->PointAt(triangle, place, place, 1.0));
      lastPlace = place;
    }
  };
  addPlace(0, strip_.from);
  std::size_t before = 0; // the corner of the path behind the current edge
  for (Id edge = 0; edge + 1 < count; ++edge)
  {
    while (before + 2 < path_.size() && edge >= corners_[path_[before + 1]].first)
    {
      ++before;
    }
    const Corner& corner = corners_[path_[before]];
    if (before > 0 && edge <= corner.last)
    {
      addPlace(edge, corner.place);
      continue;
    }
    const double share = this->CrossingOf(edge, path_[before], path_[before + 1]);
    const Index left = corners_[left_[edge]].place;
    const Index right = corners_[right_[edge]].place;
    if (share == 0.0 || share == 1.0)
    {
      addPlace(edge, share == 0.0 ? left : right);
      continue;
    }
    points.push_back(this->PointAt(edge, left, right, share));
    lastPlace = -1;
  }
  addPlace(count - 1, strip_.to);
  return points;
}

} // namespace gridfem
