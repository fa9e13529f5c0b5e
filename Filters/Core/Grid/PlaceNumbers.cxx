#include "Grid/PlaceNumbers.h"

#include "Base/Errors.h"
#include "Base/Parallel.h"
#include "Base/SortEachOnce.h"

#include <algorithm>
#include <cstring>

namespace gridfem
{

std::uint64_t HashPlace(const Place& place)
{
  std::uint64_t hash = 0;
  for (const double coordinate : place)
  {
    const double value = coordinate + 0.0; // turns -0 into 0
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return hash;
}

PlaceNumbers::PlaceNumbers(std::vector<Place> places) : places_(std::move(places))
{
  SortEachOnce(places_);
  RequireIndices(static_cast<double>(places_.size()), "places of points");
  std::size_t size = 64;
  while (size < 16 * places_.size())
  {
    size *= 2;
  }
  mayBe_.assign(size, 0);
  for (const Place& place : places_)
  {
    mayBe_[HashPlace(place) & (size - 1)] = 1;
  }
}

Index PlaceNumbers::Of(const Place& place) const
{
  if (!mayBe_[HashPlace(place) & (mayBe_.size() - 1)])
  {
    return None;
  }
  const auto found = std::lower_bound(places_.begin(), places_.end(), place);
  return found != places_.end() && *found == place ? static_cast<Index>(found - places_.begin())
                                                   : None;
}

std::vector<Index> PlaceNumbers::OfPoints(const std::vector<Vec3>& points, int threads) const
{
  std::vector<Index> numbers(points.size());
  ParallelRanges(static_cast<Id>(points.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id point = begin; point < end; ++point)
      {
        numbers[point] = this->Of(PlaceOf(points[point]));
      }
    });
  return numbers;
}

std::vector<Id> PlaceNumbers::LowestPoints(const std::vector<Index>& numberOfPoint) const
{
  std::vector<Id> lowest(places_.size(), None);
  for (std::size_t point = numberOfPoint.size(); point-- > 0;)
  {
    if (numberOfPoint[point] != None)
    {
      lowest[numberOfPoint[point]] = static_cast<Id>(point);
    }
  }
  return lowest;
}

} // namespace gridfem
