#include "Pipeline/WholeSurface.h"

#include "Input/BasisReader.h"
#include "Input/InputValidation.h"
#include "Input/MetricArray.h"
#include "Output/SolverOutput.h"
#include "Pipeline/WholeClip.h"
#include "Shape/MovedSurface.h"
#include "Solvers/MemoryEstimate.h"

#include "vtkDataArray.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <utility>

namespace gridfem
{

WholeSurface::WholeSurface(Stages& stages, vtkAlgorithm* filter, const FilterOptions& options)
  : gridfem::Surface(stages), LocalSurface(stages), InputSurface(filter, options)
{
}

void WholeSurface::SetInput(vtkPolyData* input, vtkPolyData* basisData)
{
  input_ = input;
  basisData_ = basisData;
  used_ = options_;
}

void WholeSurface::Prepare(const Progress& progress)
{
  this->Update(options_, progress);
}

void WholeSurface::PrepareAtDepth(int depth, const Progress& progress)
{
  SurfaceOptions asked = options_;
  asked.space.depth = depth;
  this->Update(asked, progress);
}

void WholeSurface::PrepareMesh(const Progress& progress)
{
  if (basis_)
  {
    this->Free();
    this->GetStages().Forget();
  }
  used_ = options_;
  used_.space.depth = AutomaticDepth; // there is no grid
  StageKey key;
  AddMesh(key, input_);
  key.Add(options_.space.weldCoincidentPoints);
  this->GetStages().Run(MeshStage, key, [&] { this->ReadAnew(this->JoinsSeams(), progress); });
}

void WholeSurface::Update(const SurfaceOptions& asked, const Progress& progress)
{
  RequireNumber("Tolerance", options_.solve.tolerance);
  RequireNumber("Accuracy", options_.accuracy);
  used_ = asked;
  this->UpdateFunctions(asked, progress.Part(0.0, 0.6));
  // Given or kept functions may differ from the options.
  used_.space.depth = basis_.space->GetGrid().depth;
  used_.space.connectivityAware = basis_.space->support == FunctionSupport::ConnectivityAware;
  progress.Check(0.6);
  if (options_.metricArray.array && options_.trackMetric)
  {
    throw InvalidInput(
      "A Metric Array cannot be combined with Track Metric, because each is a metric.");
  }
  GivenMetric metric;
  metric.structure.Add(options_.metricArray.array).Add(options_.metricArray.association);
  metric.numbers.Add(tracked_.Motion());
  if (options_.metricArray.array)
  {
    metric.make = [this] {
      return std::make_shared<const TriangleMetric>(ReadMetric(options_.metricArray, triangles_));
    };
  }
  else if (tracked_.Metric())
  {
    metric.make = [this] { return tracked_.Metric(); };
  }
  this->UpdateSpace(metric, progress.Part(0.6, 1.0));
}

void WholeSurface::UpdateFunctions(const SurfaceOptions& asked, const Progress& progress)
{
  Stages& stages = this->GetStages();
  const std::int64_t number = this->MeshNumber();
  if (options_.trackMetric &&
      stages.IsCurrent(SpaceStage, this->KeyOfFunctions(asked, tracked_.ReferenceVersion())) &&
      tracked_.Follow(input_, triangles_))
  {
    return;
  }
  tracked_.Stop();
  StageKey key = this->KeyOfFunctions(asked, number);
  stages.Run(SpaceStage, key,
    [&]
    {
      stages.Forget(MeshStage); // this stage reads the mesh itself
      this->MakeFunctions(asked, progress);
      key = this->KeyOfFunctions(asked, number); // of the current mesh
    });
  if (tracked_.ReferenceVersion() != number)
  {
    tracked_.Refer(input_, number);
  }
}

StageKey WholeSurface::KeyOfFunctions(const SurfaceOptions& asked, std::int64_t meshNumber) const
{
  StageKey key;
  key.Add(meshNumber).Add(this->IsTooFineForHats());
  if (this->AreFunctionsGiven())
  {
    vtkPolyData* const source = CarriesBasis(input_) ? input_ : basisData_;
    AddMesh(key, source);
    AddBasisArrays(key, source);
    return key;
  }
  key.Add(asked.space.depth).Add(asked.space.connectivityAware);
  key.Add(asked.space.weldCoincidentPoints);
  return key;
}

void WholeSurface::MakeFunctions(const SurfaceOptions& asked, const Progress& progress)
{
  if (!this->AreFunctionsGiven())
  {
    this->BuildFunctions(asked, progress);
    return;
  }
  this->ReadAnew(this->JoinsSeams(), progress.Part(0.0, 0.1));
  if (CarriesBasis(input_))
  {
    basis_ = ReadBasis(input_, triangles_, progress.Part(0.1, 0.8));
  }
  else if (CarriesBasis(basisData_))
  {
    basis_ = ReadBasisFor(basisData_, triangles_, progress.Part(0.1, 0.8));
  }
  else
  {
    throw InvalidInput(NoBasisText);
  }
  this->CoarsenBasis(asked, progress.Part(0.8, 1.0));
  RequireMemory(*triangles_.triangles, basis_.space->GetGrid().depth, asked.choice.kind);
}

void WholeSurface::BuildFunctions(const SurfaceOptions& asked, const Progress& progress)
{
  this->ReadAnew(options_.space.weldCoincidentPoints, progress.Part(0.0, 0.1));
  wanted_ =
    ChooseDepth(*triangles_.triangles, asked.space.depth, FunctionKind::Grid, AsManyAsWanted);
  this->BuildBasis(triangles_.triangles, asked, progress.Part(0.1, 1.0));
}

/// Replaces a given basis that is finer than hat functions need by a coarser one.
void WholeSurface::CoarsenBasis(const SurfaceOptions& asked, const Progress& progress)
{
  wanted_ = basis_.space->GetGrid().depth;
  SpaceOptions enough = asked.space;
  enough.depth =
    ChooseDepth(*triangles_.triangles, wanted_, asked.choice.kind, asked.functionsPerPoint);
  if (enough.depth < wanted_)
  {
    enough.connectivityAware = basis_.space->support == FunctionSupport::ConnectivityAware;
    enough.weldCoincidentPoints = basis_.weldCoincidentPoints;
    basis_ = MakeSurfaceBasis(triangles_.triangles,
      BuildGridFunctions(*triangles_.triangles, enough, progress), enough.weldCoincidentPoints);
  }
}

/// Whether the wanted grid is finer than hat functions need.
bool WholeSurface::IsTooFineForHats() const
{
  return !IsRefinedByDepth(options_.choice.kind) && triangles_.triangles &&
         DepthForPoints(*triangles_.triangles, wanted_, options_.functionsPerPoint) < wanted_;
}

std::int64_t WholeSurface::MeshNumber()
{
  return meshVersion_.Of(input_, triangles_, options_.space.threads);
}

/// Whether the seams of the triangles that functions are on are joined, as the properties or a
/// given basis say.
bool WholeSurface::JoinsSeams() const
{
  if (CarriesBasis(input_))
  {
    return false;
  }
  const bool isGiven = basisData_ && CarriesBasis(basisData_);
  return isGiven ? WeldsCoincidentPoints(basisData_) : options_.space.weldCoincidentPoints;
}

InputMesh WholeSurface::ReadTriangles()
{
  InputMesh mesh = ReadInputMesh(input_, this->JoinsSeams(), options_.space.threads);
  RequireSurface(*mesh.triangles);
  return mesh;
}

void WholeSurface::ReadAnew(bool joinsSeams, const Progress& progress)
{
  this->FreeBasis();
  triangles_ = ReadInputMesh(input_, joinsSeams, options_.space.threads, progress);
  RequireSurface(*triangles_.triangles);
}

void WholeSurface::TakeFunctions(GridFunctions functions)
{
  basis_ = MakeSurfaceBasis(
    triangles_.triangles, std::move(functions), options_.space.weldCoincidentPoints);
}

std::shared_ptr<const TriangleMesh> WholeSurface::ReadMesh() const
{
  return ReadInputMesh(input_, this->JoinsSeams(), options_.space.threads).triangles;
}

StageKey WholeSurface::InputKey() const
{
  StageKey key;
  AddMesh(key, input_);
  key.Add(options_.space.connectivityAware).Add(options_.space.weldCoincidentPoints);
  key.Add(options_.space.joinAtPoints).Add(options_.functionsPerPoint);
  key.Add(options_.choice.kind).Add(options_.choice.quadratureDegree);
  key.Add(options_.choice.coarsestSize).Add(options_.choice.normalStabilization);
  key.Add(options_.parameterUnits).Add(options_.trackMetric);
  key.Add(options_.metricArray.array).Add(options_.metricArray.association);
  return key;
}

InputArray WholeSurface::Find(int index, const std::string& property)
{
  return FindInputArray(filter_, index, input_, property);
}

InputArray WholeSurface::FindOn(const InputMesh& /*mesh*/, int index, const std::string& property)
{
  return this->Find(index, property);
}

int WholeSurface::DataTypeOf(int /*index*/, const InputArray& array) const
{
  return array.array->GetDataType();
}

const InputMesh& WholeSurface::CurrentTriangles() const
{
  return tracked_.Metric() ? tracked_.Moved() : triangles_;
}

MultiVector WholeSurface::MeansOnCells(const MultiVector& onTriangles, Id cells) const
{
  return gridfem::MeansOnCells(this->CurrentTriangles(), onTriangles, cells);
}

Field WholeSurface::OnReference(Field gradients) const
{
  return tracked_.Metric() ? PullBack(this->Mesh(), this->CurrentMesh(), gradients)
                           : std::move(gradients);
}

double WholeSurface::LongestSide() const
{
  if (!tracked_.Metric())
  {
    return LocalSurface::LongestSide();
  }
  const TriangleMesh& moved = this->CurrentMesh();
  const Bounds bounds = BoundsOf(moved.points, UsedPoints(moved), this->Threads());
  return (bounds.high - bounds.low).maxCoeff();
}

int WholeSurface::UsedDepth() const
{
  return basis_ ? basis_.space->GetGrid().depth : AutomaticDepth;
}

void WholeSurface::WriteTracking(vtkPolyData* output) const
{
  if (!options_.trackMetric)
  {
    return;
  }
  double largest = 1.0;
  if (tracked_.Metric())
  {
    const std::vector<double> ratio =
      DistortionOf(this->Mesh(), this->CurrentMesh().points, this->Threads()).stretchRatio;
    largest = *std::max_element(ratio.begin(), ratio.end());
  }
  AddFieldNumber(output, "LargestStretchRatio", largest);
  if (const std::optional<double> time = tracked_.ReferenceTime())
  {
    AddFieldNumber(output, "ReferenceTime", *time);
  }
}

ClippedSurface& WholeSurface::Clip()
{
  if (!clip_)
  {
    clip_ = std::make_unique<WholeClip>(*this);
  }
  return *clip_;
}

void WholeSurface::Run(const Progress& progress, const std::function<void(const Progress&)>& body)
{
  body(progress);
}

void WholeSurface::Free()
{
  triangles_ = {};
  tracked_ = {};
  clip_ = nullptr;
  this->FreeBasis();
}

} // namespace gridfem
