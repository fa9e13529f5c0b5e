// Numbers places by their exact coordinates. The numbers do not depend on the process that lists
// the places or on their order.
#ifndef GridFEM_PlaceNumbers_h
#define GridFEM_PlaceNumbers_h

#include "Base/Types.h"

#include <array>
#include <vector>

namespace gridfem
{

/// Coordinates that are compared exactly (-0 = 0).
using Place = std::array<double, 3>;

inline Place PlaceOf(const Vec3& point)
{
  return { point[0], point[1], point[2] };
}

inline Vec3 PointAt(const Place& place)
{
  return { place[0], place[1], place[2] };
}

/// Mixes the bits of the coordinates. Equal places give equal values.
std::uint64_t HashPlace(const Place& place);

class PlaceNumbers
{
public:
  static constexpr Index None = -1;

  /// @param places  in any order; those that occur several times count once
  explicit PlaceNumbers(std::vector<Place> places);

  /// The places, ascending. The place with number k is the k-th.
  const std::vector<Place>& Places() const { return places_; }
  Index Count() const { return static_cast<Index>(places_.size()); }

  /// Returns the number of a place, or None.
  Index Of(const Place& place) const;

  /// Returns the number of the place where each point stands, or None.
  std::vector<Index> OfPoints(const std::vector<Vec3>& points, int threads) const;

  /// Returns the lowest point at each place, or None.
  std::vector<Id> LowestPoints(const std::vector<Index>& numberOfPoint) const;

private:
  std::vector<Place> places_;
  std::vector<char> mayBe_; // by the hash: whether there can be a place
};

} // namespace gridfem

#endif
