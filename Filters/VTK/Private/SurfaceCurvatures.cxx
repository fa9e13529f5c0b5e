#include "SurfaceCurvatures.h"

namespace gridfem
{

PrincipalCurvatures CurvaturesOfSurface(const SurfaceSolverState& state, const TriangleMesh& mesh,
  double scale, SolveReport& report, const Progress& progress)
{
  NormalSmoothing smoothing;
  smoothing.scale = scale > 0.0 ? state.LengthInWorldUnits(scale) : 0.0;
  smoothing.multigrid = state.options.multigrid;
  smoothing.solve = state.options.solve;
  return CurvaturesOfSurface(mesh, state.options.space.weldCoincidentPoints, state.space.get(),
    smoothing, report, state.MakeJob(progress));
}

} // namespace gridfem
