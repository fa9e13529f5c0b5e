// Scales that keep the squares of all numbers of a problem within the range of floating point.
#ifndef GridFEM_ColumnScales_h
#define GridFEM_ColumnScales_h

#include "Algebra/DistributedRows.h"
#include "Krylov/ConjugateGradients.h"

namespace gridfem
{

/// The power of two per column that brings its largest entry in both blocks to about 1. Powers of
/// two change no bit of a solution. Columns of zeros and columns that are not finite get 1. A block
/// may have no rows.
/// @param distributed  if processes share the rows: all processes get the same scales
Eigen::RowVectorXd ScalesOf(const MultiVector& first, const MultiVector& second,
  const DistributedRows* distributed = nullptr);

/// Takes the scales out of a solution. If the data are near the largest number, the result may
/// leave the range of numbers. The report then says not converged, with SolveEnd::Breakdown.
void RemoveScales(const Eigen::RowVectorXd& scale, MultiVector& solution, SolveReport& report,
  const DistributedRows* distributed = nullptr);

/// Number of entries of each column that are not finite, over all processes.
Columns CountNotFinite(const MultiVector& x, const DistributedRows* distributed = nullptr);

} // namespace gridfem

#endif
