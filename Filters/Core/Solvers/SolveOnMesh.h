// Runs all steps of a solver at once, on a mesh of this process.
#ifndef GridFEM_SolveOnMesh_h
#define GridFEM_SolveOnMesh_h

#include "Solvers/LocalSurface.h"

#include <memory>
#include <utility>

namespace gridfem
{

/// Returns the result of a new solver. Throws what its Update throws.
/// @param result  where the solver keeps it
/// @param given   the arguments of Update between the surface and the job
template<class Solver, class Result, class... Given>
Result SolveOnMesh(Result Solver::*result, std::shared_ptr<const TriangleMesh> mesh,
  const SurfaceOptions& surfaceOptions, const Job& job, const Given&... given)
{
  Stages stages;
  LocalSurface surface(stages, std::move(mesh), surfaceOptions);
  Solver solver;
  solver.Update(surface, given..., job);
  return std::move(solver.*result);
}

} // namespace gridfem

#endif
