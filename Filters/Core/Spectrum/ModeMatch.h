// Compares the modes of a level with the modes of a coarser level. Modes are matched by their
// functions, because eigenvalues that are close to each other may change places between levels.
#ifndef GridFEM_ModeMatch_h
#define GridFEM_ModeMatch_h

#include "Krylov/SpectralProblem.h"
#include "Spectrum/SpectrumAccuracy.h"

namespace gridfem
{

/// Assigns numbers of the modes of a coarser level to the modes of this level. A mode takes the
/// mean of the coarser numbers, weighted by the fourth powers of the products of the functions.
/// With squares, a small part of a far higher mode would count. The numbers of a mode are NaN if
/// half of it is in no coarser mode with a number.
/// @param prolongation  from the coarser level to the level of the problem
/// @param coarser       orthonormal modes of the coarser level
/// @param numbers       rows = coarser modes; NaN where unknown
/// @return              rows = `modes`, columns as `numbers`
/// Collective if processes divide the level. Cost: a product with the mass, and one of all modes
/// with all coarser modes.
template<class Real>
Eigen::MatrixXd MatchNumbers(const SpectralProblem<Real>& problem, const ConstBlock<Real>& modes,
  const SparseMatrix& prolongation, const ConstBlock<Real>& coarser,
  const Eigen::MatrixXd& numbers);

} // namespace gridfem

#endif
