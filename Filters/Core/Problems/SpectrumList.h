// The end of a list of eigenpairs on the finest level: iterations until the wanted ones have
// converged, and where a multiplet ends.
#ifndef GridFEM_SpectrumList_h
#define GridFEM_SpectrumList_h

#include "Krylov/Lobpcg.h"

namespace gridfem
{

struct ListEnd
{
  Index zeros = 0;                 // values that are 0, in front of the pairs
  bool isAll = false;              // the pairs are all there are
  bool completeMultiplets = false; // more of them, until the multiplet at their end is whole
};

struct ListReport
{
  BlockReport block;          // of the pairs in the list
  bool cutsMultiplet = false; // the next eigenvalue belongs to the multiplet of the last
};

/// Pairs on the finest level from approximations.
/// @param block  as for ImproveManyEigenPairs; `wanted` is the length of the list without zeros
template<class Real>
ListReport FinishList(const SpectralProblem<Real>& problem, BlockOptions block, const ListEnd& end,
  EigenPairs<Real>& pairs, const Progress& progress);

} // namespace gridfem

#endif
