// Reads the modes that the input of a filter carries, again if they change, in one process or on
// all ranks together.
#ifndef GridFEM_CarriedModes_h
#define GridFEM_CarriedModes_h

#include "Input/InputMesh.h"

#include "Solvers/SignatureSolver.h"

#include <string>

class vtkPolyData;

namespace gridfem
{

class InputSurface;

class CarriedModes
{
public:
  /// Returns no modes if the input carries none, or if they belong to another shape. Collective.
  /// Throws InvalidInput for arrays that do not fit.
  /// @param input  that of the surface: on a rank its own piece, which may be null
  GivenModes Update(InputSurface& surface, vtkPolyData* input);

  /// Whether the input has modes, but of another shape.
  bool AreOfAnotherShape() const { return !misfit_.empty(); }

  /// The warning about modes of another shape. Empty if there are none.
  /// @param input  the port, as in "input"
  std::string WarningOfShape(const std::string& input) const;

  /// Removes modes of another shape from an output.
  void RemoveMisfit(vtkPolyData* output) const;

  /// The mesh that the modes were read on.
  const InputMesh& Mesh() const { return mesh_; }

private:
  PointModes Read(InputSurface& surface, vtkPolyData* input);

  InputMesh mesh_;
  GivenModes given_;
  StageKey ghostKey_;  // of modes that were found to be of another shape
  std::string misfit_; // why the modes belong to another shape; empty if they do not
};

} // namespace gridfem

#endif
