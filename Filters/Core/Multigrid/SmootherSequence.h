// Several smoothers combined to one.
#ifndef GridFEM_SmootherSequence_h
#define GridFEM_SmootherSequence_h

#include "Multigrid/Smoother.h"

namespace gridfem
{

/// A forward sweep runs all smoothers forward, first to last. A backward sweep is its adjoint: all
/// smoothers backward, last to first.
template<class Real>
std::unique_ptr<BasicSmoother<Real>> MakeSmootherSequence(
  std::vector<std::unique_ptr<BasicSmoother<Real>>> smoothers);

} // namespace gridfem

#endif
