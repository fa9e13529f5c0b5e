// The modes that the input of a filter carries, read again when they change, in one process or on
// all ranks together.
#ifndef GridFEM_CarriedModes_h
#define GridFEM_CarriedModes_h

#include "InputMesh.h"

#include "Solvers/SignatureSolver.h"

#include <string>

class vtkPolyData;

namespace gridfem
{

class SurfaceSolverState;

class CarriedModes
{
public:
  /// None where the input carries no modes, or those of another shape. Collective. Throws
  /// InvalidInput for arrays that do not fit.
  /// @param input  the own piece of a rank, which may be null
  GivenModes Update(SurfaceSolverState& state, vtkPolyData* input);

  /// Why the modes are those of another shape; empty when they are not.
  const std::string& Misfit() const { return misfit_; }

  /// What the modes were read on.
  const InputMesh& Mesh() const { return mesh_; }

private:
  PointModes Read(SurfaceSolverState& state, vtkPolyData* input);
  PointModes ReadTogether(SurfaceSolverState& state, vtkPolyData* piece);

  InputMesh mesh_;
  GivenModes given_;
  StageKey foreignKey_; // of modes that were found to be of another shape
  std::string misfit_;
};

} // namespace gridfem

#endif
