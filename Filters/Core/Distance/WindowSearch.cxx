#include "Distance/WindowSearch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridfem
{
namespace
{

constexpr double WindowRounding = 1e-9; // of lengths, so that rounding closes no window

double CrossOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

double DistanceToSegment(const Vec3& point, const Vec3& a, const Vec3& b)
{
  const Vec3 along = b - a;
  const double square = along.squaredNorm();
  const double share = square > 0.0 ? std::clamp(along.dot(point - a) / square, 0.0, 1.0) : 0.0;
  return (a + share * along - point).norm();
}

/// A point of space in the plane of an edge from `low` to `high` on the x axis, above it.
Eigen::Vector2d Flattened(const Vec3& low, const Vec3& high, const Vec3& point)
{
  const Vec3 edge = high - low;
  const double length = edge.norm();
  return length > 0.0 ? Eigen::Vector2d(
                          edge.dot(point - low) / length, edge.cross(point - low).norm() / length)
                      : Eigen::Vector2d(0.0, (point - low).norm());
}

/// The share of the way from a to b where a line from the source through (x, 0) meets it.
double MeetingOf(
  const Eigen::Vector2d& source, double x, const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  const Eigen::Vector2d line(x - source[0], -source[1]);
  const double slope = CrossOf(line, b - a);
  return slope != 0.0 ? std::clamp(-CrossOf(line, a - source) / slope, 0.0, 1.0) : 0.5;
}

} // namespace

WindowSearch::WindowSearch(const PathGraph& graph) : graph_(graph)
{
  this->FindBendingPlaces();
}

void WindowSearch::FindBendingPlaces()
{
  const EdgeGraph& edges = graph_.Edges();
  bends_.assign(graph_.NumberOfPlaces(), 0);
  for (Index edge = 0; edge < edges.Count(); ++edge)
  {
    int sides = 0;
    edges.ForSides(edge, [&](Index, Id) { ++sides; });
    if (sides != 2)
    {
      bends_[edges.Low(edge)] = bends_[edges.High(edge)] = 1;
    }
  }
  for (Index place = 0; place < static_cast<Index>(bends_.size()); ++place)
  {
    double angle = 0.0;
    graph_.ForTrianglesAt(place, [&](Index triangle) { angle += graph_.AngleAt(triangle, place); });
    bends_[place] = bends_[place] || angle > 2.0 * double(EIGEN_PI) + 1e-10;
  }
}

double WindowSearch::LeastThrough(double length, const Vec3& a, const Vec3& b) const
{
  return length + (goal_ ? DistanceToSegment(*goal_, a, b) : 0.0);
}

void WindowSearch::Push(const Event& event)
{
  if (event.key <= (1.0 + WindowRounding) * bound_)
  {
    queue_.push_back(event);
    std::push_heap(queue_.begin(), queue_.end());
  }
}

void WindowSearch::Reach(Index place, const Way& way)
{
  if (way.length < ways_[place].length)
  {
    ways_[place] = way;
    if (bends_[place])
    {
      this->Push(
        { this->LeastThrough(way.length, graph_.At(place), graph_.At(place)), ~Id(place) });
    }
  }
}

void WindowSearch::SendFrom(Index place)
{
  const double before = ways_[place].length;
  if (before >= sent_[place])
  {
    return;
  }
  sent_[place] = before;
  const EdgeGraph& edges = graph_.Edges();
  graph_.ForTrianglesAt(place,
    [&](Index triangle)
    {
      for (const Index edge : edges.EdgesOf(triangle))
      {
        if (graph_.ApexOf(triangle, edge) != place)
        {
          const Index other = edges.Low(edge) == place ? edges.High(edge) : edges.Low(edge);
          const double length = (graph_.At(other) - graph_.At(place)).norm();
          this->Reach(other, { before + length, -1, place, triangle });
          continue;
        }
        const Vec3& low = graph_.At(edges.Low(edge));
        const Vec3& high = graph_.At(edges.High(edge));
        const Vec2 at = Flattened(low, high, graph_.At(place));
        this->Add({ { at[0], -at[1] }, 0.0, (high - low).norm(), before, -1, edge, triangle, place,
          triangle });
      }
    });
}

/// Whether a path through an end of the edge is shorter than all lines through the window.
bool WindowSearch::IsUseless(const Window& window) const
{
  const Index low = graph_.Edges().Low(window.edge);
  const Index high = graph_.Edges().High(window.edge);
  const double length = (graph_.At(high) - graph_.At(low)).norm();
  constexpr double Less = 1.0 + 1e-12;
  const double toBegin = window.before + (window.source - Vec2(window.begin, 0.0)).norm();
  const double toEnd = window.before + (window.source - Vec2(window.end, 0.0)).norm();
  return (ways_[low].length + window.end) * Less < toEnd ||
         (ways_[high].length + length - window.begin) * Less < toBegin;
}

/// Adds a window for every triangle beyond the edge.
/// @param window  its triangle is the one before the edge
void WindowSearch::Add(Window window)
{
  if (this->IsUseless(window))
  {
    return;
  }
  const Vec3& low = graph_.At(graph_.Edges().Low(window.edge));
  const Vec3& high = graph_.At(graph_.Edges().High(window.edge));
  const double length = (high - low).norm();
  const Vec3 along = length > 0.0 ? Vec3((high - low) / length) : Vec3::Zero();
  const double nearest = std::clamp(window.source[0], window.begin, window.end);
  const double least = window.before + (window.source - Vec2(nearest, 0.0)).norm();
  const double key =
    this->LeastThrough(least, low + window.begin * along, low + window.end * along);
  if (key > (1.0 + WindowRounding) * bound_)
  {
    return;
  }
  // Copies of a triangle lead nowhere else, but their windows would double at each of them.
  std::vector<Index> apexes = { graph_.ApexOf(window.triangle, window.edge) };
  graph_.Edges().ForSides(window.edge,
    [&](Index, Id side)
    {
      window.triangle = static_cast<Index>(side);
      const Index apex = graph_.ApexOf(window.triangle, window.edge);
      if (std::find(apexes.begin(), apexes.end(), apex) == apexes.end())
      {
        apexes.push_back(apex);
        windows_.push_back(window);
        this->Push({ key, static_cast<Id>(windows_.size()) - 1 });
      }
    });
}

/// Passes a part of a window on to an edge of its triangle.
/// @param number  of the window
/// @param begin   part of the window's edge, from which lines lead to the other edge
/// @param apex    of the triangle, unfolded
void WindowSearch::PassOn(
  Id number, const Window& window, Index near, double begin, double end, const Vec2& apex)
{
  const EdgeGraph& edges = graph_.Edges();
  const Index apexPlace = graph_.ApexOf(window.triangle, window.edge);
  const Index lowBefore = edges.Low(window.edge);
  const Index highBefore = edges.High(window.edge);
  const double lengthBefore = (graph_.At(highBefore) - graph_.At(lowBefore)).norm();
  const Index edge = graph_.EdgeOf(window.triangle, near, apexPlace);
  const auto at = [&](Index place)
  { return place == apexPlace ? apex : Vec2(place == lowBefore ? 0.0 : lengthBefore, 0.0); };
  const Vec2 low = at(edges.Low(edge));
  const Vec2 high = at(edges.High(edge));
  const double length = (graph_.At(edges.High(edge)) - graph_.At(edges.Low(edge))).norm();
  const double from = length * MeetingOf(window.source, begin, low, high);
  const double to = length * MeetingOf(window.source, end, low, high);
  if (!(std::abs(to - from) > 1e-13 * length))
  {
    return;
  }
  // The other end of the edge before is on the other side of all lines.
  const bool isLeft = near == lowBefore;
  const Vec2 far(isLeft ? lengthBefore : 0.0, 0.0);
  const Vec2 along = (high - low) / length;
  const Vec2 outer = low + (isLeft ? from : to) * along;
  if ((ways_[isLeft ? highBefore : lowBefore].length + (outer - far).norm()) * (1.0 + 1e-12) <
      window.before + (outer - window.source).norm())
  {
    return;
  }
  const Vec2 source = window.source - low;
  this->Add({ { source.dot(along), -std::abs(CrossOf(along, source)) }, std::min(from, to),
    std::max(from, to), window.before, number, edge, window.triangle, window.root, window.first });
}

void WindowSearch::Move(Id number)
{
  const Window window = windows_[number];
  if (this->IsUseless(window))
  {
    return;
  }
  const Index low = graph_.Edges().Low(window.edge);
  const Index high = graph_.Edges().High(window.edge);
  const Index apexPlace = graph_.ApexOf(window.triangle, window.edge);
  const Vec2 apex = Flattened(graph_.At(low), graph_.At(high), graph_.At(apexPlace));
  const double rise = apex[1] - window.source[1];
  const double crossing =
    rise > 0.0 ? window.source[0] - (apex[0] - window.source[0]) * window.source[1] / rise
               : apex[0];
  const double rounding = WindowRounding * (graph_.At(high) - graph_.At(low)).norm();
  bool hasLeft = crossing > window.begin;
  bool hasRight = crossing < window.end;
  if (crossing >= window.begin - rounding && crossing <= window.end + rounding)
  {
    const double length = window.before + (apex - window.source).norm();
    this->Reach(apexPlace, { length, number, window.root, window.triangle });
    const std::array<Index, 3> corner = graph_.CornersOf(window.triangle);
    const int k = corner[0] == apexPlace ? 0 : corner[1] == apexPlace ? 1 : 2;
    Split& split = splits_[3 * static_cast<std::size_t>(window.triangle) + k];
    if (length < split.length)
    {
      split = { length, crossing };
    }
    else
    {
      hasLeft = hasLeft && split.at > crossing - rounding;
      hasRight = hasRight && split.at < crossing + rounding;
    }
  }
  if (hasLeft)
  {
    this->PassOn(number, window, low, window.begin, std::min(window.end, crossing), apex);
  }
  if (hasRight)
  {
    this->PassOn(number, window, high, std::max(window.begin, crossing), window.end, apex);
  }
}

bool WindowSearch::From(const std::vector<Index>& sources, const std::vector<Index>& targets,
  double bound, std::size_t most, const Job& job)
{
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  ways_.assign(bends_.size(), { Infinity, -1, -1, -1 });
  sent_.assign(bends_.size(), Infinity);
  splits_.assign(3 * graph_.Mesh().triangles.size(), { Infinity, 0.0 });
  windows_.clear();
  queue_.clear();
  bound_ = bound;
  goal_ = targets.size() == 1 ? &graph_.At(targets.front()) : nullptr;
  for (const Index source : sources)
  {
    ways_[source].length = 0.0;
    this->Push({ this->LeastThrough(0.0, graph_.At(source), graph_.At(source)), ~Id(source) });
  }
  for (std::size_t done = 1; !queue_.empty(); ++done)
  {
    std::pop_heap(queue_.begin(), queue_.end());
    const Event event = queue_.back();
    queue_.pop_back();
    if (goal_)
    {
      bound_ = std::min(bound_, ways_[targets.front()].length);
    }
    if (event.key > (1.0 + WindowRounding) * bound_)
    {
      break;
    }
    if (windows_.size() > most)
    {
      return false;
    }
    if (done % 16384 == 0)
    {
      job.Check(static_cast<double>(windows_.size()) / static_cast<double>(most));
    }
    if (event.number < 0)
    {
      this->SendFrom(static_cast<Index>(~event.number));
    }
    else
    {
      this->Move(event.number);
    }
  }
  return true;
}

std::vector<TriangleStrip> WindowSearch::StripsTo(Index place) const
{
  std::vector<TriangleStrip> strips;
  for (Index to = place; ways_[to].previous >= 0; to = ways_[to].previous)
  {
    const Way& way = ways_[to];
    TriangleStrip strip{ way.previous, to, {}, {} };
    for (Id number = way.window; number >= 0; number = windows_[number].parent)
    {
      strip.triangles.push_back(windows_[number].triangle);
      strip.edges.push_back(windows_[number].edge);
    }
    strip.triangles.push_back(way.window < 0 ? way.triangle : windows_[way.window].first);
    std::reverse(strip.triangles.begin(), strip.triangles.end());
    std::reverse(strip.edges.begin(), strip.edges.end());
    strips.push_back(std::move(strip));
  }
  std::reverse(strips.begin(), strips.end());
  return strips;
}

} // namespace gridfem
