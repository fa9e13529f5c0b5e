// The biharmonic function with given values at many points of a surface.
#ifndef GridFEM_BiharmonicIteration_h
#define GridFEM_BiharmonicIteration_h

#include "Problems/HarmonicInterpolation.h"

namespace gridfem
{

/// The least ∫ |Δu|², uᵀ L M⁻¹ L u, among the functions with C u = g. Where C u = g, L may be K = L
/// + Cᵀ W C in it, with a penalty W, but for a term that is linear: with multipliers W ν
///   u = K⁻¹ (M K⁻¹ Cᵀ W ν + Cᵀ W g),   S ν = W (g - C K⁻¹ Cᵀ W g),   S = W C K⁻¹ M K⁻¹ Cᵀ W.
/// The columns of K⁻¹ Cᵀ W are nearly harmonic functions that are 1 at one point and 0 at all
/// others, and S is the matrix of their inner products: conditioned by how the points lie, not by
/// how many they are. Conjugate gradients solve with it, with the sums of its rows as
/// preconditioner: the area around each point. A product takes two solves with K, by multigrid.
/// Last a harmonic function takes away what is left of the misfit.
/// @param rows    RowsAtPoints of the points; what contradicts itself is replaced beforehand by
/// what
///   a harmonic function meets of it
/// @param values  rows = points, one column per component
/// @return  components without a point are left at 0; the report is that of conjugate gradients
/// Throws Aborted. Same bits for any number of threads.
ConstrainedSolution IterateBiharmonic(const FiniteElementSpace& space, const SparseMatrix& rows,
  const MultiVector& values, const InterpolationOptions& options, const Progress& progress = {});

} // namespace gridfem

#endif
