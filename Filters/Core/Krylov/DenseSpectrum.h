// The lowest eigenpairs of a level with few functions, by the dense solver.
#ifndef GridFEM_DenseSpectrum_h
#define GridFEM_DenseSpectrum_h

#include "Krylov/SpectralProblem.h"

namespace gridfem
{

/// Whether a level with so many functions is small enough for so many pairs.
bool IsDense(Id functions, Index blockSize);

/// All of the lowest pairs there are, up to `count`.
template<class Real>
EigenPairs<Real> SolveDense(const SpectralProblem<Real>& problem, Index count);

} // namespace gridfem

#endif
