#include "vtkParameterization.h"

#include "Output/FlatMapOutput.h"
#include "Pipeline/FilterState.h"

#include "Solvers/ParameterizationSolver.h"

#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkParameterization);

struct vtkParameterization::Internals
{
  gridfem::ParameterizationSolver Solver;
};

vtkParameterization::vtkParameterization() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfOutputPorts(2);
}

vtkParameterization::~vtkParameterization() = default;

void vtkParameterization::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  gridfem::FilterState& state = *this->State;
  gridfem::InputSurface& surface = state.Read(input, nullptr);
  gridfem::ParameterizationSolver::Options options;
  options.mapType = static_cast<gridfem::MapType>(this->MapType);
  options.holeSize = this->HoleSize;
  options.extraCuts = this->ExtraCuts;
  const gridfem::ParameterizationSolver::Result& result =
    this->Data->Solver.Update(surface, options, { 0, state.GetProgress() });

  vtkPolyData* mesh = vtkPolyData::GetData(outputs, 0);
  mesh->ShallowCopy(input);
  gridfem::AddFlatMap(result, surface.Triangles(), mesh);
  gridfem::WriteFlatMap(result, surface.Triangles(), input, vtkPolyData::GetData(outputs, 1));
  this->Warn(result.warnings);
}

void vtkParameterization::FreeStages()
{
  this->Superclass::FreeStages();
  *this->Data = Internals();
}

void vtkParameterization::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MapType: " << this->MapType << "\n";
  os << indent << "HoleSize: " << this->HoleSize << "\n";
  os << indent << "ExtraCuts: " << this->ExtraCuts << "\n";
}
