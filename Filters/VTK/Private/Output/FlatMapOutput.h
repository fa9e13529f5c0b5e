// Writes the flat map of a surface.
#ifndef GridFEM_FlatMapOutput_h
#define GridFEM_FlatMapOutput_h

#include "Input/InputMesh.h"
#include "Solvers/ParameterizationSolver.h"

class vtkPolyData;

namespace gridfem
{

/// Adds the arrays that vtkParameterization describes to a copy of the input.
void AddFlatMap(
  const ParameterizationSolver::Result& result, const InputMesh& mesh, vtkPolyData* output);

/// Writes the flat triangles with the arrays of the input. They lie beside the surface, toward
/// larger x. Throws InvalidInput naming an array of wrong length.
void WriteFlatMap(const ParameterizationSolver::Result& result, const InputMesh& mesh,
  vtkPolyData* input, vtkPolyData* output);

} // namespace gridfem

#endif
