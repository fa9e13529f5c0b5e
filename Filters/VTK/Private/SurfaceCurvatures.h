// The principal curvatures of a filter's surface.
#ifndef GridFEM_SurfaceCurvatures_h
#define GridFEM_SurfaceCurvatures_h

#include "SurfaceSolverState.h"

#include "Problems/PrincipalCurvatures.h"

namespace gridfem
{

/// @param mesh   that of the state, or where nothing is smoothed any
/// @param scale  of the smoothing, in parameter units; 0: none, and the state's function space is
///               not looked at, else it has to be up to date
/// @param report of the smoothing
PrincipalCurvatures CurvaturesOfSurface(const SurfaceSolverState& state, const TriangleMesh& mesh,
  double scale, SolveReport& report, const Progress& progress);

} // namespace gridfem

#endif
