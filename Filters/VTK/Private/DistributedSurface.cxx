#include "DistributedSurface.h"

#if GRIDFEM_HAS_PARALLEL

#include "BasisReader.h"
#include "DistributedInternals.h"
#include "GivenValues.h"
#include "Ranks.h"
#include "SurfaceSolverState.h"

#include "Base/Parallel.h"
#include "Parallel/HeldPoints.h"
#include "Parallel/RankBoundary.h"
#include "Parallel/RankDistance.h"
#include "Parallel/RankMemory.h"
#include "Parallel/RankSeams.h"

#include "vtkDataArray.h"
#include "vtkMPI.h"
#include "vtkMPICommunicator.h"
#include "vtkMPIController.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace gridfem
{

Communicator RanksOfVtk()
{
  auto* controller =
    vtkMPIController::SafeDownCast(vtkMultiProcessController::GetGlobalController());
  auto* communicator = vtkMPICommunicator::SafeDownCast(controller->GetCommunicator());
  return Communicator(*communicator->GetMPIComm()->GetHandle());
}

RankSpaceOptions RankOptionsOf(const SurfaceOptions& options)
{
  RankSpaceOptions result;
  result.space = { options.choice, options.space };
  result.functionsPerPoint = options.functionsPerPoint;
  return result;
}

namespace
{

/// Hashes the bits of added data, so that equal data have equal digests. FNV-1a.
class Digest
{
public:
  template<class Item>
  void operator()(const Item& item)
  {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &item, sizeof(item));
    value_ = (value_ ^ bits) * 1099511628211ULL;
    value_ ^= value_ >> 29;
  }

  std::uint64_t Value() const { return value_; }

private:
  std::uint64_t value_ = 14695981039346656037ULL;
};

std::uint64_t DigestOf(const TriangleMesh& mesh)
{
  Digest digest;
  for (const Vec3& point : mesh.points)
  {
    std::for_each(point.data(), point.data() + 3, std::ref(digest));
  }
  for (const auto& corners : mesh.triangles)
  {
    std::for_each(corners.begin(), corners.end(), std::ref(digest));
  }
  return digest.Value();
}

std::uint64_t DigestOf(const std::vector<MortonKey>& cells)
{
  Digest digest;
  std::for_each(cells.begin(), cells.end(), std::ref(digest));
  return digest.Value();
}

/// Whether an earlier rank has this piece, too. Collective.
bool IsRepeated(const Communicator& ranks, const TriangleMesh& mesh)
{
  const bool hasAny = !mesh.triangles.empty();
  const std::vector<std::uint64_t> digests =
    ranks.Gather(std::vector<std::uint64_t>{ hasAny ? DigestOf(mesh) : 0 });
  const auto own = digests.begin() + ranks.Rank();
  return hasAny && std::find(digests.begin(), own, *own) != own;
}

void ApplyMoves(const Seams& seams, int threads, InputMesh& mesh)
{
  auto triangles = std::make_shared<TriangleMesh>(*mesh.triangles);
  mesh.moved = MovePoints(seams.moves, *triangles, threads);
  mesh.isWelded = true;
  mesh.triangles = std::move(triangles);
}

/// Joins the seams of the surface of all ranks, also in the copies of triangles. Collective.
void JoinSeamsOfRanks(const Communicator& ranks, int threads, InputMesh& mesh, InputMesh& copies)
{
  const Seams seams = FindSeams(ranks, *mesh.triangles, threads);
  if (!seams.divisions.empty())
  {
    throw NeedsWholeSurface();
  }
  if (!seams.moves.empty())
  {
    ranks.Together(
      [&]
      {
        ApplyMoves(seams, threads, mesh);
        ApplyMoves(seams, threads, copies);
      });
  }
}

/// A chosen array as all ranks see it.
struct Shape
{
  int columns = 0; // 0: no array
  int isOnCells = 0;
  int dataType = 0;
};

} // namespace

DistributedSurface::DistributedSurface() = default;
DistributedSurface::~DistributedSurface() = default;

