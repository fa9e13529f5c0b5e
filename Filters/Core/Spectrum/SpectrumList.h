// Completes a list of eigenpairs on the finest level. It iterates until the wanted pairs have
// converged, and decides whether the list ends inside a multiplet.
#ifndef GridFEM_SpectrumList_h
#define GridFEM_SpectrumList_h

#include "Krylov/Lobpcg.h"

namespace gridfem
{

/// The progress after the next round of work on a list. Most lists take one round.
inline double AfterRound(double done)
{
  return 0.9 + 0.1 * done;
}

struct ListEnd
{
  Index zeros = 0;                 // number of zero values in front of the pairs
  bool isAll = false;              // no pairs exist beyond these
  bool completeMultiplets = false; // add pairs until the multiplet at the end is complete
};

struct ListReport
{
  BlockReport block;          // of the pairs in the list
  bool cutsMultiplet = false; // the next eigenvalue belongs to the multiplet of the last
};

/// Improves approximate pairs on the finest level to the final list.
/// @param block  as for ImproveManyEigenPairs; `wanted` is the length of the list without zeros
template<class Real>
ListReport FinishList(const SpectralProblem<Real>& problem, BlockOptions block, const ListEnd& end,
  EigenPairs<Real>& pairs, const Progress& progress);

} // namespace gridfem

#endif
