#include "SurfaceSolverState.h"

#include "Base/Errors.h"
#include "BasisReader.h"
#include "GivenValues.h"
#include "InputValidation.h"
#include "Integrals/QuadratureRule.h"
#include "MetricArray.h"
#include "Problems/GeodesicDistance.h"
#include "Problems/MemoryEstimate.h"
#include "Problems/MovedSurface.h"
#include "Ranks.h"
#include "SelectedPoints.h"
#include "SolverOutput.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gridfem
{
namespace
{

constexpr const char* NoBasisText = "The second input is not the output of a basis filter: the "
                                    "arrays 'PatchBasisIds' and 'PatchId' are missing.";

} // namespace

void AddMesh(StageKey& key, vtkPolyData* data)
{
  key.Add(data->GetPoints()).Add(data->GetPoints() ? data->GetPoints()->GetData() : nullptr);
  for (vtkCellArray* cells : { data->GetPolys(), data->GetStrips() })
  {
    key.Add(cells);
    key.Add(cells ? cells->GetOffsetsArray() : nullptr);
    key.Add(cells ? cells->GetConnectivityArray() : nullptr);
  }
  key.Add(data->GetCellData()->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()));
  // Cells of these kinds come first and shift the ids of the polygons.
  key.Add(std::int64_t{ data->GetNumberOfVerts() }).Add(std::int64_t{ data->GetNumberOfLines() });
}

void AddClipArrays(StageKey& key, vtkPolyData* data)
{
  for (const char* name : { SourceCellIdName, OctreeCellIdName })
  {
    key.Add(data->GetCellData()->GetAbstractArray(name));
  }
  for (const char* name : { OctreeCellsName, GridOriginName, GridSpacingName, GridDepthName })
  {
    key.Add(data->GetFieldData()->GetAbstractArray(name));
  }
}

void AddBasisArrays(StageKey& key, vtkPolyData* data)
{
  AddClipArrays(key, data);
  key.Add(data->GetCellData()->GetAbstractArray(PatchIdName));
  for (const char* name : { PatchCellIdName, PatchBasisIdsName, NumberOfBasisFunctionsName,
         ConnectivityAwareName, WeldCoincidentPointsName })
  {
    key.Add(data->GetFieldData()->GetAbstractArray(name));
  }
}

StageKey SurfaceSolverState::SpaceKey(
  vtkPolyData* input, vtkPolyData* basisData, std::int64_t meshNumber, int depth) const
{
  StageKey key;
  key.Add(meshNumber).Add(this->GivesWay());
  const bool carries = CarriesBasis(input);
  if (carries || basisData)
  {
    vtkPolyData* source = carries ? input : basisData;
    AddMesh(key, source);
    AddBasisArrays(key, source);
  }
  else
  {
    key.Add(depth);
    key.Add(options.space.connectivityAware);
    key.Add(options.space.weldCoincidentPoints);
  }
  return key;
}

void SurfaceSolverState::UpdateSpace(
  vtkPolyData* input, vtkPolyData* basisData, const Progress& progress)
{
  RequireNumber("Tolerance", options.solve.tolerance);
  RequireNumber("Accuracy", options.accuracy);
  used_ = options;
  const std::int64_t meshNumber = meshVersion.Of(input, mesh, options.space.threads);
  const int wanted = options.space.depth;
  if (options.trackMetric &&
      stages.IsCurrent(
        SpaceStage, this->SpaceKey(input, basisData, tracked_.ReferenceVersion(), wanted)) &&
      tracked_.Follow(input, mesh))
  {
    this->NoteFunctions();
    return;
  }
  tracked_.Stop();
  const bool carries = CarriesBasis(input);
  const auto update = [&]
  {
    stages.Forget(MeshStage); // this function reads the mesh itself
    if (!carries && !basisData)
    {
      this->BuildSpace(input, progress);
      return;
    }
    basis = {};
    space = {};
    mesh = this->ReadMeshOf(input, progress.Part(0.0, 0.1));
    RequireSurface(*mesh.triangles);
    if (!carries && !CarriesBasis(basisData))
    {
      throw InvalidInput(NoBasisText);
    }
    basis = carries ? ReadBasis(input, mesh, progress.Part(0.1, 0.8))
                    : ReadBasisFor(basisData, mesh, progress.Part(0.1, 0.8));
    this->TakeEnough(progress.Part(0.8, 1.0));
    RequireMemory(*mesh.triangles, basis.space->GetGrid().depth, options.choice.kind);
  };
  StageKey key = this->SpaceKey(input, basisData, meshNumber, wanted);
  stages.Run(SpaceStage, key,
    [&]
    {
      update();
      key = this->SpaceKey(input, basisData, meshNumber, wanted); // of the current mesh
    });
  if (tracked_.ReferenceVersion() != meshNumber)
  {
    tracked_.Refer(input, meshNumber);
  }
  this->NoteFunctions();
}

