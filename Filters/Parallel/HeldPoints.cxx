#include "Parallel/HeldPoints.h"

#include "Algebra/RowBuilder.h"

#include <algorithm>
#include <limits>

namespace gridfem
{

namespace
{

/// Received points that this rank evaluates and that some rank holds, ascending. If several are at
/// one place of one sheet, only the first is listed.
std::vector<Id> PlacesOfHeld(const RankSpace& space, const MultiVector& received)
{
  const std::vector<Vec3>& position = space.Own().Mesh().points;
  const Array<Index>& patch = space.PointPatches();
  std::vector<Id> places;
  std::size_t first = 0; // first of the places at the same position
  for (Id place = 0; place < received.rows(); ++place)
  {
    if (patch[place] < 0 || received(place, 0) == 0.0)
    {
      continue;
    }
    if (!places.empty() && position[places.back()] != position[place])
    {
      first = places.size();
    }
    // cppcheck-suppress containerOutOfBounds ; first is at most their number
    const bool isThere = std::any_of(places.begin() + static_cast<std::ptrdiff_t>(first),
      places.end(), [&](Id other) { return patch[other] == patch[place]; });
    if (!isThere)
    {
      places.push_back(place);
    }
  }
  return places;
}

/// Held values on a grid, where one rank evaluates each point.
HeldValues HoldOnGrid(const RankSpace& space, const MultiVector& received)
{
  const Id columns = received.cols() - 1;
  const std::vector<Id> places = PlacesOfHeld(space, received);
  HeldValues held;
  held.rows = space.Own().RowsAtPoints(places);
  held.values.resize(static_cast<Id>(places.size()), columns);
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    held.values.row(static_cast<Id>(k)) = received.row(places[k]).tail(columns);
  }
  return held;
}

/// Collective. Rows of received points: 1 where a point is held, followed by its values.
/// @param points  this rank's own
MultiVector SendHeld(
  const RankSpace& space, const std::vector<Id>& points, const MultiVector& values)
{
  MultiVector own;
  space.Ranks().Together(
    [&]
    {
      own = MultiVector::Zero(space.Distribution().NumberOfOwnPoints(), 1 + values.cols());
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        own.row(points[k]) << 1.0, values.row(static_cast<Id>(k));
      }
    });
  return space.Distribution().SendPoints(own);
}

constexpr double Nobody = std::numeric_limits<double>::infinity();

/// Calls body(hat, place, rank that has sent the point) for every place where a hat's point is
/// held.
template<class Body>
void ForHeldHats(const RankLevels& levels, const MultiVector& received, Body&& body)
{
  const std::vector<Index>& hatOf = levels.Hats()->Own().Hats().functions.ofPoint;
  const std::vector<int> giver = levels.Space().Distribution().GiversOfPoints();
  for (Id place = 0; place < received.rows(); ++place)
  {
    if (hatOf[place] >= 0 && received(place, 0) != 0.0)
    {
      body(hatOf[place], place, double(giver[place]));
    }
  }
}

/// Collective. The lowest rank that has sent a held point of each hat.
MultiVector FirstGivers(const RankLevels& levels, const MultiVector& received)
{
  MultiVector first;
  levels.Space().Ranks().Together(
    [&]
    {
      first = MultiVector::Constant(levels.Numbering(0).Functions(), 1, Nobody);
      ForHeldHats(levels, received,
        [&](Index hat, Id, double giver) { first(hat, 0) = std::min(first(hat, 0), giver); });
    });
  levels.Rows(0).TakeLeast(first);
  return first;
}

/// Collective. The values that the first sender of each hat has for it; the least values if it has
/// several points.
MultiVector ValuesOfGivers(
  const RankLevels& levels, const MultiVector& first, const MultiVector& received)
{
  const Id columns = received.cols() - 1;
  MultiVector values;
  levels.Space().Ranks().Together(
    [&]
    {
      values = MultiVector::Constant(first.rows(), columns, Nobody);
      ForHeldHats(levels, received,
        [&](Index hat, Id place, double giver)
        {
          if (first(hat, 0) == giver)
          {
            values.row(hat) = values.row(hat).cwiseMin(received.row(place).tail(columns));
          }
        });
    });
  levels.Rows(0).TakeLeast(values);
  return values;
}

/// Held values on hats. A hat is 1 at its point, and every rank that has received the point may
/// hold it.
HeldValues HoldHats(const RankLevels& levels, const MultiVector& received)
{
  const MultiVector first = FirstGivers(levels, received);
  const MultiVector values = ValuesOfGivers(levels, first, received);
  HeldValues held;
  levels.Space().Ranks().Together(
    [&]
    {
      const std::vector<char>& isEvaluated = levels.Hats()->IsEvaluated();
      RowBuilder rows;
      std::vector<Index> hats;
      for (Index hat = 0; hat < static_cast<Index>(first.rows()); ++hat)
      {
        if (isEvaluated[hat] && first(hat, 0) != Nobody)
        {
          RowBuilder::Entries entries{ { hat, 1.0 } };
          rows.Append(entries);
          hats.push_back(hat);
        }
      }
      held.rows = rows.Finish(static_cast<Index>(first.rows()));
      held.values = values(hats, Eigen::indexing::all);
    });
  return held;
}

} // namespace

HeldValues HoldPoints(
  const RankLevels& levels, const std::vector<Id>& points, const MultiVector& values)
{
  return HoldReceived(levels, SendHeld(levels.Space(), points, values));
}

/// A rank that owns a cell has received all triangles with a part in it. The ranks choose the same
/// triangle of an edge, so that one of them samples each stretch.
HeldValues HoldPointsAndEdges(const RankLevels& levels, bool weldCoincidentPoints,
  const std::vector<Id>& points, const MultiVector& values)
{
  const RankSpace& space = levels.Space();
  const MultiVector received = SendHeld(space, points, values);
  HeldValues held = HoldReceived(levels, received);
  if (levels.Hats()) // they are linear along edges
  {
    return held;
  }
  space.Ranks().Together(
    [&]
    {
      const TriangleMesh& mesh = space.Own().Mesh();
      const Eigen::ArrayXd marks = received.col(0);
      std::vector<char> isHeld(marks.size());
      std::transform(
        marks.begin(), marks.end(), isHeld.begin(), [](double mark) { return mark != 0.0; });
      held = Join(
        held, HoldWithinEdges(space.Own(), mesh, EdgesBetween(mesh, isHeld, weldCoincidentPoints),
                received.rightCols(values.cols())));
    });
  return held;
}

HeldValues HoldReceived(const RankLevels& levels, const MultiVector& received)
{
  if (levels.Hats())
  {
    return HoldHats(levels, received);
  }
  HeldValues held;
  levels.Space().Ranks().Together([&] { held = HoldOnGrid(levels.Space(), received); });
  return held;
}

} // namespace gridfem
