// Writes signatures, and distances by modes, as arrays and tables.
#ifndef GridFEM_SignatureOutput_h
#define GridFEM_SignatureOutput_h

#include "Solvers/SignatureSolver.h"

class vtkDataArray;
class vtkPolyData;
class vtkTable;

namespace gridfem
{

/// Adds the point arrays WaveKernelSignature, HeatKernelSignature and Signature, and the field
/// arrays HeatTimes and WaveEnergies.
void WriteSignatures(const SignatureSolver::Result& result, int precision, vtkPolyData* output);

/// Adds the point arrays DiffusionDistance and BiharmonicDistance.
void WriteModeDistances(const SignatureSolver::Result& result, int precision, vtkPolyData* output);

/// Adds the point arrays Surrogate000, Surrogate001, ... with the names of the components of the
/// given array: float if this array is float, else double.
void WriteSurrogates(
  const SignatureSolver::Result& result, vtkDataArray* given, vtkPolyData* output);

/// Adds the columns Mode, Eigenvalue and ShapeDNA, and with a filter Coefficient and
/// RemainingError.
void WriteModeTable(const SignatureSolver::Result& result, vtkTable* table);

} // namespace gridfem

#endif
