// The lowest eigenpairs of a level with few functions, by the dense solver.
#ifndef GridFEM_DenseSpectrum_h
#define GridFEM_DenseSpectrum_h

#include "Krylov/SpectralProblem.h"

namespace gridfem
{

/// Whether a level with this number of functions is small enough for this number of pairs.
bool IsDense(Id functions, Index blockSize);

/// The lowest pairs, up to `count`, or all pairs if there are fewer.
template<class Real>
EigenPairs<Real> SolveDense(const SpectralProblem<Real>& problem, Index count);

} // namespace gridfem

#endif
