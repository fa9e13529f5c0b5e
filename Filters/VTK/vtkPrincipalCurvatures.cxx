#include "vtkPrincipalCurvatures.h"

#include "Private/InputMesh.h"
#include "Private/InputValidation.h"
#include "Private/SolverOutput.h"
#include "Private/SurfaceCurvatures.h"

#include "Base/VectorRows.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <vector>

vtkStandardNewMacro(vtkPrincipalCurvatures);

namespace
{

/// All arrays, but for the directions, in the order of their names below.
gridfem::MultiVector Numbers(const gridfem::PrincipalCurvatures& curvatures, double area)
{
  gridfem::MultiVector numbers(static_cast<gridfem::Id>(curvatures.minimum.size()), 6);
  std::vector<double> mean(curvatures.minimum.size());
  for (gridfem::Id point = 0; point < numbers.rows(); ++point)
  {
    const double least = curvatures.minimum[point];
    const double most = curvatures.maximum[point];
    mean[point] = 0.5 * (least + most);
    numbers.row(point) << least, most, mean[point], least * most, gridfem::ShapeIndex(least, most),
      0.0;
  }
  const std::vector<double> bending = gridfem::BendingOf(mean, area);
  numbers.col(5) = Eigen::Map<const Eigen::VectorXd>(bending.data(), numbers.rows());
  return numbers;
}

constexpr const char* NumberNames[] = { "MinimumCurvature", "MaximumCurvature", "MeanCurvature",
  "GaussianCurvature", "ShapeIndex", "Bending" };

} // namespace

struct vtkPrincipalCurvatures::Internals
{
  gridfem::PrincipalCurvatures Curvatures;
  gridfem::SolveReport Report; // of the smoothing
  double Area = 0.0;           // of the surface
};

vtkPrincipalCurvatures::vtkPrincipalCurvatures() : Data(std::make_unique<Internals>())
{
  this->Tolerance = 1e-4;
  this->NormalStabilization = 1e-2;
  this->MaximumIterations = 200;
}

vtkPrincipalCurvatures::~vtkPrincipalCurvatures() = default;

void vtkPrincipalCurvatures::Compute(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  gridfem::SurfaceSolverState& state = *this->State;
  const gridfem::Progress progress = state.bridge.GetProgress();
  gridfem::RequireAtLeast("SmoothingScale", this->SmoothingScale, 0.0);
  gridfem::StageKey key;
  key.Add(this->SmoothingScale).Add(this->WeldCoincidentPoints);
  const bool isSmoothed = this->SmoothingScale > 0.0;
  if (isSmoothed)
  {
    state.UpdateSpace(input, nullptr, progress.Part(0.0, 0.4));
    state.UpdateSystem(progress.Part(0.4, 0.6));
    key.Add(state.stages.Version(gridfem::SystemStage)).Add(this->ParameterUnits);
    key.Add(this->Tolerance).Add(this->MaximumIterations);
    gridfem::AddMultigrid(key, state.options.multigrid);
  }
  else
  {
    if (state.basis.space)
    {
      state.Free(); // of an earlier run: no grid is used, and none is told of
    }
    gridfem::AddMesh(key, input);
  }
  state.stages.Run(gridfem::SolveStage, key, [&] { this->Fit(input, progress.Part(0.6, 0.95)); });
  this->WriteArrays(input, output);
  if (isSmoothed)
  {
    const gridfem::SolveReport& report = this->Data->Report;
    gridfem::AddReport(report, output);
    if (!report.converged)
    {
      vtkWarningMacro(<< gridfem::WarningOf(report, this->Tolerance));
    }
  }
  progress.Check(1.0);
}

void vtkPrincipalCurvatures::Fit(vtkPolyData* input, const gridfem::Progress& progress)
{
  const gridfem::SurfaceSolverState& state = *this->State;
  const bool isSmoothed = this->SmoothingScale > 0.0;
  gridfem::InputMesh own; // without smoothing there is no function space, which would have read it
  if (!isSmoothed)
  {
    own = gridfem::ReadInputMesh(input, this->NumberOfThreads, progress.Part(0.0, 0.3));
    gridfem::RequireSurface(*own.triangles);
  }
  const gridfem::TriangleMesh& mesh = *(isSmoothed ? state.mesh : own).triangles;
  this->Data->Area = gridfem::SurfaceArea(mesh);
  this->Data->Curvatures = gridfem::CurvaturesOfSurface(
    state, mesh, this->SmoothingScale, this->Data->Report, progress.Part(0.3, 1.0));
}

void vtkPrincipalCurvatures::WriteArrays(vtkPolyData* input, vtkPolyData* output)
{
  const gridfem::PrincipalCurvatures& curvatures = this->Data->Curvatures;
  output->ShallowCopy(input);
  vtkPointData* points = output->GetPointData();
  const gridfem::MultiVector numbers = Numbers(curvatures, this->Data->Area);
  for (gridfem::Id k = 0; k < numbers.cols(); ++k)
  {
    points->AddArray(gridfem::MakePointArray(NumberNames[k], numbers.col(k), VTK_DOUBLE));
  }
  points->AddArray(gridfem::MakePointArray(
    "MinimumCurvatureDirection", gridfem::RowsOf(curvatures.minimumDirection), VTK_DOUBLE));
  points->AddArray(gridfem::MakePointArray(
    "MaximumCurvatureDirection", gridfem::RowsOf(curvatures.maximumDirection), VTK_DOUBLE));
  points->SetActiveScalars("Bending");
}

void vtkPrincipalCurvatures::FreeStages()
{
  this->Superclass::FreeStages();
  *this->Data = Internals();
}

void vtkPrincipalCurvatures::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SmoothingScale: " << this->SmoothingScale << "\n";
}
