// Cholesky with diagonal pivoting for semi-definite matrices.
#ifndef GridFEM_PivotedCholesky_h
#define GridFEM_PivotedCholesky_h

#include "Base/Types.h"

#include <vector>

namespace gridfem
{

/// P S Pᵀ = L Lᵀ, where the largest remaining diagonal is the next pivot, until none is above
/// `smallestPivot`. Overwrites S: its leading rank x rank lower triangle is L, the rest is garbage.
/// @param S  symmetric, both triangles; NaN is never a pivot
/// @return   the pivots' rows of the original S in their order; their number is the rank
/// Blocked like LAPACK's dpstrf: the trailing matrix is updated once per panel.
std::vector<Index> PivotedCholesky(Eigen::MatrixXd& S, double smallestPivot);

} // namespace gridfem

#endif