void DistributedSurface::Run(const Progress& progress, const Body& body)
{
  if (!ranks_)
  {
    ranks_ = std::make_unique<Internals>();
  }
  progress_ = progress;
  const Communicator& ranks = ranks_->ranks;
  try
  {
    ranks.Guard([&] { body(OfAllRanks(ranks, progress)); });
  }
  catch (const RankFailure& failure)
  {
    if (ranks.Rank() > 0)
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
    if (ranks.Rank() > 0)
    {
      throw FailedElsewhere();
    }
    throw;
  }
}

void DistributedSurface::Together(const std::function<void()>& body) const
{
  ranks_->ranks.Together(body);
}

void DistributedSurface::Require(const MemoryNeed& own) const
{
  RequireMemory(ranks_->ranks, own);
}

bool DistributedSurface::Any(bool holds) const
{
  return this->Largest(holds ? 1.0 : 0.0) > 0.0;
}

const Grid& DistributedSurface::GridOfRanks() const
{
  return ranks_->whole->Space().Own().Functions().GetGrid();
}

Id DistributedSurface::NumberOfFunctions() const
{
  return ranks_->whole->Levels().Numbering(0).total;
}

double DistributedSurface::Largest(double own) const
{
  constexpr double Unknown = std::numeric_limits<double>::infinity();
  double largest = std::isnan(own) ? Unknown : own; // MPI does not define the maximum of NaN
  ranks_->ranks.Maximum(&largest, 1);
  return largest == Unknown ? std::nan("") : largest;
}

int DistributedSurface::ThreadsOfRank(int wanted) const
{
  const int all = std::max(1, NumberOfThreads(0) / ranks_->ranks.RanksOfMachine());
  return wanted > 0 ? wanted : all;
}

InputMesh DistributedSurface::ReadPieces(vtkPolyData* piece, bool joinsSeams, int threads)
{
  const Communicator& ranks = ranks_->ranks;
  InputMesh mesh;
  ranks.Together(
    [&]
    {
      numberOfPoints_ = piece ? piece->GetNumberOfPoints() : 0;
      numberOfCells_ = piece ? piece->GetNumberOfCells() : 0;
      mesh = ReadPiece(piece, threads, copies_);
    });
  isRepeated_ = IsRepeated(ranks, *mesh.triangles);
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
    JoinSeamsOfRanks(ranks, threads, mesh, copies_);
  }
  area_ = SurfaceArea(*mesh.triangles);
  ranks.Sum(&area_, 1);
  if (!(area_ > 0.0))
  {
    throw InvalidInput("The surface has no area: all polygons are degenerate.");
  }
  return mesh;
}

/// Builds the space on the grid of the first rank with triangles.
std::shared_ptr<const GivenCells> DistributedSurface::ReadCells(
  vtkPolyData* piece, const InputMesh& mesh) const
{
  auto given = std::make_shared<GivenCells>();
  std::vector<double> numbers;
  this->Together(
    [&]
    {
      if (!mesh.triangles->triangles.empty())
      {
        *given = ReadGivenCells(piece, mesh);
        const Vec3& origin = given->grid.origin;
        numbers = { origin[0], origin[1], origin[2], given->grid.spacing,
          static_cast<double>(given->grid.depth), static_cast<double>(given->cells.size()),
          static_cast<double>(DigestOf(given->cells) >> 12) };
      }
    });
  const std::vector<double> own = numbers;
  this->Agree(numbers);
  this->Together(
    [&]
    {
      if (!own.empty() && own != numbers)
      {
        throw InvalidInput(
          "The surface of this rank was clipped to a different grid than the surface of "
          "other ranks. Clip it again.");
      }
    });
  given->grid.origin = Vec3(numbers[0], numbers[1], numbers[2]);
  given->grid.spacing = numbers[3];
  given->grid.depth = static_cast<int>(numbers[4]);
  return given;
}

