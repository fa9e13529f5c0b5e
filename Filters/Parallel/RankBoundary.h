// What the boundary of a surface on several ranks adds to an equation. [Problems/EdgeConditions.h]
#ifndef GridFEM_RankBoundary_h
#define GridFEM_RankBoundary_h

#include "Parallel/RankLevels.h"
#include "Problems/EdgeConditions.h"

namespace gridfem
{

/// Collective. As on one rank: the load is whole in all rows, and each rank gets the rows of what
/// it holds. An edge is on the boundary where no rank has another triangle with it.
/// @param flux, values  rows = this rank's own points; null on all ranks or none
BoundaryTerms TermsOnBoundary(const RankLevels& levels, bool weldCoincidentPoints,
  const MultiVector* flux, const MultiVector* values);

} // namespace gridfem

#endif
