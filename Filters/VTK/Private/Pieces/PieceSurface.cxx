#include "Pieces/PieceSurface.h"

#include "Input/BasisReader.h"
#include "Pieces/CanDistribute.h"
#include "Pieces/PieceClip.h"
#include "Pieces/PieceSeams.h"
#include "Pieces/Ranks.h"

#include "Integrals/QuadratureRule.h"

#include "vtkDataArray.h"
#include "vtkMPI.h"
#include "vtkMPICommunicator.h"
#include "vtkMPIController.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gridfem
{
namespace
{

/// The ranks of VTK's global controller.
Communicator RanksOfVtk()
{
  auto* controller =
    vtkMPIController::SafeDownCast(vtkMultiProcessController::GetGlobalController());
  auto* communicator = vtkMPICommunicator::SafeDownCast(controller->GetCommunicator());
  return Communicator(*communicator->GetMPIComm()->GetHandle());
}

/// A chosen array as all ranks see it.
struct Shape
{
  int columns = 0; // 0: no array
  int isOnCells = 0;
  int dataType = 0;
};

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

PieceSurface::PieceSurface(Stages& stages, vtkAlgorithm* filter, const FilterOptions& options)
  : gridfem::Surface(stages), DistributedSurface(stages, RanksOfVtk()),
    InputSurface(filter, options)
{
}

void PieceSurface::SetInput(vtkPolyData* input, vtkPolyData* basisData)
{
  input_ = input;
  basisData_ = basisData;
  used_ = options_;
}

void PieceSurface::Run(const Progress& progress, const std::function<void(const Progress&)>& body)
{
  try
  {
    DistributedSurface::Run(progress, body);
  }
  catch (const RankFailure& failure)
  {
    if (this->Ranks().Rank() > 0)
    {
      throw FailedElsewhere();
    }
    throw InvalidInput("Rank " + std::to_string(failure.rank) + ": " + failure.what());
  }
  catch (const NeedsWholeSurface&)
  {
    throw;
  }
  catch (const InvalidInput&) // an error that is the same on all ranks
  {
    if (this->Ranks().Rank() > 0)
    {
      throw FailedElsewhere();
    }
    throw;
  }
}

void PieceSurface::Prepare(const Progress& /*progress*/)
{
  const bool isInput = this->Any(input_ && CarriesBasis(input_));
  if (!isInput && !this->Any(basisData_ && basisData_->GetNumberOfPoints() > 0))
  {
    this->PrepareFunctions(options_, false);
    return;
  }
  const std::vector<double> told = this->NumbersOfBasis(isInput ? input_ : basisData_);
  SurfaceOptions asked = options_;
  asked.space.depth = static_cast<int>(told[Depth]);
  asked.space.connectivityAware = told[Aware] != 0.0;
  this->PrepareFunctions(asked, isInput);
  if (!isInput)
  {
    this->RequireBasis(told);
  }
}

void PieceSurface::NoteThreads()
{
  used_.space.threads = this->ThreadsOfRank(options_.space.threads);
}

/// Returns the numbers of a basis that any rank has.
std::vector<double> PieceSurface::NumbersOfBasis(vtkPolyData* basisData) const
{
  std::vector<double> told;
  this->Together(
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
  this->AgreeOn(told);
  if (told.empty())
  {
    throw InvalidInput(NoBasisText);
  }
  return told;
}

/// Requires that the functions belong to the basis, as far as their numbers show.
void PieceSurface::RequireBasis(const std::vector<double>& told) const
{
  const Grid& grid = this->GetGrid();
  const bool isSameCube = grid.origin == Vec3(told[OriginX], told[OriginY], told[OriginZ]) &&
                          grid.spacing * grid.CellsPerSide() == told[Side];
  // The grid may be coarser below hat functions. Points of a clip in single precision may make a
  // few functions more.
  const double more =
    static_cast<double>(this->Functions()->Levels().Numbering(0).total) - told[AllFunctions];
  const bool isSameSpace =
    !IsRefinedByDepth(options_.choice.kind) || std::abs(more) <= 0.01 * told[AllFunctions];
  if (!isSameCube || !isSameSpace)
  {
    throw InvalidInput("The basis was made from another mesh. Connect the mesh that went into the "
                       "basis filter, or the output of the basis filter itself.");
  }
}

StageKey PieceSurface::KeyOfFunctions(const SurfaceOptions& asked, bool isClipped) const
{
  StageKey key;
  key.Add(isClipped).Add(isClipped ? 0 : asked.space.depth);
  key.Add(asked.choice.kind).Add(asked.space.joinAtPoints).Add(asked.functionsPerPoint);
  key.Add(asked.space.connectivityAware).Add(asked.space.weldCoincidentPoints);
  key.Add(asked.choice.quadratureDegree).Add(asked.choice.coarsestSize);
  key.Add(asked.choice.normalStabilization);
  if (input_)
  {
    AddMesh(key, input_);
  }
  if (input_ && isClipped)
  {
    AddClipArrays(key, input_);
  }
  return key;
}

void PieceSurface::PrepareFunctions(
  const SurfaceOptions& asked, bool isClipped, const std::function<void()>& release)
{
  StageKey key;
  this->Together(
    [&]
    {
      RequireNumber("Tolerance", options_.solve.tolerance);
      RequireNumber("Accuracy", options_.accuracy);
      TriangleRule(asked.choice.quadratureDegree); // refuses a wrong degree
      key = this->KeyOfFunctions(asked, isClipped);
    });
  Stages& stages = this->GetStages();
  stages.Run(SpaceStage, key,
    [&]
    {
      release();
      this->FreeFunctions();
      this->ReadAnew(!isClipped);
      std::shared_ptr<GivenCells> cells;
      if (isClipped)
      {
        cells = std::make_shared<GivenCells>();
        this->Together(
          [&]
          {
            if (!this->Mesh().triangles.empty())
            {
              *cells = ReadGivenCells(input_, triangles_);
            }
          });
        DistributedSurface::AgreeOn(*cells);
      }
      this->BuildFunctions(asked, copies_.triangles->triangles, cells);
    });
  this->NoteOptions(asked);
  key = {};
  key.Add(stages.Version(SpaceStage));
  stages.Run(SystemStage, key, [] {}); // made with the functions
}

InputMesh PieceSurface::ReadTriangles()
{
  return this->Read(!this->Any(input_ && CarriesBasis(input_)));
}

/// Reads the piece.
/// @param joinsSeams  joins the seams of the surface of all ranks (JoinSeamsOfRanks)
InputMesh PieceSurface::Read(bool joinsSeams)
{
  const int threads = this->ThreadsOfRank(options_.space.threads);
  InputMesh mesh;
  this->Together([&] { mesh = ReadPiece(input_, threads, copies_); });
  isRepeated_ = DistributedSurface::IsRepeated(*mesh.triangles);
  if (isRepeated_)
  {
    copies_ = this->WithCopies(mesh);
    auto none = std::make_shared<TriangleMesh>();
    none->points = copies_.triangles->points;
    mesh = {};
    mesh.triangles = std::move(none);
  }
  if (joinsSeams)
  {
    JoinSeamsOfRanks(this->Ranks(), threads, mesh, copies_);
  }
  this->Measure(*mesh.triangles);
  return mesh;
}

InputMesh PieceSurface::WithCopies(const InputMesh& mesh) const
{
  auto triangles = std::make_shared<TriangleMesh>(*mesh.triangles);
  const TriangleList& copies = copies_.triangles->triangles;
  triangles->triangles.insert(triangles->triangles.end(), copies.begin(), copies.end());
  InputMesh whole = mesh;
  whole.sourceCell.insert(
    whole.sourceCell.end(), copies_.sourceCell.begin(), copies_.sourceCell.end());
  whole.triangles = std::move(triangles);
  return whole;
}

InputArray PieceSurface::Find(int index, const std::string& property)
{
  this->Prepare({});
  return this->FindOn(triangles_, index, property);
}

InputArray PieceSurface::FindOn(const InputMesh& mesh, int index, const std::string& property)
{
  InputArray array;
  this->Together(
    [&]
    {
      if (!mesh.triangles->triangles.empty())
      {
        array = FindInputArray(filter_, index, input_, property);
      }
    });
  this->AgreeOnArray(index, array);
  return array;
}

/// Informs the other ranks about the array that ranks with polygons have found. They get an array
/// of zeros. Throws if the ranks' arrays do not fit each other.
void PieceSurface::AgreeOnArray(int index, InputArray& array)
{
  Shape own;
  if (array.array)
  {
    own = { array.array->GetNumberOfComponents(),
      array.association == FieldAssociation::Triangles ? 1 : 0, array.array->GetDataType() };
  }
  const std::vector<Shape> all = this->Ranks().Gather(std::vector<Shape>{ own });
  const auto first =
    std::find_if(all.begin(), all.end(), [](const Shape& shape) { return shape.columns > 0; });
  if (first == all.end())
  {
    return;
  }
  this->Together(
    [&]
    {
      if (own.columns > 0 && (own.columns != first->columns || own.isOnCells != first->isOnCells))
      {
        throw InvalidInput(
          "Array '" + array.name +
          "' differs between ranks: in its number of components, or it belongs to points "
          "on one rank and to cells on another.");
      }
      StandIn& known = arrays_[index];
      known.dataType = first->dataType;
      if (array.array)
      {
        return;
      }
      array.association = first->isOnCells ? FieldAssociation::Triangles : FieldAssociation::Points;
      const vtkIdType points = input_ ? input_->GetNumberOfPoints() : 0;
      const vtkIdType cells = input_ ? input_->GetNumberOfCells() : 0;
      const vtkIdType tuples = first->isOnCells ? cells : points;
      if (!known.array || known.array->GetNumberOfTuples() != tuples ||
          known.array->GetNumberOfComponents() != first->columns ||
          known.array->GetDataType() != first->dataType)
      {
        known.array.TakeReference(vtkDataArray::CreateDataArray(first->dataType));
        known.array->SetNumberOfComponents(first->columns);
        known.array->SetNumberOfTuples(tuples);
        known.array->Fill(0.0);
      }
      array.array = known.array;
    });
}

int PieceSurface::DataTypeOf(int index, const InputArray& /*array*/) const
{
  return arrays_.at(index).dataType;
}

MultiVector PieceSurface::MeansOnCells(const MultiVector& onTriangles, Id cells) const
{
  const RankSpace& space = this->Functions()->Space();
  const MultiVector ofOriginals = space.Copies().RowsOfOriginals(space.Distribution(), onTriangles);
  const MultiVector means = gridfem::MeansOnCells(triangles_, onTriangles, cells);
  return means.array().isNaN().select(gridfem::MeansOnCells(copies_, ofOriginals, cells), means);
}

Id PieceSurface::CopiedTriangles() const
{
  auto copied = static_cast<double>(triangles_.copied);
  this->Ranks().Sum(&copied, 1);
  return static_cast<Id>(copied);
}

int PieceSurface::UsedDepth() const
{
  return this->Functions() ? this->GetGrid().depth : AutomaticDepth;
}

ClippedSurface& PieceSurface::Clip()
{
  if (!clip_)
  {
    clip_ = std::make_unique<PieceClip>(*this);
  }
  return *clip_;
}

void PieceSurface::Free()
{
  clip_ = nullptr;
  copies_ = {};
  triangles_ = {};
  this->FreeFunctions();
}

} // namespace gridfem
