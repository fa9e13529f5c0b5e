// States from which patterns and waves begin.
#ifndef GridFEM_DynamicsStart_h
#define GridFEM_DynamicsStart_h

#include "Solvers/DynamicsSolver.h"

namespace gridfem
{

/// Returns the state at time 0 at points of the mesh: a column for each unknown. It is the given
/// start, a bump around the disturbed points, noise for reactions, or else a bump around a point
/// that the seed chooses. Noise is a sum of waves in space, so it depends on the shape but not on
/// its points. The report is that of the heat that makes a bump. Same bits for any number of
/// threads. Throws InvalidInput and Aborted.
Field StartField(const Surface& surface, const DynamicsSolver::Input& input,
  const DynamicsSolver::Options& options, SolveReport& report, const Job& job);

} // namespace gridfem

#endif