/// Notes the properties of the functions. Given or kept functions may differ from the options.
void SurfaceSolverState::NoteFunctions()
{
  used_.space.depth = this->Functions().GetGrid().depth;
  used_.space.connectivityAware = this->Functions().support == FunctionSupport::ConnectivityAware;
}

int SurfaceSolverState::DepthFor(int wanted) const
{
  return gridfem::ChooseDepth(
    *mesh.triangles, wanted, options.choice.kind, options.functionsPerPoint);
}

/// Whether the wanted grid is finer than hat functions need.
bool SurfaceSolverState::GivesWay() const
{
  return !IsRefinedByDepth(options.choice.kind) && mesh.triangles &&
         DepthForPoints(*mesh.triangles, wanted_, options.functionsPerPoint) < wanted_;
}

void SurfaceSolverState::ChooseDepth()
{
  wanted_ =
    gridfem::ChooseDepth(*mesh.triangles, options.space.depth, FunctionKind::Grid, AsManyAsWanted);
  used_.space.depth = this->DepthFor(options.space.depth);
}

/// Replaces a given basis that is finer than hat functions need by a coarser one.
void SurfaceSolverState::TakeEnough(const Progress& progress)
{
  wanted_ = this->Functions().GetGrid().depth;
  SpaceOptions enough = options.space;
  enough.depth = this->DepthFor(wanted_);
  if (enough.depth < wanted_)
  {
    enough.connectivityAware = this->Functions().support == FunctionSupport::ConnectivityAware;
    enough.weldCoincidentPoints = basis.weldCoincidentPoints;
    basis = MakeSurfaceBasis(mesh.triangles, BuildGridFunctions(*mesh.triangles, enough, progress),
      enough.weldCoincidentPoints);
  }
}

void SurfaceSolverState::BuildSpace(vtkPolyData* input, const Progress& progress)
{
  basis = {}; // frees the memory of the last one first
  space = {};
  mesh = ReadInputMesh(
    input, options.space.weldCoincidentPoints, options.space.threads, progress.Part(0.0, 0.1));
  RequireSurface(*mesh.triangles);
  used_ = options;
  this->ChooseDepth();
  RequireMemory(*mesh.triangles, used_.space.depth, used_.choice.kind);
  basis = MakeSurfaceBasis(mesh.triangles,
    BuildGridFunctions(*mesh.triangles, used_.space, progress.Part(0.1, 1.0)),
    used_.space.weldCoincidentPoints);
}

void SurfaceSolverState::UpdateSystem(const Progress& progress)
{
  StageKey key;
  key.Add(stages.Version(SpaceStage)).Add(options.choice.quadratureDegree);
  key.Add(options.choice.coarsestSize).Add(options.choice.normalStabilization);
  key.Add(static_cast<int>(options.choice.kind));
  key.Add(metricArray.array).Add(static_cast<int>(metricArray.association));
  if (!(key == structureKey_))
  {
    structureKey_ = key;
    ++structure_;
  }
  key.Add(tracked_.Motion());
  if (metricArray.array && options.trackMetric)
  {
    throw InvalidInput(
      "A Metric Array cannot be combined with Track Metric, because each is a metric.");
  }
  if (stages.IsCurrent(SystemStage, key))
  {
    return;
  }
  metric_.reset();
  const bool hasMetric = metricArray.array || tracked_.Metric();
  space = hasMetric ? nullptr : FindSpace(basis, options.choice);
  if (space)
  {
    stages.Adopt(SystemStage, key);
    return;
  }
  stages.Run(SystemStage, key,
    [&]
    {
      metric_ = tracked_.Metric();
      if (metricArray.array)
      {
        metric_ = std::make_shared<const TriangleMetric>(ReadMetric(metricArray, mesh));
      }
      space =
        this->InMetric(MakeSpace(basis, options.choice, this->MakeJob(progress.Part(0.0, 0.6))),
          progress.Part(0.6, 1.0));
    });
}

