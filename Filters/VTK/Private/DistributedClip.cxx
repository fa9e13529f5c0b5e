#include "DistributedClip.h"

#if GRIDFEM_HAS_PARALLEL

#include "Allocation.h"
#include "BasisReader.h"
#include "ClippedFans.h"
#include "ClippedMeshWriter.h"
#include "DistributedInternals.h"
#include "InterpolatedArrays.h"
#include "OctreeOutput.h"
#include "PieceArrays.h"
#include "PointCoordinates.h"
#include "ReceivedArrays.h"
#include "SolverOutput.h"
#include "SurfaceSolverState.h"

#include "Integrals/Evaluation.h"
#include "Parallel/RankClip.h"

#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gridfem
{
namespace
{

using CountsOfKinds = std::array<Id, CellKinds>;

/// Returns a number for each cell of this rank's piece. It counts the cells of all ranks that are
/// no copies, as PieceJoiner numbers them without global ids. Collective.
std::vector<Id> NumberCells(const Communicator& ranks, vtkPolyData* piece, bool isCounted)
{
  std::vector<Id> number; // among the cells of the rank and the kind
  CountsOfKinds own{};
  CountsOfKinds ends{}; // of the piece's cells
  ranks.Together(
    [&]
    {
      if (!isCounted)
      {
        return;
      }
      auto* const ghosts = GhostsOf(piece->GetCellData(), piece->GetNumberOfCells());
      const auto kinds = CellsOf(piece);
      for (int kind = 0; kind < CellKinds; ++kind)
      {
        const Id count = kinds[kind] ? kinds[kind]->GetNumberOfCells() : 0;
        for (Id cell = 0; cell < count; ++cell)
        {
          const bool isCopied = ghosts && (ghosts->GetValue(static_cast<Id>(number.size())) &
                                            vtkDataSetAttributes::DUPLICATECELL) != 0;
          number.push_back(own[kind]);
          own[kind] += isCopied ? 0 : 1;
        }
        ends[kind] = static_cast<Id>(number.size());
      }
    });
  const std::vector<CountsOfKinds> all = ranks.Gather(std::vector<CountsOfKinds>{ own });
  Id before = 0;
  Id first = 0;
  for (int kind = 0; kind < CellKinds; ++kind)
  {
    for (int rank = 0; rank < ranks.Size(); ++rank)
    {
      if (rank == ranks.Rank())
      {
        std::for_each(
          number.begin() + first, number.begin() + ends[kind], [=](Id& cell) { cell += before; });
      }
      before += all[rank][kind];
    }
    first = ends[kind];
  }
  return number;
}

/// Returns the number of the cell that each received triangle comes from. Collective.
std::vector<Id> SourceCells(const Communicator& ranks, const Redistribution& distribution,
  vtkPolyData* piece, bool isCounted, const InputMesh& mesh)
{
  const std::vector<Id> number = NumberCells(ranks, piece, isCounted);
  MultiVector own;
  ranks.Together(
    [&]
    {
      own.resize(static_cast<Id>(mesh.sourceCell.size()), 1);
      std::transform(mesh.sourceCell.begin(), mesh.sourceCell.end(), own.data(),
        [&](Id cell) { return static_cast<double>(number[cell]); });
    });
  const MultiVector received = distribution.SendTriangles(own);
  return { received.data(), received.data() + received.size() };
}

/// Returns the first `count` chosen points as a data set.
vtkSmartPointer<vtkPolyData> SurfaceOfPoints(
  const std::vector<Vec3>& points, const std::vector<vtkIdType>& chosen, Id count, int precision)
{
  vtkNew<vtkPoints> some;
  some->SetDataType(precision);
  SetTuples(some->GetData(), count);
  VisitCoordinates(some,
    [&](auto* coordinates)
    {
      for (Id k = 0; k < count; ++k)
      {
        StorePoint(points[chosen[k]], coordinates + 3 * k);
      }
    });
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(some);
  return surface;
}

/// Returns the input's points that pieces use, ascending, then all cut points.
std::vector<vtkIdType> PointsOfPieces(const ClippedMesh& clipped)
{
  std::vector<char> isUsed(clipped.numberOfInputPoints, 0);
  for (const Index corner : clipped.corners)
  {
    if (corner < clipped.numberOfInputPoints)
    {
      isUsed[corner] = 1;
    }
  }
  std::vector<vtkIdType> points;
  for (Id point = 0; point < static_cast<Id>(clipped.position.size()); ++point)
  {
    if (point >= clipped.numberOfInputPoints || isUsed[point])
    {
      points.push_back(point);
    }
  }
  return points;
}

/// Returns the mesh with only these points.
ClippedMesh WithPoints(const ClippedMesh& clipped, const std::vector<vtkIdType>& points)
{
  ClippedMesh shown;
  shown.grid = clipped.grid;
  shown.cells = clipped.cells;
  shown.cellBegin = clipped.cellBegin;
  shown.pieceTriangle = clipped.pieceTriangle;
  shown.pieceBegin = clipped.pieceBegin;
  std::vector<Index> place(clipped.position.size(), -1);
  for (const vtkIdType point : points)
  {
    place[point] = static_cast<Index>(shown.position.size());
    shown.position.push_back(clipped.position[point]);
    shown.numberOfInputPoints += point < clipped.numberOfInputPoints ? 1 : 0;
  }
  shown.corners.reserve(clipped.corners.size());
  for (const Index corner : clipped.corners)
  {
    shown.corners.push_back(place[corner]);
  }
  return shown;
}

/// Returns the source triangle of each clipped triangle.
vtkSmartPointer<vtkIdTypeArray> TrianglesOfFans(const ClippedMesh& clipped, int threads)
{
  auto triangles = vtkSmartPointer<vtkIdTypeArray>::New();
  SetTuples(triangles, clipped.NumberOfTriangles());
  vtkIdType* const triangle = triangles->GetPointer(0);
  ForEachFan(clipped, threads,
    [&](Id piece, Id begin, Id end)
    { std::fill(triangle + begin, triangle + end, clipped.pieceTriangle[piece]); });
  return triangles;
}

/// Returns the levels of all ranks' functions on this rank. The divided levels come first, with the
/// rank's own patches and its own numbers of functions. The shared levels follow as a whole.
std::vector<PatchLevel> LevelsOfRank(const RankSpace& space)
{
  const std::vector<PatchLevel>& own = space.Own().Functions().levels;
  const std::size_t divided = space.Numberings().size();
  const Id before = space.Ranks().ShareOf(own[divided].NumberOfPatches()).before;
  std::vector<PatchLevel> levels;
  space.Ranks().Together(
    [&]
    {
      levels.assign(own.begin(), own.begin() + static_cast<Id>(divided));
      for (Index& parent : levels.back().parent)
      {
        parent += static_cast<Index>(before);
      }
      const std::vector<PatchLevel>& shared = space.Shared().Functions().levels;
      levels.insert(levels.end(), shared.begin(), shared.end());
    });
  return levels;
}

/// Returns the finest level of all ranks.
PatchLevel GatherFinest(const RankSpace& space)
{
  const LevelNumbering& numbering = space.Numberings().front();
  PatchLevel finest = space.Own().Functions().Finest();
  for (auto& dof : finest.dof)
  {
    for (Index& function : dof)
    {
      function = static_cast<Index>(numbering.number[function]);
    }
  }
  finest.cell = space.Ranks().Gather(finest.cell);
  finest.dof = space.Ranks().Gather(finest.dof);
  finest.numberOfFunctions = static_cast<Index>(numbering.total);
  return finest;
}

class ClipOfRanks : public DistributedClip
{
public:
  void Build(DistributedSurface& together, vtkPolyData* piece, const SurfaceOptions& options,
    InputMesh& mesh, const Progress& progress) override;
  void Take(const DistributedSurface& together, vtkPolyData* piece, bool isClipped,
    const SurfaceOptions& options, const InputMesh& mesh) override;
  void WriteMesh(
    vtkPolyData* piece, const InputMesh& mesh, int threads, vtkPolyData* output) const override;
  void WriteFunctions(int level, vtkUnstructuredGrid* output) const override;
  void AddBasisFunction(int level, Id function, int threads, vtkPolyData* output) const override;

  const ClippedMesh& Clipped() const override { return *clipped_; }
  const InputMesh& Source() const override { return source_; }
  const MortonKey* CellBefore() const override { return before_.empty() ? nullptr : &before_[0]; }
  int Precision() const override { return precision_; }

private:
  void FindPrecision(const DistributedSurface& together, vtkPolyData* piece, const InputMesh& mesh);
  void WriteFrame(const DistributedSurface& together, vtkPolyData* piece,
    const SurfaceOptions& options, const InputMesh& mesh);
  Id PatchesBefore() const;
  void AddBasis(const SurfaceOptions& options);
  void AddBasisToPiece(const InputMesh& mesh, const InputMesh& copies, vtkPolyData* piece);
  vtkSmartPointer<vtkAbstractArray> AtPointsShown(vtkAbstractArray* atAllPoints) const;

  Communicator ranks_ = RanksOfVtk();
  std::shared_ptr<const RankSurface> whole_; // with functions
  bool isClipped_ = false;                   // before
  std::shared_ptr<const Redistribution> distribution_;
  std::shared_ptr<const ClippedMesh> clipped_;
  std::vector<PatchLevel> levels_; // LevelsOfRank
  InputMesh source_;
  std::vector<MortonKey> cells_;  // of all ranks
  std::vector<MortonKey> before_; // at most one
  int precision_ = VTK_DOUBLE;
  bool areCut_ = false;           // there are cut points on some rank
  std::vector<vtkIdType> points_; // of the clipped mesh, to be output
  vtkNew<vtkPolyData> frame_;     // independent of the input's arrays
};

void ClipOfRanks::Build(DistributedSurface& together, vtkPolyData* piece,
  const SurfaceOptions& options, InputMesh& mesh, const Progress& progress)
{
  mesh = together.ReadPieces(piece, true, options.space.threads);
  RankClip clip(ranks_, *mesh.triangles, RankOptionsOf(options), progress,
    together.CopiedTriangles().triangles->triangles);
  clip.KeepOwn(ranks_);
  distribution_ = clip.distribution;
  source_.triangles = clip.mesh;
  clipped_ = std::make_shared<const ClippedMesh>(std::move(clip.clipped));
  this->FindPrecision(together, piece, mesh);
  this->WriteFrame(together, piece, options, mesh);
}

void ClipOfRanks::Take(const DistributedSurface& together, vtkPolyData* piece, bool isClipped,
  const SurfaceOptions& options, const InputMesh& mesh)
{
  isClipped_ = isClipped;
  whole_ = together.Parts().whole;
  const RankSpace& space = whole_->Space();
  distribution_ = { whole_, &space.Distribution() };
  source_.triangles = { whole_, &space.Own().Mesh() };
  clipped_ = { whole_, &space.Own().Functions().clipped };
  levels_ = LevelsOfRank(space);
  this->FindPrecision(together, piece, mesh);
  if (isClipped)
  {
    this->AddBasisToPiece(mesh, together.CopiedTriangles(), piece);
    return;
  }
  this->WriteFrame(together, piece, options, mesh);
  this->AddBasis(options);
}

/// Chooses single precision if all pieces have it.
void ClipOfRanks::FindPrecision(
  const DistributedSurface& together, vtkPolyData* piece, const InputMesh& mesh)
{
  const bool isDouble =
    !mesh.triangles->triangles.empty() && OutputPrecision(piece->GetPoints()) == VTK_DOUBLE;
  precision_ = together.Any(isDouble) ? VTK_DOUBLE : VTK_FLOAT;
}

void ClipOfRanks::WriteFrame(const DistributedSurface& together, vtkPolyData* piece,
  const SurfaceOptions& options, const InputMesh& mesh)
{
  const bool isCounted = piece && !together.IsPieceRepeated();
  source_.sourceCell = SourceCells(ranks_, *distribution_, piece, isCounted, mesh);
  areCut_ = together.Any(!clipped_->cutPoints.empty());
  cells_ = ranks_.Gather(clipped_->cells);
  const Id first = ranks_.ShareOf(static_cast<Id>(clipped_->cells.size())).before;
  before_.assign(cells_.begin() + std::max<Id>(first - 1, 0), cells_.begin() + first);
  ranks_.Together(
    [&]
    {
      // A piece without area may belong to a patch of another rank. Both then have its cell.
      std::sort(cells_.begin(), cells_.end());
      cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
      points_ = PointsOfPieces(*clipped_);
      const ClippedMesh shown = WithPoints(*clipped_, points_);
      const auto given =
        SurfaceOfPoints(source_.triangles->points, points_, shown.numberOfInputPoints, precision_);
      WriteClippedFrame(given, source_, shown, cells_, options.space.weldCoincidentPoints,
        options.space.threads, frame_);
    });
}

/// Returns the number of patches of lower ranks.
Id ClipOfRanks::PatchesBefore() const
{
  return ranks_.ShareOf(whole_->Space().Own().Functions().Finest().NumberOfPatches()).before;
}

void ClipOfRanks::AddBasis(const SurfaceOptions& options)
{
  const PatchLevel finest = GatherFinest(whole_->Space());
  const GridFunctions& own = whole_->Space().Own().Functions();
  const Id before = this->PatchesBefore();
  ranks_.Together(
    [&]
    {
      std::vector<Id> patches = PatchesOfTriangles(own, options.space.threads);
      for (Id& patch : patches)
      {
        patch += before;
      }
      WriteBasis(finest, cells_, own.support, patches, options.space.weldCoincidentPoints, frame_);
    });
}

/// Adds the tables of the basis to triangles that are already pieces.
void ClipOfRanks::AddBasisToPiece(
  const InputMesh& mesh, const InputMesh& copies, vtkPolyData* piece)
{
  const RankSpace& space = whole_->Space();
  const PatchLevel finest = GatherFinest(space);
  const GridFunctions& own = space.Own().Functions();
  const Id before = this->PatchesBefore();
  MultiVector patches; // of received triangles, each in the cells of one rank
  ranks_.Together(
    [&]
    {
      patches = MultiVector::Zero(static_cast<Id>(space.Own().Mesh().triangles.size()), 1);
      for (Id k = 0; k < own.clipped.NumberOfPieces(); ++k)
      {
        patches(own.clipped.pieceTriangle[k], 0) = static_cast<double>(before + own.piecePatch[k]);
      }
    });
  patches = space.Distribution().SumTriangles(patches);
  const MultiVector ofCopies = space.Copies().RowsOfOriginals(space.Distribution(), patches);
  ranks_.Together(
    [&]
    {
      if (mesh.triangles->triangles.empty() && copies.triangles->triangles.empty())
      {
        return;
      }
      std::vector<Id> ofCells(piece->GetNumberOfCells(), -1);
      const auto set = [&](const InputMesh& triangles, const MultiVector& rows)
      {
        for (Id t = 0; t < rows.rows(); ++t)
        {
          ofCells[triangles.sourceCell[t]] =
            std::isnan(rows(t, 0)) ? -1 : static_cast<Id>(rows(t, 0));
        }
      };
      set(mesh, patches);
      set(copies, ofCopies);
      WriteBasis(finest, ReadOctreeCells(piece), own.support, ofCells, true, frame_);
    });
}

vtkSmartPointer<vtkAbstractArray> ClipOfRanks::AtPointsShown(vtkAbstractArray* atAllPoints) const
{
  Numbering numbering;
  numbering.Add(atAllPoints->GetNumberOfTuples());
  return Pick({ atAllPoints }, numbering, points_);
}

void ClipOfRanks::WriteMesh(
  vtkPolyData* piece, const InputMesh& mesh, int threads, vtkPolyData* output) const
{
  if (isClipped_)
  {
    ranks_.Together(
      [&]
      {
        if (piece)
        {
          output->ShallowCopy(piece);
          if (frame_->GetFieldData()->GetNumberOfArrays() == 0)
          {
            RemoveClipArrays(output); // of an earlier basis
          }
          PassArrays(frame_, output);
        }
      });
    return;
  }
  vtkNew<vtkPointData> receivedPoints;
  vtkNew<vtkCellData> receivedTriangles;
  SendArrays(ranks_, *distribution_, piece, mesh, receivedPoints, receivedTriangles);
  ranks_.Together(
    [&]
    {
      output->ShallowCopy(frame_);
      vtkNew<vtkPointData> atPoints;
      InterpolatePointArrays(
        receivedPoints, *source_.triangles, *clipped_, areCut_, threads, atPoints);
      for (int k = 0; k < atPoints->GetNumberOfArrays(); ++k)
      {
        output->GetPointData()->AddArray(this->AtPointsShown(atPoints->GetAbstractArray(k)));
      }
      PassActiveAttributes(atPoints, output->GetPointData());
      CopyCellArrays(receivedTriangles, static_cast<Id>(source_.triangles->triangles.size()),
        output->GetCellData(), TrianglesOfFans(*clipped_, threads));
      if (piece)
      {
        AddFieldArrays(piece, output);
      }
    });
}

void ClipOfRanks::WriteFunctions(int depth, vtkUnstructuredGrid* output) const
{
  const std::size_t level = LevelOfDepth(levels_, depth);
  const RankLevels& ofRanks = whole_->Levels();
  const GridFunctions& own = whole_->Space().Own().Functions();
  const bool isDivided = level < whole_->Space().Numberings().size();
  ShownLevel shown;
  const std::vector<Index> component = ofRanks.ComponentsOf(0).ofFunction;
  ranks_.Together([&] { shown = DescribeLevel(levels_, PatchAreas(own), component, level); });
  const auto count = static_cast<Id>(shown.function.size());
  MultiVector area = Eigen::Map<MultiVector>(shown.area.data(), count, 1);
  MultiVector least(count, 1);
  std::copy(shown.component.begin(), shown.component.end(), least.data());
  if (isDivided)
  {
    shown.function = whole_->Space().Numberings()[level].number;
    ofRanks.Rows(level).Sum(area);
    ofRanks.Rows(level).TakeLeast(least);
    shown.firstPatch = ranks_.ShareOf(shown.level->NumberOfPatches()).before;
  }
  else
  {
    ranks_.Sum(area.data(), count);
    ranks_.Minimum(least.data(), count);
  }
  std::copy_n(area.data(), count, shown.area.data());
  shown.component.assign(least.data(), least.data() + count);
  ranks_.Together(
    [&]
    {
      if (isDivided || ranks_.Rank() == 0)
      {
        WriteBasisFunctions(own.GetGrid(), shown, precision_, output);
      }
    });
}

void ClipOfRanks::AddBasisFunction(int depth, Id function, int threads, vtkPolyData* output) const
{
  const std::size_t level = LevelOfDepth(levels_, depth);
  const std::vector<LevelNumbering>& numberings = whole_->Space().Numberings();
  MultiVector coefficients;
  ranks_.Together(
    [&]
    {
      Id here = function;
      if (level < numberings.size())
      {
        const LevelNumbering& numbering = numberings[level];
        RequireBasisFunction(levels_[level].depth, numbering.total, function);
        const auto found =
          std::lower_bound(numbering.number.begin(), numbering.number.end(), function);
        here = found != numbering.number.end() && *found == function
                 ? found - numbering.number.begin()
                 : -1;
      }
      coefficients = here < 0 ? MultiVector(MultiVector::Zero(levels_.front().numberOfFunctions, 1))
                              : BasisFunctionCoefficients(levels_, depth, here);
    });
  MultiVector values;
  if (isClipped_)
  {
    values = whole_->Levels().ValuesAtPoints(coefficients, { threads, {} });
    whole_->Space().Copies().FillPoints(whole_->Space().Distribution(), values);
  }
  ranks_.Together(
    [&]
    {
      if (!isClipped_)
      {
        values = EvaluateAtClippedPoints(whole_->Space().Own().Functions(), coefficients, threads);
      }
      const vtkSmartPointer<vtkAbstractArray> array =
        MakePointArray(BasisFunctionName, values, VTK_DOUBLE);
      output->GetPointData()->AddArray(isClipped_ ? array : this->AtPointsShown(array));
      output->GetPointData()->SetActiveScalars(BasisFunctionName);
    });
}

} // namespace

std::unique_ptr<DistributedClip> DistributedClip::Make()
{
  return std::make_unique<ClipOfRanks>();
}

} // namespace gridfem

#else

namespace gridfem
{

std::unique_ptr<DistributedClip> DistributedClip::Make()
{
  return nullptr;
}

} // namespace gridfem

#endif
