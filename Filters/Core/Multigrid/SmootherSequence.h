// Several smoothers as one.
#ifndef GridFEM_SmootherSequence_h
#define GridFEM_SmootherSequence_h

#include "Multigrid/Smoother.h"

namespace gridfem
{

/// A forward sweep runs all forward, first to last; a backward sweep all backward, last to first:
/// the adjoint.
std::unique_ptr<Smoother> MakeSmootherSequence(std::vector<std::unique_ptr<Smoother>> smoothers);

} // namespace gridfem

#endif