std::shared_ptr<const FiniteElementSpace> SurfaceSolverState::InMetric(
  std::shared_ptr<const FiniteElementSpace> ofMesh, const Progress& progress) const
{
  if (!metric_)
  {
    return ofMesh;
  }
  std::shared_ptr<FiniteElementSpace> own = ofMesh->Copy();
  own->SetMetricOnTriangles(metric_, this->MakeJob(progress));
  return own;
}

void SurfaceSolverState::RunTogether(const DistributedSurface::Body& body)
{
  isTogether_ = true;
  stages.DecideTogether([this](bool holds) { return together.Any(holds); });
  try
  {
    together.Run(bridge.GetProgress(),
      [&](const Progress& ofAll)
      {
        progressOfAll_ = ofAll;
        body(ofAll);
      });
  }
  catch (...)
  {
    stages.DecideTogether(nullptr);
    isTogether_ = false;
    throw;
  }
  stages.DecideTogether(nullptr);
  isTogether_ = false;
}

namespace
{

/// The numbers of a basis that ranks exchange: origin, side and depth of the grid, the number of
/// functions, and whether they are aware of connectivity.
enum BasisNumber
{
  OriginX,
  OriginY,
  OriginZ,
  Side,
  Depth,
  AllFunctions,
  Aware,
  BasisNumbers
};

} // namespace

/// Requests the functions of a basis that any rank has.
std::vector<double> SurfaceSolverState::TakeBasisTogether(
  vtkPolyData* basisData, SurfaceOptions& asked) const
{
  std::vector<double> told;
  together.Together(
    [&]
    {
      if (basisData && CarriesBasis(basisData))
      {
        const BasisFacts facts = ReadBasisFacts(basisData);
        const Grid& grid = facts.grid;
        told.resize(BasisNumbers);
        std::copy_n(grid.origin.data(), 3, told.begin());
        told[Side] = grid.spacing * grid.CellsPerSide();
        told[Depth] = grid.depth;
        told[AllFunctions] = static_cast<double>(facts.functions);
        told[Aware] = facts.isConnectivityAware ? 1.0 : 0.0;
      }
    });
  together.Agree(told);
  if (told.empty())
  {
    throw InvalidInput(NoBasisText);
  }
  asked.space.depth = static_cast<int>(told[Depth]);
  asked.space.connectivityAware = told[Aware] != 0.0;
  return told;
}

/// Requires that the functions belong to the basis, as far as the numbers tell.
void SurfaceSolverState::RequireBasisTogether(const std::vector<double>& told) const
{
  const Grid& grid = together.GridOfRanks();
  const bool isSameCube = grid.origin == Vec3(told[OriginX], told[OriginY], told[OriginZ]) &&
                          grid.spacing * grid.CellsPerSide() == told[Side];
  // The grid may be coarser below hat functions. Points of a clip in single precision may make a
  // few functions more.
  const double more = static_cast<double>(together.NumberOfFunctions()) - told[AllFunctions];
  const bool isSameSpace =
    !IsRefinedByDepth(options.choice.kind) || std::abs(more) <= 0.01 * told[AllFunctions];
  if (!isSameCube || !isSameSpace)
  {
    throw InvalidInput("The basis was made from another mesh. Connect the mesh that went into the "
                       "basis filter, or the output of the basis filter itself.");
  }
}

