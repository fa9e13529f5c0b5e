#include "Parallel/HeldPoints.h"

#include <algorithm>

namespace gridfem
{

namespace
{

/// Received points that this rank evaluates and that somebody holds, ascending; of those at one
/// place of one sheet the first.
std::vector<Id> PlacesOfHeld(const RankSpace& space, const MultiVector& received)
{
  const std::vector<Vec3>& position = space.Own().Mesh().points;
  const Array<Index>& patch = space.PointPatches();
  std::vector<Id> places;
  std::size_t first = 0; // of the places at the same position
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
    const bool isThere = std::any_of(places.begin() + static_cast<std::ptrdiff_t>(first),
      places.end(), [&](Id other) { return patch[other] == patch[place]; });
    if (!isThere)
    {
      places.push_back(place);
    }
  }
  return places;
}

} // namespace

HeldValues HoldPoints(
  const RankSpace& space, const std::vector<Id>& points, const MultiVector& values)
{
  MultiVector own; // 1 where a point is held, and its values
  space.Ranks().Together(
    [&]
    {
      own = MultiVector::Zero(space.Distribution().NumberOfOwnPoints(), 1 + values.cols());
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        own.row(points[k]) << 1.0, values.row(static_cast<Id>(k));
      }
    });
  const MultiVector received = space.Distribution().SendPoints(own);
  HeldValues held;
  space.Ranks().Together([&] { held = HoldReceived(space, received); });
  return held;
}

HeldValues HoldReceived(const RankSpace& space, const MultiVector& received)
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

} // namespace gridfem