void DistributedSurface::BuildSpace(
  vtkPolyData* piece, const SurfaceOptions& options, bool isClipped, InputMesh& mesh)
{
  this->Free();
  mesh = this->ReadPieces(piece, !isClipped, options.space.threads);
  const Communicator& ranks = ranks_->ranks;
  RankSpaceOptions rankOptions = RankOptionsOf(options);
  if (isClipped)
  {
    rankOptions.given = this->ReadCells(piece, mesh);
  }
  auto whole = std::make_shared<const RankSurface>(ranks, *mesh.triangles, rankOptions,
    options.choice.kind == FunctionKind::Hats, progress_, copies_.triangles->triangles);
  space_ = std::shared_ptr<const SurfaceSpace>(whole, &whole->Levels());
  ranks_->whole = std::move(whole);
}

void DistributedSurface::Agree(int index, InputArray& array)
{
  const Communicator& ranks = ranks_->ranks;
  Shape own;
  if (array.array)
  {
    own = { array.array->GetNumberOfComponents(),
      array.association == FieldAssociation::Triangles ? 1 : 0, array.array->GetDataType() };
  }
  const std::vector<Shape> all = ranks.Gather(std::vector<Shape>{ own });
  const auto first =
    std::find_if(all.begin(), all.end(), [](const Shape& shape) { return shape.columns > 0; });
  if (first == all.end())
  {
    return;
  }
  ranks.Together(
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
      const vtkIdType tuples = first->isOnCells ? numberOfCells_ : numberOfPoints_;
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

InputArray DistributedSurface::Find(vtkAlgorithm* filter, int index, vtkPolyData* piece,
  const InputMesh& mesh, const std::string& property)
{
  InputArray array;
  this->Together(
    [&]
    {
      if (!mesh.triangles->triangles.empty())
      {
        array = FindInputArray(filter, index, piece, property);
      }
    });
  this->Agree(index, array);
  return array;
}

int DistributedSurface::DataTypeOf(int index) const
{
  return arrays_.at(index).dataType;
}

void DistributedSurface::Agree(std::vector<double>& numbers) const
{
  const Communicator& ranks = ranks_->ranks;
  const std::vector<Id> counts = ranks.Gather(std::vector<Id>{ static_cast<Id>(numbers.size()) });
  const std::vector<double> all = ranks.Gather(numbers);
  const auto first = std::find_if(counts.begin(), counts.end(), [](Id count) { return count > 0; });
  numbers.assign(all.begin(), all.begin() + (first == counts.end() ? 0 : *first));
}

void DistributedSurface::Free()
{
  space_ = nullptr;
  copies_ = {};
  if (ranks_)
  {
    ranks_->whole = nullptr;
  }
}

const DividedRows& DistributedSurface::Numbers() const
{
  return ranks_->numbers;
}

InputMesh DistributedSurface::WithCopies(const InputMesh& mesh) const
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

void DistributedSurface::FillCopies(MultiVector& atPoints) const
{
  const RankSpace& space = ranks_->whole->Space();
  space.Copies().FillPoints(space.Distribution(), atPoints);
}

MultiVector DistributedSurface::MeansOnCells(
  const InputMesh& mesh, const MultiVector& onTriangles, Id cells) const
{
  const RankSpace& space = ranks_->whole->Space();
  const MultiVector ofOriginals = space.Copies().RowsOfOriginals(space.Distribution(), onTriangles);
  return gridfem::MeansOnCells(mesh, onTriangles, cells) +
         gridfem::MeansOnCells(copies_, ofOriginals, cells);
}

std::vector<char> DistributedSurface::PointsWithFunctions() const
{
  std::vector<char> has = space_->PointsWithFunctions();
  MultiVector numbers(static_cast<Id>(has.size()), 1);
  std::copy(has.begin(), has.end(), numbers.data());
  this->FillCopies(numbers);
  std::transform(numbers.data(), numbers.data() + numbers.size(), has.begin(),
    [](double n) { return n == 1.0; });
  return has;
}

HeldValues DistributedSurface::Hold(
  bool weldCoincidentPoints, const std::vector<Id>& points, const MultiVector& values) const
{
  return HoldPointsAndEdges(ranks_->whole->Levels(), weldCoincidentPoints, points, values);
}

BoundaryTerms DistributedSurface::OnBoundary(
  bool weldCoincidentPoints, const MultiVector* flux, const MultiVector* values) const
{
  return TermsOnBoundary(ranks_->whole->Levels(), weldCoincidentPoints, flux, values);
}

std::unique_ptr<DistanceMethod> DistributedSurface::MakeDistance(
  const InputMesh& mesh, const DistanceOptions& options, const Job& job) const
{
  return std::make_unique<RankDistance>(ranks_->whole->Levels(), mesh.triangles, options, job);
}

} // namespace gridfem

#else

#include "Problems/GeodesicDistance.h"

namespace gridfem
{
namespace
{

/// Filters never call it, because CanDistribute refuses first.
[[noreturn]] void RefuseWithoutMpi()
{
  throw InvalidInput("This build has no MPI.");
}

} // namespace

struct DistributedSurface::Internals
{
};

DistributedSurface::DistributedSurface() = default;
DistributedSurface::~DistributedSurface() = default;

void DistributedSurface::Free()
{
}

void DistributedSurface::Run(const Progress&, const Body&)
{
  RefuseWithoutMpi();
}

void DistributedSurface::Together(const std::function<void()>&) const
{
  RefuseWithoutMpi();
}

void DistributedSurface::Require(const MemoryNeed&) const
{
  RefuseWithoutMpi();
}

bool DistributedSurface::Any(bool) const
{
  RefuseWithoutMpi();
}

const Grid& DistributedSurface::GridOfRanks() const
{
  RefuseWithoutMpi();
}

Id DistributedSurface::NumberOfFunctions() const
{
  RefuseWithoutMpi();
}

double DistributedSurface::Largest(double) const
{
  RefuseWithoutMpi();
}

InputMesh DistributedSurface::ReadPieces(vtkPolyData*, bool, int)
{
  RefuseWithoutMpi();
}

void DistributedSurface::BuildSpace(vtkPolyData*, const SurfaceOptions&, bool, InputMesh&)
{
  RefuseWithoutMpi();
}

const DividedRows& DistributedSurface::Numbers() const
{
  RefuseWithoutMpi();
}

InputMesh DistributedSurface::WithCopies(const InputMesh&) const
{
  RefuseWithoutMpi();
}

int DistributedSurface::ThreadsOfRank(int) const
{
  RefuseWithoutMpi();
}

void DistributedSurface::Agree(int, InputArray&)
{
  RefuseWithoutMpi();
}

InputArray DistributedSurface::Find(
  vtkAlgorithm*, int, vtkPolyData*, const InputMesh&, const std::string&)
{
  RefuseWithoutMpi();
}

int DistributedSurface::DataTypeOf(int) const
{
  RefuseWithoutMpi();
}

void DistributedSurface::Agree(std::vector<double>&) const
{
  RefuseWithoutMpi();
}

void DistributedSurface::FillCopies(MultiVector&) const
{
  RefuseWithoutMpi();
}

MultiVector DistributedSurface::MeansOnCells(const InputMesh&, const MultiVector&, Id) const
{
  RefuseWithoutMpi();
}

std::vector<char> DistributedSurface::PointsWithFunctions() const
{
  RefuseWithoutMpi();
}

HeldValues DistributedSurface::Hold(bool, const std::vector<Id>&, const MultiVector&) const
{
  RefuseWithoutMpi();
}

BoundaryTerms DistributedSurface::OnBoundary(bool, const MultiVector*, const MultiVector*) const
{
  RefuseWithoutMpi();
}

std::unique_ptr<DistanceMethod> DistributedSurface::MakeDistance(
  const InputMesh&, const DistanceOptions&, const Job&) const
{
  RefuseWithoutMpi();
}

} // namespace gridfem

#endif
