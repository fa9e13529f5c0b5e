// The biharmonic function with given values at many points of a surface.
#ifndef GridFEM_BiharmonicIteration_h
#define GridFEM_BiharmonicIteration_h

#include "Equations/HarmonicInterpolation.h"

namespace gridfem
{

/// Minimizes ∫ |Δu|², that is uᵀ L M⁻¹ L u, among the functions with C u = g. L may be replaced by
/// K = L + Cᵀ W C with a penalty W, because both differ only by a linear term where C u = g. The
/// solution with the multipliers W ν is
///   u = K⁻¹ (M K⁻¹ Cᵀ W ν + Cᵀ W g),
///   S ν = W (g - C K⁻¹ Cᵀ W g),
///   S = W C K⁻¹ M K⁻¹ Cᵀ W.
/// The columns of K⁻¹ Cᵀ W are nearly harmonic functions that are 1 at one point and 0 at all
/// others. S is the matrix of their inner products. Its condition depends on the positions of the
/// points, not on their number. Conjugate gradients solve with S. Their preconditioner is the row
/// sums of S: the area around each point. A product with S takes two solves with K, by multigrid.
/// Finally, a harmonic function removes the remaining misfit.
/// @param rows    RowsAtPoints of the points. Contradictory values are first replaced by the values
///   that a harmonic function reaches.
/// @param values  rows = points, one column per component
/// @return        components without a point are left at 0; the report is that of conjugate
///   gradients
/// Throws Aborted. Same bits for any number of threads.
ConstrainedSolution IterateBiharmonic(const FiniteElementSpace& space, const SparseMatrix& rows,
  const MultiVector& values, const InterpolationOptions& options, const Progress& progress = {});

} // namespace gridfem

#endif