void SurfaceSolverState::UpdateTogether(vtkPolyData* piece, vtkPolyData* basisData)
{
  SurfaceOptions asked = options;
  if (together.Any(piece && CarriesBasis(piece)))
  {
    this->TakeBasisTogether(piece, asked);
    this->BuildShared(piece, true, asked, [] {});
    return;
  }
  if (!together.Any(basisData != nullptr && basisData->GetNumberOfPoints() > 0))
  {
    this->BuildTogether(piece, false);
    return;
  }
  const std::vector<double> told = this->TakeBasisTogether(basisData, asked);
  this->BuildShared(piece, false, asked, [] {});
  this->RequireBasisTogether(told);
}

void SurfaceSolverState::BuildTogether(
  vtkPolyData* piece, bool isClipped, const std::function<void()>& release)
{
  this->BuildShared(piece, isClipped, options, release);
}

void SurfaceSolverState::BuildShared(vtkPolyData* piece, bool isClipped,
  const SurfaceOptions& asked, const std::function<void()>& release)
{
  StageKey key;
  together.Together(
    [&]
    {
      RequireNumber("Tolerance", options.solve.tolerance);
      RequireNumber("Accuracy", options.accuracy);
      TriangleRule(asked.choice.quadratureDegree); // refuses a wrong degree
      key.Add(std::string("together")).Add(isClipped ? 0 : asked.space.depth);
      key.Add(static_cast<int>(asked.choice.kind)).Add(asked.space.joinAtPoints);
      key.Add(asked.functionsPerPoint);
      key.Add(asked.space.connectivityAware).Add(asked.space.weldCoincidentPoints);
      key.Add(asked.choice.quadratureDegree).Add(asked.choice.coarsestSize);
      key.Add(asked.choice.normalStabilization).Add(isClipped);
      if (piece)
      {
        AddMesh(key, piece);
      }
      if (piece && isClipped)
      {
        AddClipArrays(key, piece);
      }
    });
  used_ = asked;
  used_.space.threads = together.ThreadsOfRank(asked.space.threads);
  options.multigrid.threads = used_.space.threads;
  stages.Run(SpaceStage, key,
    [&]
    {
      basis = {};
      space = {};
      release();
      together.BuildSpace(piece, used_, isClipped, mesh);
    });
  used_.space.depth = together.Depth();
  key = {};
  key.Add(stages.Version(SpaceStage));
  stages.Run(SystemStage, key, [] {}); // ranks make it with the space
}

std::shared_ptr<const SurfaceSpace> SurfaceSolverState::SharedSpace() const
{
  return together.IsUsed() ? together.Space() : space;
}

std::shared_ptr<const FiniteElementSpace> SurfaceSolverState::WholeSpace() const
{
  if (together.IsUsed())
  {
    throw std::logic_error("no process holds the whole surface");
  }
  return space;
}

InputMesh SurfaceSolverState::ReadMeshOf(vtkPolyData* data, const Progress& progress) const
{
  const bool isBasisOfData = CarriesBasis(data);
  const bool isGiven = !isBasisOfData && basisData_ && CarriesBasis(basisData_);
  const bool isWelded =
    isGiven ? WeldsCoincidentPoints(basisData_) : options.space.weldCoincidentPoints;
  return ReadInputMesh(data, isWelded && !isBasisOfData, options.space.threads, progress);
}

std::shared_ptr<const TriangleMesh> SurfaceSolverState::ReadMesh() const
{
  return this->ReadMeshOf(input_, {}).triangles;
}

void SurfaceSolverState::Require(const MemoryNeed& own) const
{
  if (together.IsUsed())
  {
    together.Require(own);
    return;
  }
  Surface::Require(own);
}

const DividedRows* SurfaceSolverState::SumsOverProcesses() const
{
  return isTogether_ ? &together.Numbers() : nullptr;
}

double SurfaceSolverState::Largest(double own) const
{
  return isTogether_ ? together.Largest(own) : own;
}

bool SurfaceSolverState::IsFirst(bool holds) const
{
  if (!together.IsUsed())
  {
    return holds;
  }
  const double own = Ranks().Own();
  std::vector<double> first;
  if (holds)
  {
    first.push_back(own);
  }
  together.Agree(first);
  return holds && first.front() == own;
}

