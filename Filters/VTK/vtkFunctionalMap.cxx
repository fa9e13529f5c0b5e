#include "vtkFunctionalMap.h"

#include "Input/CarriedModes.h"
#include "Input/PropertyList.h"
#include "Input/SurfaceInput.h"
#include "Output/MapOutput.h"
#include "Output/SolverOutput.h"
#include "Pipeline/FilterState.h"
#include "Pipeline/WholeSurface.h"

#include "Base/Errors.h"
#include "Solvers/FunctionalMapSolver.h"
#include "Solvers/SolveWarnings.h"

#include "vtkDataSet.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkFunctionalMap);

namespace
{

/// Returns modes that are enough for a map, or none.
gridfem::GivenModes IfEnough(const gridfem::GivenModes& given)
{
  const bool isEnough = given && given.modes->eigenvalues.size() >= gridfem::FewestModesOfMap;
  return isEnough ? given : gridfem::GivenModes();
}

} // namespace

struct vtkFunctionalMap::Internals
{
  Internals(vtkAlgorithm* filter, const gridfem::FilterOptions& options)
    : Reference(Stages, filter, options)
  {
  }

  std::vector<gridfem::Landmark> Landmarks;
  gridfem::SurfaceInput ReferenceInput;
  gridfem::Stages Stages; // of the reference
  gridfem::WholeSurface Reference;
  gridfem::CarriedModes Carried;
  gridfem::CarriedModes OfReference;
  gridfem::FunctionalMapSolver Solver;
  const gridfem::FunctionalMapSolver::Result* Result = nullptr; // of this run
};

vtkFunctionalMap::vtkFunctionalMap() : Data(std::make_unique<Internals>(this, this->State->options))
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(2);
  const gridfem::EquationOptions equation = gridfem::EquationOfModes();
  this->Tolerance = equation.solve.tolerance;
  this->State->options.multigrid.cycle = equation.multigrid.cycle;
}

vtkFunctionalMap::~vtkFunctionalMap() = default;

void vtkFunctionalMap::AddLandmark(vtkIdType point, vtkIdType referencePoint)
{
  gridfem::AddToList(this->Data->Landmarks, { point, referencePoint }, this);
}

void vtkFunctionalMap::ClearLandmarks()
{
  gridfem::ClearList(this->Data->Landmarks, this);
}

int vtkFunctionalMap::GetNumberOfLandmarks()
{
  return static_cast<int>(this->Data->Landmarks.size());
}

void vtkFunctionalMap::SetReferenceConnection(vtkAlgorithmOutput* output)
{
  this->SetInputConnection(2, output);
}

void vtkFunctionalMap::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkDataSet* given = vtkDataSet::GetData(inputs[2]);
  if (!given)
  {
    throw gridfem::MissingChoice("Choose a Reference, the surface that points are mapped to.");
  }
  gridfem::FilterState& state = *this->State;
  Internals& data = *this->Data;
  vtkPolyData* reference = nullptr;
  gridfem::FunctionalMapSolver::OfReference([&] { reference = data.ReferenceInput.Of(given); });
  if (reference->GetNumberOfPolys() + reference->GetNumberOfStrips() == 0)
  {
    throw gridfem::InvalidInput("The input Reference has no surface. On several MPI ranks it has " +
                                std::string("to be polygonal data: apply Extract Surface first."));
  }
  gridfem::FunctionalMapSolver::OfReference([&] { gridfem::RequireArrays(reference); });
  state.options.functionsPerPoint =
    gridfem::FunctionalMapSolver::SurfaceDefaults().functionsPerPoint;
  gridfem::InputSurface& surface = state.Read(input, vtkPolyData::GetData(inputs[1]));
  data.Reference.SetInput(reference, nullptr);
  gridfem::FunctionalMapSolver::Input ofSolver;
  ofSolver.modes = IfEnough(data.Carried.Update(surface, input));
  gridfem::FunctionalMapSolver::OfReference([&]
    { ofSolver.referenceModes = IfEnough(data.OfReference.Update(data.Reference, reference)); });
  ofSolver.landmarks = data.Landmarks;
  ofSolver.announce = [&](const std::string& cost, bool takesHours)
  { state.bridge.Announce(cost, takesHours); };
  gridfem::FunctionalMapSolver::Options options;
  options.equation = state.options;
  options.numberOfModes = this->NumberOfModes;
  data.Result = &data.Solver.Update(
    surface, data.Reference, ofSolver, options, { surface.Threads(), state.GetProgress() });
  this->Write(input, reference, outputs);
  this->Warn(gridfem::NotEmpty(
    { data.Carried.WarningOfShape("input"), data.OfReference.WarningOfShape("Reference") }));
  this->Warn(data.Result->warnings);
}

void vtkFunctionalMap::Write(
  vtkPolyData* input, vtkPolyData* reference, vtkInformationVector* outputs)
{
  const gridfem::FunctionalMapSolver::Result& result = *this->Data->Result;
  vtkPolyData* mesh = vtkPolyData::GetData(outputs, 0);
  mesh->ShallowCopy(input);
  this->Data->Carried.RemoveMisfit(mesh);
  gridfem::WriteMap(result.map, reference, mesh);
  if (!result.where.empty())
  {
    gridfem::AddFieldInt(mesh, "Converged", result.isConverged ? 1 : 0);
    gridfem::AddDevice(result.where, mesh);
  }
  vtkPolyData* colored = vtkPolyData::GetData(outputs, 1);
  colored->ShallowCopy(reference);
  this->Data->OfReference.RemoveMisfit(colored);
  gridfem::AddMatchingColors(reference, colored);
}

void vtkFunctionalMap::FreeStages()
{
  this->Superclass::FreeStages();
  std::vector<gridfem::Landmark> landmarks = std::move(this->Data->Landmarks);
  this->Data = std::make_unique<Internals>(this, this->State->options);
  this->Data->Landmarks = std::move(landmarks);
}

void vtkFunctionalMap::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfModes: " << this->NumberOfModes << "\n";
  os << indent << "Landmarks: " << this->GetNumberOfLandmarks() << "\n";
}
