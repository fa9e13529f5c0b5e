#include "vtkSurfaceGradient.h"

#include "Input/InputArray.h"
#include "Output/SolverOutput.h"
#include "Pipeline/FilterState.h"

#include "Solvers/GradientSolver.h"

#include "vtkCellData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <vector>

vtkStandardNewMacro(vtkSurfaceGradient);

struct vtkSurfaceGradient::Internals
{
  gridfem::GradientSolver Solver;
};

namespace
{

using Derived = gridfem::GradientSolver::Derived;

/// Returns means on the cells of the input. A field at points alone has no columns. Collective.
std::vector<gridfem::MultiVector> OnCells(const std::vector<Derived>& fields,
  const gridfem::InputSurface& surface, gridfem::Id numberOfCells)
{
  std::vector<gridfem::MultiVector> onCells(fields.size());
  for (std::size_t k = 0; k < fields.size(); ++k)
  {
    if (fields[k].onTriangles.cols() > 0)
    {
      onCells[k] = surface.MeansOnCells(fields[k].onTriangles, numberOfCells);
    }
  }
  return onCells;
}

void WriteArrays(const std::vector<Derived>& fields,
  const std::vector<gridfem::MultiVector>& onCells, vtkPolyData* output)
{
  for (std::size_t k = 0; k < fields.size(); ++k)
  {
    const char* name = fields[k].name;
    output->GetPointData()->AddArray(gridfem::MakePointArray(name, fields[k].atPoints, VTK_DOUBLE));
    if (onCells[k].cols() > 0)
    {
      output->GetCellData()->AddArray(gridfem::MakePointArray(name, onCells[k], VTK_DOUBLE));
    }
  }
}

} // namespace

vtkSurfaceGradient::vtkSurfaceGradient() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
  this->NormalStabilization = gridfem::GradientSolver::SurfaceDefaults().choice.normalStabilization;
}

vtkSurfaceGradient::~vtkSurfaceGradient() = default;

bool vtkSurfaceGradient::NeedsWholeSurface()
{
  return this->HodgeDecomposition;
}

void vtkSurfaceGradient::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::FilterState& state = *this->State;
  gridfem::InputSurface& surface = state.Read(input, vtkPolyData::GetData(inputs[1]));
  const gridfem::InputArray array = surface.Find(0, "Array");
  gridfem::GradientSolver::Options options;
  options.equation = state.options;
  options.hodgeDecomposition = this->HodgeDecomposition;
  const gridfem::Progress progress = state.GetProgress();
  const gridfem::GradientSolver::Result& result = this->Data->Solver.Update(
    surface, { surface.Given(array) }, options, { surface.Threads(), progress.Part(0.0, 0.95) });

  const gridfem::Id cells = input ? input->GetNumberOfCells() : 0;
  const auto derivatives = OnCells(result.derivatives, surface, cells);
  const auto parts = OnCells(result.parts, surface, cells);
  surface.Together(
    [&]
    {
      if (input)
      {
        output->ShallowCopy(input);
        WriteArrays(result.derivatives, derivatives, output);
        WriteArrays(result.parts, parts, output);
        output->GetPointData()->SetActiveScalars(array.array ? "Gradient" : "Laplacian");
        if (array.array && array.array->GetNumberOfComponents() == 1)
        {
          output->GetPointData()->SetActiveVectors("Gradient");
        }
      }
      gridfem::AddReport(result.report, output);
      gridfem::AddAccuracy(result.accuracy, output);
    });
  this->Warn(result.warnings);
  progress.Check(1.0);
}

void vtkSurfaceGradient::FreeStages()
{
  this->Superclass::FreeStages();
  *this->Data = Internals();
}

void vtkSurfaceGradient::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "HodgeDecomposition: " << this->HodgeDecomposition << "\n";
}