bool SurfaceSolverState::AreCoincidentPointsWelded() const
{
  return together.IsUsed() ? used_.space.weldCoincidentPoints : basis.weldCoincidentPoints;
}

void SurfaceSolverState::Together(const std::function<void()>& body) const
{
  if (isTogether_)
  {
    together.Together(body);
    return;
  }
  body();
}

HeldValues SurfaceSolverState::Hold(const std::vector<Id>& points, const MultiVector& values) const
{
  return together.IsUsed() ? together.Hold(used_.space.weldCoincidentPoints, points, values)
                           : HoldPointsAndEdges(
                               *space, *mesh.triangles, basis.weldCoincidentPoints, points, values);
}

BoundaryTerms SurfaceSolverState::OnBoundary(
  const MultiVector* flux, const MultiVector* values) const
{
  return together.IsUsed()
           ? together.OnBoundary(used_.space.weldCoincidentPoints, flux, values)
           : TermsOnBoundary(*space, *mesh.triangles, basis.weldCoincidentPoints, flux, values);
}

void SurfaceSolverState::FillCopies(MultiVector& atPoints) const
{
  if (together.IsUsed())
  {
    together.FillCopies(atPoints);
  }
}

std::unique_ptr<DistanceMethod> SurfaceSolverState::MakeDistance(
  const DistanceOptions& asked, const Job& job) const
{
  return together.IsUsed() ? together.MakeDistance(mesh, asked, job)
                           : Surface::MakeDistance(asked, job);
}

std::vector<char> SurfaceSolverState::PointsWithFunctions() const
{
  return together.IsUsed() ? together.PointsWithFunctions() : space->PointsWithFunctions();
}

MultiVector SurfaceSolverState::MeansOnCells(const MultiVector& onTriangles, Id cells) const
{
  return together.IsUsed() ? together.MeansOnCells(mesh, onTriangles, cells)
                           : gridfem::MeansOnCells(this->CurrentInput(), onTriangles, cells);
}

const InputMesh& SurfaceSolverState::CurrentInput() const
{
  return tracked_.Metric() ? tracked_.Moved() : mesh;
}

Field SurfaceSolverState::OnReference(Field gradients) const
{
  return tracked_.Metric() ? PullBack(*mesh.triangles, *tracked_.Moved().triangles, gradients)
                           : std::move(gradients);
}

void SurfaceSolverState::WriteTracking(vtkPolyData* output) const
{
  if (!options.trackMetric)
  {
    return;
  }
  double largest = 1.0;
  if (tracked_.Metric())
  {
    const std::vector<double> ratio =
      DistortionOf(*mesh.triangles, tracked_.Moved().triangles->points, this->Threads())
        .stretchRatio;
    largest = *std::max_element(ratio.begin(), ratio.end());
  }
  AddFieldNumber(output, "LargestStretchRatio", largest);
  if (const std::optional<double> time = tracked_.ReferenceTime())
  {
    AddFieldNumber(output, "ReferenceTime", *time);
  }
}

void SurfaceSolverState::Free()
{
  mesh = {};
  tracked_ = {};
  basis = {};
  space = {};
  metric_ = {};
  together.Free();
  stages.Forget();
}

double SurfaceSolverState::Area() const
{
  if (together.IsUsed())
  {
    return together.Area();
  }
  return metric_ ? metric_->AreaOf(*mesh.triangles) : SurfaceArea(*mesh.triangles);
}

double SurfaceSolverState::LongestSide() const
{
  if (together.IsUsed())
  {
    return together.Side();
  }
  if (tracked_.Metric())
  {
    const TriangleMesh& moved = this->CurrentMesh();
    const Bounds bounds = BoundsOf(moved.points, UsedPoints(moved), this->Threads());
    return (bounds.high - bounds.low).maxCoeff();
  }
  const Grid& grid = basis.space->GetGrid();
  return grid.spacing * grid.CellsPerSide();
}

