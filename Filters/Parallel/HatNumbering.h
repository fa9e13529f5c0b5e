// Which hat functions of a mesh that several ranks hold together are here, and their numbers.
#ifndef GridFEM_HatNumbering_h
#define GridFEM_HatNumbering_h

#include "Parallel/LevelNumbering.h"

#include <vector>

namespace gridfem
{

/// Hats that a rank holds, in an order that any two ranks have for those that both hold.
struct HatList
{
  std::vector<Vec3> position; // of its point, which tells the hat on all ranks
  std::vector<int> home; // the rank whose cells contain the point: it is asked who holds the hat
};

/// Collective. A hat belongs to the lowest rank that holds it.
/// @param place  gets the place of each hat of the list in the numbering
LevelNumbering NumberHats(
  const Communicator& ranks, const HatList& hats, std::vector<Index>& place);

} // namespace gridfem

#endif
