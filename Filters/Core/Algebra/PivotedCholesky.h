// Cholesky factorization with diagonal pivoting, for semi-definite matrices.
#ifndef GridFEM_PivotedCholesky_h
#define GridFEM_PivotedCholesky_h

#include "Base/Types.h"

#include <vector>

namespace gridfem
{

/// Factorizes P S Pᵀ = L Lᵀ. Each pivot is the largest remaining diagonal entry; it stops when none
/// is above `smallestPivot`. The leading rank x rank lower triangle of S becomes L. The rest of S
/// is undefined. The algorithm is blocked like LAPACK's dpstrf: it updates the trailing matrix once
/// per panel.
/// @param S  symmetric, both triangles filled; NaN is never a pivot
/// @return   the rows of the original S that hold the pivots, in order of pivoting; their number is
///   the rank
std::vector<Index> PivotedCholesky(Eigen::MatrixXd& S, double smallestPivot);

} // namespace gridfem

#endif
