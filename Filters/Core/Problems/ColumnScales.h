// Scales that keep the squares of all numbers of a problem in the range of numbers.
#ifndef GridFEM_ColumnScales_h
#define GridFEM_ColumnScales_h

#include "Algebra/DividedRows.h"
#include "Krylov/ConjugateGradients.h"

namespace gridfem
{

/// Per column the power of two that brings its largest entry in both blocks to about 1: not one bit
/// of a solution changes. 1 for columns of zeros and for those that are not finite. A block may
/// have no rows.
/// @param divided  where processes hold the rows together, the same scales in all of them
Eigen::RowVectorXd ScalesOf(
  const MultiVector& first, const MultiVector& second, const DividedRows* divided = nullptr);

/// Takes the scales out of a solution. Where that leaves the range of numbers, because its data are
/// near the largest one, it has not converged: SolveEnd::Breakdown.
void RemoveScales(const Eigen::RowVectorXd& scale, MultiVector& solution, SolveReport& report,
  const DividedRows* divided = nullptr);

/// How many numbers of each column are not finite, over all processes.
Columns CountNotFinite(const MultiVector& x, const DividedRows* divided = nullptr);

} // namespace gridfem

#endif
