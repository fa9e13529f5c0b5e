// Several smoothers as one.
#ifndef GridFEM_SmootherSequence_h
#define GridFEM_SmootherSequence_h

#include "Multigrid/Smoother.h"

namespace gridfem
{

/// A forward sweep runs all forward, first to last; a backward sweep all backward, last to first:
/// the adjoint.
template<class Real>
std::unique_ptr<BasicSmoother<Real>> MakeSmootherSequence(
  std::vector<std::unique_ptr<BasicSmoother<Real>>> smoothers);

} // namespace gridfem

#endif
