// Values that are held at points of a surface on several ranks.
#ifndef GridFEM_HeldPoints_h
#define GridFEM_HeldPoints_h

#include "Parallel/RankLevels.h"
#include "Problems/EdgeConditions.h"

#include <vector>

namespace gridfem
{

/// Collective. As HoldPoints on one rank; each rank gets the rows of the points that it evaluates.
/// Points of several ranks at the same place of one sheet are one, which has the value of the first
/// of them.
/// @param points  this rank's own, each once
/// @param values  a row for each; the same columns on all ranks
HeldValues HoldPoints(
  const RankLevels& levels, const std::vector<Id>& points, const MultiVector& values);

/// Collective. What this rank holds of the points that it has received.
/// @param received  rows = received points: not 0 where a point is held, then its values
HeldValues HoldReceived(const RankLevels& levels, const MultiVector& received);

} // namespace gridfem

#endif
