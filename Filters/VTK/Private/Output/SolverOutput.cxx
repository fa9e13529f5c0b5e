#include "Output/SolverOutput.h"

#include "Pipeline/Allocation.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace gridfem
{
namespace
{

template<class Array>
vtkSmartPointer<vtkDataArray> CopyRows(const char* name, const MultiVector& values)
{
  auto array = NewArray<Array>(name, values.rows(), static_cast<int>(values.cols()));
  std::transform(values.data(), values.data() + values.size(), array->GetPointer(0),
    [](double value) { return static_cast<typename Array::ValueType>(value); });
  return array;
}

template<class Array, class Value>
vtkSmartPointer<Array> CopyValues(const char* name, const std::vector<Value>& values)
{
  auto array = NewArray<Array>(name, static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

/// Returns the logarithm. An exact zero gives the logarithm of the smallest number instead of minus
/// infinity.
double SafeLog10(double value)
{
  return std::log10(std::max(value, std::numeric_limits<double>::min()));
}

/// Empties the data sets and tables of an output. The structure of composite data stays.
/// @param output  may be null
void EmptyLeaves(vtkDataObject* output)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(output);
  if (!composite)
  {
    if (output)
    {
      output->Initialize();
    }
    return;
  }
  auto leaf = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    leaf->GetCurrentDataObject()->Initialize();
  }
}

} // namespace

void EmptyOutputs(vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    EmptyLeaves(vtkDataObject::GetData(outputs, port));
  }
}

vtkSmartPointer<vtkDataArray> MakePointArray(
  const char* name, const MultiVector& values, int dataType)
{
  return dataType == VTK_FLOAT ? CopyRows<vtkFloatArray>(name, values)
                               : CopyRows<vtkDoubleArray>(name, values);
}

vtkSmartPointer<vtkDataArray> MakePointArray(
  const char* name, const std::vector<double>& values, int dataType)
{
  const Eigen::Map<const Eigen::VectorXd> column(
    values.data(), static_cast<Eigen::Index>(values.size()));
  return MakePointArray(name, MultiVector(column), dataType);
}

void ColorByCells(vtkPolyData* output, const char* name)
{
  output->GetPointData()->SetActiveScalars(nullptr);
  output->GetCellData()->SetActiveScalars(name);
}

vtkSmartPointer<vtkDataArray> MakeIdArray(const char* name, const std::vector<Id>& ids)
{
  return CopyValues<vtkIdTypeArray>(name, ids);
}

vtkSmartPointer<vtkDataArray> MakeIdArray(
  const char* name, const std::vector<std::array<Id, 3>>& corners)
{
  auto array = NewArray<vtkIdTypeArray>(name, static_cast<vtkIdType>(corners.size()), 3);
  vtkIdType* next = array->GetPointer(0);
  for (const std::array<Id, 3>& ids : corners)
  {
    next = std::copy(ids.begin(), ids.end(), next);
  }
  return array;
}

void AddFieldInt(vtkPolyData* output, const char* name, int value)
{
  output->GetFieldData()->AddArray(CopyValues<vtkIntArray>(name, std::vector<int>{ value }));
}

void AddFieldNumber(vtkPolyData* output, const char* name, double value)
{
  AddFieldNumbers(output, name, { value });
}

void AddFieldNumbers(vtkPolyData* output, const char* name, const std::vector<double>& values)
{
  output->GetFieldData()->AddArray(CopyValues<vtkDoubleArray>(name, values));
}

void KeepUnsolved(vtkDataArray* given, MultiVector& values)
{
  for (Id point = 0; point < values.rows(); ++point)
  {
    for (Id c = 0; c < values.cols(); ++c)
    {
      if (std::isnan(values(point, c)))
      {
        values(point, c) = given->GetComponent(point, static_cast<int>(c));
      }
    }
  }
}

namespace
{

bool AreColors(const MultiVector& values, int dataType)
{
  return dataType == VTK_UNSIGNED_CHAR && (values.cols() == 3 || values.cols() == 4);
}

vtkSmartPointer<vtkDataArray> MakeColors(
  const char* name, MultiVector values, const InputArray& given)
{
  if (given.association == FieldAssociation::Points && given.isOfSurface)
  {
    KeepUnsolved(given.array, values);
  }
  values = values.array().isNaN().select(0.0, values);
  return CopyRows<vtkUnsignedCharArray>(name, values.array().round().cwiseMax(0.0).cwiseMin(255.0));
}

} // namespace

vtkSmartPointer<vtkDataArray> MakeSolution(
  const char* name, const MultiVector& values, const InputArray& given, int dataType)
{
  auto array = AreColors(values, dataType) ? MakeColors(name, values, given)
                                           : MakePointArray(name, values, dataType);
  array->CopyComponentNames(given.array);
  return array;
}

