// Writes solutions and reports of Core as VTK arrays and tables.
#ifndef GridFEM_SolverOutput_h
#define GridFEM_SolverOutput_h

#include "Base/Types.h"
#include "Input/InputArray.h"
#include "Krylov/ConjugateGradients.h"
#include "Solvers/SolveWarnings.h"

#include "vtkSmartPointer.h"

#include <array>
#include <string>
#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkInformationVector;
class vtkPolyData;
class vtkTable;

namespace gridfem
{

/// Returns an array with one tuple per row. It is float if `dataType` is VTK_FLOAT, else double.
vtkSmartPointer<vtkDataArray> MakePointArray(
  const char* name, const MultiVector& values, int dataType);

/// The same with one component.
vtkSmartPointer<vtkDataArray> MakePointArray(
  const char* name, const std::vector<double>& values, int dataType);

/// Makes a cell array active, and no point array, because ParaView colors by points first.
void ColorByCells(vtkPolyData* output, const char* name);

///@{ Returns an array of ids with one component, or with three for corners of triangles.
vtkSmartPointer<vtkDataArray> MakeIdArray(const char* name, const std::vector<Id>& ids);
vtkSmartPointer<vtkDataArray> MakeIdArray(
  const char* name, const std::vector<std::array<Id, 3>>& corners);
///@}

/// Returns the array of a solution for a chosen array, with the names of its components. It is of
/// bytes if the chosen array holds colors, float if the chosen array is float, else double. Colors
/// are rounded and clamped. Points without a solution (NaN) keep their given color, or become
/// black.
/// @param dataType  the type of the chosen array on all ranks
vtkSmartPointer<vtkDataArray> MakeSolution(
  const char* name, const MultiVector& values, const InputArray& given, int dataType);

/// Restores the given values where a solution has none, NaN.
/// @param given  has as many components as `values` has columns
void KeepUnsolved(vtkDataArray* given, MultiVector& values);

/// Adds the field arrays Converged, Iterations, DoublePrecisionSince (iteration of the fall-back;
/// -1: none), Residual, ConvergenceFactor (mean per iteration) and Device.
void AddReport(const SolveReport& report, vtkPolyData* output);

/// Adds the field arrays DiscretizationError, LargestDiscretizationError, AlgebraicError and
/// TrustedEstimate. The second is in units of the solution, the first and the third are relative.
/// Unknown errors are NaN.
void AddAccuracy(const SolutionAccuracy& accuracy, vtkPolyData* output);

/// Adds a field array with one int.
void AddFieldInt(vtkPolyData* output, const char* name, int value);

/// Adds the field array Device: the device that computed cycles, and the reason if it is the CPU.
/// Adds nothing if there were none.
void AddDevice(const std::string& where, vtkPolyData* output);

/// The field array that is 1 if ranks have computed together.
constexpr const char* DistributedName = "Distributed";

/// Empties the data sets and tables of all outputs. The structure of composite data stays.
void EmptyOutputs(vtkInformationVector* outputs);

/// Removes field arrays that report on an earlier run from an output: `Converged`, `Misfit`, and
/// all others that filters add. They are those of its input that this run has not replaced. Arrays
/// that belong to data which stay, such as `Eigenvalues`, stay.
/// @param input  may be null
void RemoveGivenReports(vtkDataObject* input, vtkDataObject* output);

///@{ Adds a field array with one number, or with some.
void AddFieldNumber(vtkPolyData* output, const char* name, double value);
void AddFieldNumbers(vtkPolyData* output, const char* name, const std::vector<double>& values);
///@}

/// Adds the columns Iteration, EnergyResidual, Residual, ConvergenceFactor, Log10EnergyResidual and
/// Log10Residual. ConvergenceFactor is the energy residual divided by the residual of the row
/// before; 1 in the first row.
void WriteHistory(const SolveReport& report, vtkTable* table);

/// Adds the columns AlgebraicError, after the correction of each row, and DiscretizationError, with
/// their logarithms.
void AddErrors(const SolveReport& report, const SolutionAccuracy& accuracy, vtkTable* table);

/// Writes a text as a table that ParaView shows in the 3D view.
void WriteText(const std::string& text, vtkTable* table);

/// Returns a name such as Mode007, with three digits or more.
std::string NumberedName(const char* stem, Id number);

/// Returns a number with four digits, for a text.
std::string ShortNumber(double number);

/// Adds a column of numbers to a table.
void AddColumn(vtkTable* table, const char* name, const std::vector<double>& values);

/// Adds a column of integers to a table.
void AddColumn(vtkTable* table, const char* name, const std::vector<int>& values);

} // namespace gridfem

#endif
