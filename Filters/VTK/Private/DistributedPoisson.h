// The screened Poisson equation on the pieces of a surface that several MPI ranks hold: none of
// them gathers it. Without MPI there is no such way.
#ifndef GridFEM_DistributedPoisson_h
#define GridFEM_DistributedPoisson_h

#include "InputArray.h"
#include "Problems/Poisson.h"
#include "SurfaceSolverState.h"

#include <string>
#include <vector>

class vtkDataArray;

namespace gridfem
{

/// What is solved for. All but the arrays is the same on all ranks.
struct DistributedRequest
{
  InputArray value;    // none: the coordinates
  InputArray gradient; // or none
  InputArray scale;    // of the gradients, or none
  bool useValueGradient = false;
  double weight = 0.0; // λ in the parameter units
  double gradientScale = 1.0;
};

struct DistributedSolution
{
  MultiVector values;         // at the points of this rank's piece
  std::vector<char> isSolved; // per point; the others have no function
  int dataType = 0;           // of the values that are given, VTK_FLOAT or VTK_DOUBLE
  SolveReport report;
  SolutionAccuracy accuracy;
};

/// Collective, on the ranks of VTK's global controller. Nothing is kept.
/// @param mesh     of this rank's piece; without triangles where it has none, and no arrays then
/// @param options  a depth is chosen, functions are those of a grid
/// Throws on all ranks when it throws on one: Aborted on all, or the error on the first rank and
/// FailedElsewhere on the others.
DistributedSolution SolveDistributed(const InputMesh& mesh, const DistributedRequest& request,
  const SurfaceOptions& options, const Progress& progress);

} // namespace gridfem

#endif
