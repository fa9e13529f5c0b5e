// Numbers the hat functions of a mesh on several ranks, and lists the functions on this rank.
#ifndef GridFEM_HatNumbering_h
#define GridFEM_HatNumbering_h

#include "Parallel/LevelNumbering.h"

#include <vector>

namespace gridfem
{

/// Hats that a rank holds. Any two ranks list the hats that both hold in the same order.
struct HatList
{
  std::vector<Vec3> position; // position of its point, which identifies the hat on all ranks
  // The rank whose cells contain the point. It is asked which ranks hold the hat.
  std::vector<int> home;
};

/// Collective. Numbers the hats. A hat belongs to the lowest rank that holds it.
/// @param place  gets the place of each hat of the list in the numbering
LevelNumbering NumberHats(
  const Communicator& ranks, const HatList& hats, std::vector<Index>& place);

} // namespace gridfem

#endif