void AddDevice(const std::string& where, vtkPolyData* output)
{
  if (!where.empty())
  {
    const vtkNew<vtkStringArray> array;
    array->SetName("Device");
    array->InsertNextValue(where);
    output->GetFieldData()->AddArray(array);
  }
}

void RemoveGivenReports(vtkDataObject* input, vtkDataObject* output)
{
  constexpr const char* Reports[] = { "Device", "Converged", "Iterations", "DoublePrecisionSince",
    "Residual", "ConvergenceFactor", "DiscretizationError", "LargestDiscretizationError",
    "AlgebraicError", "TrustedEstimate", "Misfit", "UsualCurvature", "LargestStretchRatio",
    "HeatSweeps", "LeaveOneOutRatio", "LogLikelihood", "TurnedTriangles", "CopiedTriangles",
    "UsedDepth", DistributedName };
  for (const char* name : Reports)
  {
    vtkAbstractArray* given = input ? input->GetFieldData()->GetAbstractArray(name) : nullptr;
    if (given && output->GetFieldData()->GetAbstractArray(name) == given)
    {
      output->GetFieldData()->RemoveArray(name);
    }
  }
}

void AddReport(const SolveReport& report, vtkPolyData* output)
{
  AddDevice(report.where, output);
  AddFieldInt(output, "Converged", report.converged ? 1 : 0);
  AddFieldInt(output, "Iterations", report.iterations);
  AddFieldInt(output, "DoublePrecisionSince", report.doubleSince);
  AddFieldNumber(output, "Residual", LastRecord(report).residual);
  AddFieldNumber(output, "ConvergenceFactor", report.convergenceFactor);
}

void AddAccuracy(const SolutionAccuracy& accuracy, vtkPolyData* output)
{
  AddFieldNumber(output, "DiscretizationError", accuracy.discretization);
  AddFieldNumber(output, "LargestDiscretizationError", accuracy.largest);
  AddFieldNumber(output, "AlgebraicError", accuracy.algebraic);
  AddFieldInt(output, "TrustedEstimate", accuracy.isTrusted ? 1 : 0);
}

void AddErrors(const SolveReport& report, const SolutionAccuracy& accuracy, vtkTable* table)
{
  const std::size_t rows = report.history.size();
  std::vector<double> algebraic;
  std::vector<double> logAlgebraic;
  for (const IterationRecord& record : report.history)
  {
    algebraic.push_back(std::isnan(accuracy.algebraic) ? accuracy.algebraic : record.own);
    logAlgebraic.push_back(SafeLog10(algebraic.back()));
  }
  const double logDiscretization = SafeLog10(accuracy.discretization);
  AddColumn(table, "AlgebraicError", algebraic);
  AddColumn(table, "DiscretizationError", std::vector<double>(rows, accuracy.discretization));
  AddColumn(table, "Log10AlgebraicError", logAlgebraic);
  AddColumn(table, "Log10DiscretizationError", std::vector<double>(rows, logDiscretization));
}

void WriteText(const std::string& text, vtkTable* table)
{
  vtkNew<vtkStringArray> column;
  column->SetName("Text");
  column->InsertNextValue(text);
  table->AddColumn(column);
}

std::string NumberedName(const char* stem, Id number)
{
  std::ostringstream name;
  name << stem << std::setw(3) << std::setfill('0') << number;
  return name.str();
}

std::string ShortNumber(double number)
{
  std::ostringstream text;
  text.precision(4);
  text << number;
  return text.str();
}

void AddColumn(vtkTable* table, const char* name, const std::vector<double>& values)
{
  table->AddColumn(CopyValues<vtkDoubleArray>(name, values));
}

void AddColumn(vtkTable* table, const char* name, const std::vector<int>& values)
{
  table->AddColumn(CopyValues<vtkIntArray>(name, values));
}

void WriteHistory(const SolveReport& report, vtkTable* table)
{
  std::vector<int> iteration;
  std::vector<double> energy;
  std::vector<double> residual;
  std::vector<double> logEnergy;
  std::vector<double> logResidual;
  std::vector<double> factor;
  for (const IterationRecord& record : report.history)
  {
    iteration.push_back(record.iteration);
    factor.push_back(energy.empty() || energy.back() == 0.0 ? 1.0 : record.energy / energy.back());
    energy.push_back(record.energy);
    residual.push_back(record.residual);
    logEnergy.push_back(SafeLog10(record.energy));
    logResidual.push_back(SafeLog10(record.residual));
  }
  AddColumn(table, "Iteration", iteration);
  AddColumn(table, "EnergyResidual", energy);
  AddColumn(table, "Residual", residual);
  AddColumn(table, "ConvergenceFactor", factor);
  AddColumn(table, "Log10EnergyResidual", logEnergy);
  AddColumn(table, "Log10Residual", logResidual);
}

} // namespace gridfem
