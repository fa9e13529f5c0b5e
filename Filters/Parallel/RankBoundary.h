// Terms that the boundary of a surface on several ranks adds to an equation.
// [Equations/EdgeConditions.h]
#ifndef GridFEM_RankBoundary_h
#define GridFEM_RankBoundary_h

#include "Equations/EdgeConditions.h"
#include "Parallel/RankLevels.h"

namespace gridfem
{

/// Collective. The boundary terms, as on one rank: the load is complete in all rows, and each rank
/// gets the held rows of its part. An edge is on the boundary if no rank has another triangle with
/// it.
/// @param flux, values  rows = this rank's own points; null on all ranks or none
BoundaryTerms TermsOnBoundary(const RankLevels& levels, bool weldCoincidentPoints,
  const MultiVector* flux, const MultiVector* values);

/// Collective. This rank's part of the samples along the boundary.
EdgeSamples SampleBoundary(const RankLevels& levels, bool weldCoincidentPoints);

} // namespace gridfem

#endif
