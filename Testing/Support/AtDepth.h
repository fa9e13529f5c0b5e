// Options of a surface whose grid has a given depth.
#ifndef GridFEM_Testing_AtDepth_h
#define GridFEM_Testing_AtDepth_h

#include "Solvers/SurfaceOptions.h"

namespace gridfem::testing
{

inline SurfaceOptions AtDepth(int depth, SurfaceOptions options = {})
{
  options.space.depth = depth;
  return options;
}

/// Returns the defaults of a solver in everything else.
template<class Solver>
SurfaceOptions AtDepth(int depth)
{
  return AtDepth(depth, Solver::SurfaceDefaults());
}

} // namespace gridfem::testing

#endif
