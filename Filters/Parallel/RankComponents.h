// Connected components of a surface on several ranks.
#ifndef GridFEM_RankComponents_h
#define GridFEM_RankComponents_h

#include "Parallel/RankRows.h"
#include "Spaces/SpaceLevels.h"

namespace gridfem
{

/// Collective. Components of the whole surface, in the order of their first functions' numbers.
/// @param part  components of this rank's part of the surface, functions as in the numbering
Components ComponentsOfRanks(const Communicator& ranks, const LevelNumbering& numbering,
  const RankRows& rows, const Components& part);

} // namespace gridfem

#endif
