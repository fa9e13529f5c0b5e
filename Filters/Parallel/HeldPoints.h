// Held values at points of a surface on several ranks.
#ifndef GridFEM_HeldPoints_h
#define GridFEM_HeldPoints_h

#include "Equations/EdgeConditions.h"
#include "Parallel/RankLevels.h"

#include <vector>

namespace gridfem
{

/// Collective. HoldPoints for several ranks; each rank gets the rows of the points that it
/// evaluates. Points of several ranks at the same place of one sheet count as one, with the value
/// of the first.
/// @param points  this rank's own, each once
/// @param values  a row for each; the same columns on all ranks
HeldValues HoldPoints(
  const RankLevels& levels, const std::vector<Id>& points, const MultiVector& values);

/// Collective. HoldPointsAndEdges for several ranks.
HeldValues HoldPointsAndEdges(const RankLevels& levels, bool weldCoincidentPoints,
  const std::vector<Id>& points, const MultiVector& values);

/// Collective. The held values at the points that this rank has received.
/// @param received  rows = received points: a number that is not 0 where a point is held, then its
///   values
HeldValues HoldReceived(const RankLevels& levels, const MultiVector& received);

} // namespace gridfem

#endif
