#include "vtkFarthestPoints.h"

#include "Output/SolverOutput.h"
#include "Pipeline/FilterState.h"

#include "Solvers/FarthestPointsSolver.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkFarthestPoints);

struct vtkFarthestPoints::Internals
{
  gridfem::FarthestPointsSolver Solver;
};

vtkFarthestPoints::vtkFarthestPoints() : Data(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
  this->Tolerance = 1e-4;
  this->NormalStabilization = gridfem::DistanceOptions::LeastStabilization;
  this->MaximumIterations = 200;
}

vtkFarthestPoints::~vtkFarthestPoints() = default;

double vtkFarthestPoints::GetNormalStabilizationMinValue()
{
  return gridfem::DistanceOptions::LeastStabilization;
}

void vtkFarthestPoints::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::FilterState& state = *this->State;
  const gridfem::SurfaceOptions defaults = gridfem::FarthestPointsSolver::SurfaceDefaults();
  state.options.space.joinAtPoints = defaults.space.joinAtPoints;
  state.options.functionsPerPoint = defaults.functionsPerPoint;
  gridfem::InputSurface& surface = state.Read(input, vtkPolyData::GetData(inputs[1]));
  gridfem::FarthestPointsSolver::Options options;
  options.equation = state.options;
  options.numberOfPoints = this->NumberOfPoints;
  options.firstPointId = this->FirstPointId;
  const gridfem::FarthestPointsSolver::Result& result =
    this->Data->Solver.Update(surface, options, { 0, state.GetProgress() });

  output->ShallowCopy(input);
  vtkPointData* points = output->GetPointData();
  points->AddArray(gridfem::MakePointArray("Distance", result.atPoints, VTK_DOUBLE));
  points->AddArray(gridfem::MakeIdArray("NearestPoint", result.nearest));
  points->SetActiveScalars("Distance");
  output->GetFieldData()->AddArray(gridfem::MakeIdArray("FarthestPoints", result.points));
  gridfem::AddFieldNumber(output, "Radius", result.radius);
  gridfem::AddReport(result.report, output);
  this->Warn(result.warnings);
}

void vtkFarthestPoints::FreeStages()
{
  this->Superclass::FreeStages();
  *this->Data = Internals();
}

void vtkFarthestPoints::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPoints: " << this->NumberOfPoints << "\n";
  os << indent << "FirstPointId: " << this->FirstPointId << "\n";
}
