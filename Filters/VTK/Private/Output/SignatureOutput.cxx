#include "Output/SignatureOutput.h"

#include "Output/SolverOutput.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <sstream>

namespace gridfem
{
namespace
{

/// Adds a point array whose components are named by their scales.
void AddSignature(vtkPolyData* output, const char* name, const MultiVector& values,
  const char* symbol, const std::vector<double>& scales, int precision)
{
  auto array = MakePointArray(name, values, precision);
  for (std::size_t j = 0; j < scales.size(); ++j)
  {
    std::ostringstream component;
    component.precision(3);
    component << symbol << " = " << scales[j];
    array->SetComponentName(static_cast<vtkIdType>(j), component.str().c_str());
  }
  output->GetPointData()->AddArray(array);
}

} // namespace

void WriteSignatures(const SignatureSolver::Result& result, int precision, vtkPolyData* output)
{
  AddSignature(
    output, "WaveKernelSignature", result.waveKernel, "E", result.waveBands.energies, precision);
  AddSignature(output, "HeatKernelSignature", result.heatKernel, "t", result.heatTimes, precision);
  const auto middle = static_cast<Id>(result.heatTimes.size() / 2);
  output->GetPointData()->AddArray(
    MakePointArray("Signature", result.heatKernel.col(middle), precision));
  output->GetPointData()->SetActiveScalars("Signature");
  AddFieldNumbers(output, "HeatTimes", result.heatTimes);
  AddFieldNumbers(output, "WaveEnergies", result.waveBands.energies);
}

void WriteModeDistances(const SignatureSolver::Result& result, int precision, vtkPolyData* output)
{
  vtkPointData* points = output->GetPointData();
  points->AddArray(MakePointArray("DiffusionDistance", result.diffusionDistance, precision));
  points->AddArray(MakePointArray("BiharmonicDistance", result.biharmonicDistance, precision));
  points->SetActiveScalars("BiharmonicDistance");
}

void WriteSurrogates(
  const SignatureSolver::Result& result, vtkDataArray* given, vtkPolyData* output)
{
  const Id columns = result.coefficients.cols();
  for (Id k = 0; k * columns < result.surrogates.cols(); ++k)
  {
    const vtkSmartPointer<vtkDataArray> array = MakePointArray(NumberedName("Surrogate", k).c_str(),
      result.surrogates.middleCols(k * columns, columns), given->GetDataType());
    array->CopyComponentNames(given);
    output->GetPointData()->AddArray(array);
  }
  output->GetPointData()->SetActiveScalars("Surrogate000");
}

void WriteModeTable(const SignatureSolver::Result& result, vtkTable* table)
{
  const PointModes& modes = *result.modes;
  std::vector<int> number;
  std::vector<double> fingerprint;
  for (const double eigenvalue : modes.eigenvalues)
  {
    number.push_back(static_cast<int>(number.size()));
    fingerprint.push_back(modes.area * eigenvalue);
  }
  AddColumn(table, "Mode", number);
  AddColumn(table, "Eigenvalue", modes.eigenvalues);
  AddColumn(table, "ShapeDNA", fingerprint);
  if (result.coefficients.cols() > 0)
  {
    table->AddColumn(MakePointArray("Coefficient", result.coefficients, VTK_DOUBLE));
    table->AddColumn(MakePointArray("RemainingError", result.remaining, VTK_DOUBLE));
  }
}

} // namespace gridfem
