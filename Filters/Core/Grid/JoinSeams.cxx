#include "Grid/JoinSeams.h"

#include "Base/Parallel.h"

#include <algorithm>

namespace gridfem
{

namespace
{

/// The points on the sides of a triangle, for each side from its first corner on.
using SideNodes = std::array<std::vector<Id>, 3>;

/// Divides triangles at the nodes of their sides.
class TriangleDivider
{
public:
  TriangleDivider(
    const std::vector<Seams::Division>& divisions, const TriangleMesh& mesh, int threads)
    : mesh_(mesh), divisions_(divisions), places_(PlacesOf(divisions)),
      numberOfPoint_(places_.OfPoints(mesh.points, threads)),
      lowest_(places_.LowestPoints(numberOfPoint_))
  {
  }

  /// Appends the parts of one triangle, or the triangle itself.
  void Append(Id triangle, std::vector<std::array<Id, 3>>& parts) const
  {
    const std::array<Id, 3>& corner = mesh_.triangles[triangle];
    SideNodes nodes;
    for (int k = 0; k < 3; ++k)
    {
      nodes[k] = this->NodesOf(corner[k], corner[(k + 1) % 3], corner[(k + 2) % 3]);
    }
    this->AppendParts(corner, nodes, parts);
  }

private:
  static std::vector<Place> PlacesOf(const std::vector<Seams::Division>& divisions)
  {
    std::vector<Place> places;
    for (const Seams::Division& division : divisions)
    {
      places.insert(places.end(), division.ends.begin(), division.ends.end());
      places.insert(places.end(), division.nodes.begin(), division.nodes.end());
    }
    return places;
  }

  /// Returns the points between two corners, without those at the opposite corner.
  std::vector<Id> NodesOf(Id from, Id to, Id opposite) const
  {
    if (numberOfPoint_[from] == PlaceNumbers::None || numberOfPoint_[to] == PlaceNumbers::None)
    {
      return {};
    }
    OpenEdge ends{ PlaceOf(mesh_.points[from]), PlaceOf(mesh_.points[to]) };
    const bool isReversed = ends[1] < ends[0];
    if (isReversed)
    {
      std::swap(ends[0], ends[1]);
    }
    const auto found = std::lower_bound(divisions_.begin(), divisions_.end(), ends,
      [](const Seams::Division& division, const auto& wanted) { return division.ends < wanted; });
    std::vector<Id> nodes;
    if (found != divisions_.end() && found->ends == ends)
    {
      for (const Place& place : found->nodes)
      {
        const Index number = places_.Of(place);
        if (number != numberOfPoint_[opposite])
        {
          nodes.push_back(lowest_[number]);
        }
      }
    }
    if (isReversed)
    {
      std::reverse(nodes.begin(), nodes.end());
    }
    return nodes;
  }

  double LengthOf(Id from, Id to) const { return (mesh_.points[to] - mesh_.points[from]).norm(); }

  /// Cuts from the longest divided side, near its middle, to the opposite corner. The parts are cut
  /// further. No part is flat, whichever sides have nodes.
  void AppendParts(const std::array<Id, 3>& corner, const SideNodes& nodes,
    std::vector<std::array<Id, 3>>& parts) const
  {
    int side = -1;
    double longest = -1.0;
    for (int k = 0; k < 3; ++k)
    {
      const double length = this->LengthOf(corner[k], corner[(k + 1) % 3]);
      if (!nodes[k].empty() && length > longest)
      {
        side = k;
        longest = length;
      }
    }
    if (side < 0)
    {
      parts.push_back(corner);
      return;
    }
    const Id from = corner[side];
    const Id to = corner[(side + 1) % 3];
    const Id opposite = corner[(side + 2) % 3];
    const std::vector<Id>& ofSide = nodes[side];
    const auto middle = std::min_element(ofSide.begin(), ofSide.end(),
      [&](Id a, Id b)
      {
        return std::abs(this->LengthOf(from, a) - this->LengthOf(a, to)) <
               std::abs(this->LengthOf(from, b) - this->LengthOf(b, to));
      });
    this->AppendParts({ from, *middle, opposite },
      { std::vector<Id>(ofSide.begin(), middle), {}, nodes[(side + 2) % 3] }, parts);
    this->AppendParts({ *middle, to, opposite },
      { std::vector<Id>(middle + 1, ofSide.end()), nodes[(side + 1) % 3], {} }, parts);
  }

  const TriangleMesh& mesh_;
  const std::vector<Seams::Division>& divisions_;
  PlaceNumbers places_;
  std::vector<Index> numberOfPoint_;
  std::vector<Id> lowest_; // point at each place
};

/// Divides the triangles and returns which triangle each part is of.
std::vector<Id> DivideTriangles(
  const std::vector<Seams::Division>& divisions, TriangleMesh& mesh, int threads)
{
  const TriangleDivider divider(divisions, mesh, threads);
  std::vector<std::array<Id, 3>> parts;
  std::vector<Id> source;
  parts.reserve(mesh.triangles.size());
  source.reserve(mesh.triangles.size());
  for (Id triangle = 0; triangle < static_cast<Id>(mesh.triangles.size()); ++triangle)
  {
    divider.Append(triangle, parts);
    source.resize(parts.size(), triangle);
  }
  mesh.triangles = std::move(parts);
  return source;
}

} // namespace

std::vector<MovedPoint> MovePoints(
  const std::vector<Seams::Move>& moves, TriangleMesh& mesh, int threads)
{
  std::vector<Place> places;
  for (const Seams::Move& move : moves)
  {
    places.push_back(move.from);
    places.push_back(move.to);
  }
  const PlaceNumbers numbers(std::move(places));
  const std::vector<Index> numberOfPoint = numbers.OfPoints(mesh.points, threads);
  const std::vector<Id> lowest = numbers.LowestPoints(numberOfPoint);
  std::vector<Place> target(numbers.Count());
  std::vector<Id> twin(numbers.Count(), PlaceNumbers::None);
  std::vector<char> isMoved(numbers.Count(), 0);
  for (const Seams::Move& move : moves)
  {
    const Index from = numbers.Of(move.from);
    isMoved[from] = 1;
    target[from] = move.to;
    twin[from] = lowest[numbers.Of(move.to)];
  }
  std::vector<MovedPoint> moved;
  for (Id point = 0; point < static_cast<Id>(mesh.points.size()); ++point)
  {
    const Index number = numberOfPoint[point];
    if (number != PlaceNumbers::None && isMoved[number])
    {
      mesh.points[point] = PointAt(target[number]);
      moved.push_back({ point, twin[number] == PlaceNumbers::None ? point : twin[number] });
    }
  }
  return moved;
}

JoinedSeams JoinSeams(TriangleMesh& mesh, int threads)
{
  const std::vector<OpenEdge> open = FindOpenEdges(mesh, threads);
  JoinedSeams joined;
  if (open.empty())
  {
    return joined;
  }
  const Bounds bounds = BoundsOf(mesh.points, UsedPoints(mesh, threads), threads);
  const std::vector<double> shortest = ShortestSides(mesh, NumberEnds(open), threads);
  const Seams seams = FindSeams(open, shortest, (bounds.high - bounds.low).maxCoeff(), threads);
  if (!seams.moves.empty())
  {
    joined.moved = MovePoints(seams.moves, mesh, threads);
  }
  if (!seams.divisions.empty())
  {
    joined.sourceTriangle = DivideTriangles(seams.divisions, mesh, threads);
  }
  return joined;
}

} // namespace gridfem