StageKey SurfaceSolverState::InputKey() const
{
  StageKey key;
  if (input_)
  {
    AddMesh(key, input_);
  }
  key.Add(options.space.connectivityAware).Add(options.space.weldCoincidentPoints);
  key.Add(options.space.joinAtPoints).Add(options.functionsPerPoint);
  key.Add(options.choice.kind).Add(options.choice.quadratureDegree);
  key.Add(options.choice.coarsestSize).Add(options.choice.normalStabilization);
  key.Add(options.parameterUnits).Add(options.trackMetric);
  key.Add(metricArray.array).Add(metricArray.association);
  return key;
}

bool SurfaceSolverState::AreFunctionsGiven() const
{
  return basisData_ || (input_ && CarriesBasis(input_));
}

InputArray SurfaceSolverState::Find(int index, const std::string& property)
{
  if (isTogether_)
  {
    this->Prepare(progressOfAll_);
  }
  return this->FindOn(mesh, index, property);
}

InputArray SurfaceSolverState::FindOn(
  const InputMesh& onMesh, int index, const std::string& property)
{
  return isTogether_ ? together.Find(algorithm_, index, input_, onMesh, property)
                     : FindInputArray(algorithm_, index, input_, property);
}

int SurfaceSolverState::DataTypeOf(int index, const InputArray& array) const
{
  return isTogether_ ? together.DataTypeOf(index) : array.array->GetDataType();
}

void SurfaceSolverState::Select(
  SelectedPoints& points, vtkSelection* selection, const JoinedBlocks* joined) const
{
  if (isTogether_)
  {
    points.UpdateTogether(together, selection, input_);
    return;
  }
  points.Update(selection, input_, joined);
}

GivenField SurfaceSolverState::Given(const InputArray& array) const
{
  GivenField field;
  if (array.array)
  {
    field.name = array.name;
    field.association = array.association;
    field.components = array.array->GetNumberOfComponents();
    field.version.Add(array.array);
    field.read = [this, array](NaNs nans) { return ReadField(array, mesh, nans); };
  }
  return field;
}

GivenConstraints SurfaceSolverState::ConstraintsOf(
  const InputArray& values, const InputArray& mask, const SelectedPoints& selection) const
{
  GivenConstraints constraints;
  if (!mask.array && !selection.IsGiven())
  {
    return constraints;
  }
  InputArray held = values;
  if (!held.array)
  {
    held.array = input_ && input_->GetPoints() ? input_->GetPoints()->GetData() : nullptr;
    held.name = "coordinates";
  }
  constraints.property = mask.array ? "Constraint Array" : "The Selection";
  constraints.version.Add(mask.array).Add(selection.Version());
  constraints.find = [this, held, mask, &selection]
  {
    PointValues known;
    known.values.resize(0, held.array ? held.array->GetNumberOfComponents() : 3);
    if (!mesh.triangles->triangles.empty())
    {
      PointValues given = FindKnownValues(held, mask, selection, *mesh.triangles);
      known = { std::move(given.points), std::move(given.values) };
    }
    return known;
  };
  return constraints;
}

void SurfaceSolverState::SetInput(vtkPolyData* input, vtkPolyData* basisData)
{
  input_ = input;
  basisData_ = basisData;
  used_ = options;
}

void SurfaceSolverState::Prepare(const Progress& progress)
{
  if (isTogether_)
  {
    this->UpdateTogether(input_, basisData_);
    return;
  }
  this->UpdateSpace(input_, basisData_, progress.Part(0.0, 0.6));
  progress.Check(0.6);
  this->UpdateSystem(progress.Part(0.6, 1.0));
}

void SurfaceSolverState::PrepareMesh(const Progress& progress)
{
  if (basis.space)
  {
    this->Free();
  }
  used_ = options;
  StageKey key;
  AddMesh(key, input_);
  key.Add(options.space.weldCoincidentPoints);
  stages.Run(MeshStage, key,
    [&]
    {
      mesh = this->ReadMeshOf(input_, progress);
      RequireSurface(*mesh.triangles);
    });
}

void SurfaceSolverState::PrepareAtDepth(int depth, const Progress& progress)
{
  options.space.depth = depth;
  this->Prepare(progress);
}

} // namespace gridfem
