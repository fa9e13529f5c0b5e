#include "Pieces/PieceClip.h"

#include "Input/BasisReader.h"
#include "Input/PointCoordinates.h"
#include "Input/SourceCells.h"
#include "Output/ClippedFans.h"
#include "Output/ClippedMeshWriter.h"
#include "Output/InterpolatedArrays.h"
#include "Output/OctreeOutput.h"
#include "Output/SolverOutput.h"
#include "Pieces/PieceArrays.h"
#include "Pieces/ReceivedArrays.h"
#include "Pipeline/Allocation.h"

#include "Base/SortEachOnce.h"
#include "Integrals/Evaluation.h"
#include "Parallel/RankClip.h"
#include "Parallel/ShownParts.h"

#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

constexpr const char* ClipStage = "ClipOfRanks";

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

/// Returns the source triangle of each clipped triangle.
vtkSmartPointer<vtkIdTypeArray> TrianglesOfFans(const ClippedMesh& clipped, int threads)
{
  auto triangles = NewArray<vtkIdTypeArray>(nullptr, clipped.NumberOfTriangles());
  vtkIdType* const triangle = triangles->GetPointer(0);
  ForEachFan(clipped, threads,
    [&](Id piece, Id begin, Id end)
    { std::fill(triangle + begin, triangle + end, clipped.pieceTriangle[piece]); });
  return triangles;
}

} // namespace

PieceClip::PieceClip(PieceSurface& surface) : surface_(surface)
{
}

PieceClip::~PieceClip() = default;

void PieceClip::Free()
{
  functions_ = nullptr;
  distribution_ = nullptr;
  clipped_ = nullptr;
  levels_.clear();
  source_ = {};
  frame_->Initialize();
}

void PieceClip::UpdateClip(const Progress& /*progress*/)
{
  surface_.NoteThreads();
  StageKey key;
  surface_.Together(
    [&]
    {
      key.Add(surface_.Options().space.depth);
      if (surface_.Piece())
      {
        AddMesh(key, surface_.Piece());
      }
    });
  surface_.GetStages().Run(SpaceStage, key,
    [&]
    {
      this->Free();
      surface_.ReadAnew(true);
      RankSpaceOptions options;
      options.space = { surface_.Options().choice, surface_.Options().space };
      options.space.functions.threads = surface_.Threads();
      RankClip clip(surface_.Ranks(), surface_.Mesh(), options,
        surface_.ProgressOfRank().Part(0.1, 0.7), surface_.Copies().triangles->triangles);
      clip.KeepOwn(surface_.Ranks());
      distribution_ = clip.distribution;
      source_.triangles = clip.mesh;
      clipped_ = std::make_shared<const ClippedMesh>(std::move(clip.clipped));
      this->FindPrecision();
      this->WriteFrame();
    });
}

void PieceClip::UpdateBasis(bool /*isShared*/, const Progress& /*progress*/)
{
  isInputClipped_ = surface_.Any(CarriesClip(surface_.Piece()));
  SurfaceOptions options = surface_.Options();
  options.choice.kind = FunctionKind::Grid;
  surface_.PrepareFunctions(options, isInputClipped_, [&] { this->Free(); });
  StageKey key;
  key.Add(surface_.GetStages().Version(SpaceStage));
  surface_.GetStages().Run(ClipStage, key,
    [&]
    {
      this->Free();
      this->TakeFunctions();
    });
}

void PieceClip::TakeFunctions()
{
  functions_ = surface_.Functions();
  const RankSpace& space = functions_->Space();
  distribution_ = { functions_, &space.Distribution() };
  source_.triangles = { functions_, &space.Own().Mesh() };
  clipped_ = { functions_, &space.Own().Functions().clipped };
  levels_ = LevelsOfRank(space);
  this->FindPrecision();
  if (isInputClipped_)
  {
    this->AddBasisToPiece();
    return;
  }
  this->WriteFrame();
  this->AddBasis();
}

/// Chooses single precision if all pieces have it.
void PieceClip::FindPrecision()
{
  const bool isDouble = !surface_.Mesh().triangles.empty() &&
                        OutputPrecision(surface_.Piece()->GetPoints()) == VTK_DOUBLE;
  precision_ = surface_.Any(isDouble) ? VTK_DOUBLE : VTK_FLOAT;
}

void PieceClip::WriteFrame()
{
  const Communicator& ranks = surface_.Ranks();
  const bool isCounted = surface_.Piece() && !surface_.IsRepeated();
  source_.sourceCell =
    SourceCells(ranks, *distribution_, surface_.Piece(), isCounted, surface_.Triangles());
  areCut_ = surface_.Any(!clipped_->cutPoints.empty());
  cells_ = ranks.Gather(clipped_->cells);
  const Id first = ranks.ShareOf(static_cast<Id>(clipped_->cells.size())).before;
  before_.assign(cells_.begin() + std::max<Id>(first - 1, 0), cells_.begin() + first);
  ranks.Together(
    [&]
    {
      // A piece without area may belong to a patch of another rank. Both then have its cell.
      SortEachOnce(cells_);
      const std::vector<Id> points = PointsOfPieces(*clipped_);
      points_.assign(points.begin(), points.end());
      const ClippedMesh shown = WithPoints(*clipped_, points);
      const auto given =
        SurfaceOfPoints(source_.triangles->points, points_, shown.numberOfInputPoints, precision_);
      WriteClippedFrame(given, source_, shown, cells_,
        surface_.Options().space.weldCoincidentPoints, surface_.Threads(), frame_);
    });
}

/// Returns the number of patches of lower ranks.
Id PieceClip::PatchesBefore() const
{
  return surface_.Ranks()
    .ShareOf(functions_->Space().Own().Functions().Finest().NumberOfPatches())
    .before;
}

void PieceClip::AddBasis()
{
  const PatchLevel finest = GatherFinest(functions_->Space());
  const GridFunctions& own = functions_->Space().Own().Functions();
  const Id before = this->PatchesBefore();
  surface_.Together(
    [&]
    {
      std::vector<Id> patches = PatchesOfTriangles(own, surface_.Threads());
      for (Id& patch : patches)
      {
        patch += before;
      }
      WriteBasis(finest, cells_, own.support, patches,
        surface_.Options().space.weldCoincidentPoints, frame_);
    });
}

/// Returns the patches of this rank's triangles, which are pieces. NaN without a patch.
MultiVector PieceClip::PatchesOfOwn() const
{
  const RankSpace& space = functions_->Space();
  const GridFunctions& own = space.Own().Functions();
  const Id before = this->PatchesBefore();
  MultiVector patches; // of received triangles, each in the cells of one rank
  surface_.Together(
    [&]
    {
      patches = MultiVector::Zero(static_cast<Id>(space.Own().Mesh().triangles.size()), 1);
      for (Id k = 0; k < own.clipped.NumberOfPieces(); ++k)
      {
        patches(own.clipped.pieceTriangle[k], 0) = static_cast<double>(before + own.piecePatch[k]);
      }
    });
  return space.Distribution().SumTriangles(patches);
}

/// Adds the tables of the basis to triangles that are already pieces.
void PieceClip::AddBasisToPiece()
{
  const RankSpace& space = functions_->Space();
  const PatchLevel finest = GatherFinest(space);
  const MultiVector patches = this->PatchesOfOwn();
  const MultiVector ofCopies = space.Copies().RowsOfOriginals(space.Distribution(), patches);
  surface_.Together(
    [&]
    {
      const InputMesh& mesh = surface_.Triangles();
      const InputMesh& copies = surface_.Copies();
      if (mesh.triangles->triangles.empty() && copies.triangles->triangles.empty())
      {
        return;
      }
      vtkPolyData* const piece = surface_.Piece();
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
      const FunctionSupport support = space.Own().Functions().support;
      WriteBasis(finest, ReadOctreeCells(piece), support, ofCells, true, frame_);
    });
}

vtkSmartPointer<vtkAbstractArray> PieceClip::AtPointsShown(vtkAbstractArray* atAllPoints) const
{
  Numbering numbering;
  numbering.Add(atAllPoints->GetNumberOfTuples());
  return Pick({ atAllPoints }, numbering, points_);
}

void PieceClip::WriteMesh(vtkPolyData* output) const
{
  vtkPolyData* const piece = surface_.Piece();
  if (isInputClipped_)
  {
    surface_.Together(
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
  const bool isClipped = surface_.Any(CarriesClip(piece));
  vtkNew<vtkPointData> receivedPoints;
  vtkNew<vtkCellData> receivedTriangles;
  SendArrays(surface_.Ranks(), *distribution_, piece, surface_.Triangles(), receivedPoints,
    receivedTriangles);
  surface_.Together(
    [&]
    {
      output->ShallowCopy(frame_);
      vtkNew<vtkPointData> atPoints;
      InterpolatePointArrays(
        receivedPoints, *source_.triangles, *clipped_, areCut_, surface_.Threads(), atPoints);
      for (int k = 0; k < atPoints->GetNumberOfArrays(); ++k)
      {
        output->GetPointData()->AddArray(this->AtPointsShown(atPoints->GetAbstractArray(k)));
      }
      PassActiveAttributes(atPoints, output->GetPointData());
      CopyCellArrays(receivedTriangles, static_cast<Id>(source_.triangles->triangles.size()),
        isClipped, output->GetCellData(), TrianglesOfFans(*clipped_, surface_.Threads()));
      if (piece)
      {
        AddFieldArrays(piece, output);
      }
    });
}

void PieceClip::WriteFunctions(int depth, vtkUnstructuredGrid* output) const
{
  const Communicator& ranks = surface_.Ranks();
  const std::size_t level = LevelOfDepth(levels_, depth);
  const RankLevels& ofRanks = functions_->Levels();
  const GridFunctions& own = functions_->Space().Own().Functions();
  const bool isDivided = level < functions_->Space().Numberings().size();
  ShownLevel shown;
  const std::vector<Index> component = ofRanks.ComponentsOf(0).ofFunction;
  surface_.Together([&] { shown = DescribeLevel(levels_, PatchAreas(own), component, level); });
  const auto count = static_cast<Id>(shown.function.size());
  MultiVector area = Eigen::Map<MultiVector>(shown.area.data(), count, 1);
  MultiVector least(count, 1);
  std::copy(shown.component.begin(), shown.component.end(), least.data());
  if (isDivided)
  {
    shown.function = functions_->Space().Numberings()[level].number;
    ofRanks.Rows(level).Sum(area);
    ofRanks.Rows(level).TakeLeast(least);
    shown.firstPatch = ranks.ShareOf(shown.level->NumberOfPatches()).before;
  }
  else
  {
    ranks.Sum(area.data(), count);
    ranks.Minimum(least.data(), count);
  }
  std::copy_n(area.data(), count, shown.area.data());
  shown.component.assign(least.data(), least.data() + count);
  surface_.Together(
    [&]
    {
      if (isDivided || ranks.Rank() == 0)
      {
        WriteBasisFunctions(own.GetGrid(), shown, precision_, output);
      }
    });
}

void PieceClip::AddBasisFunction(int depth, Id function, vtkPolyData* output) const
{
  const std::size_t level = LevelOfDepth(levels_, depth);
  const std::vector<LevelNumbering>& numberings = functions_->Space().Numberings();
  MultiVector coefficients;
  surface_.Together(
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
  if (isInputClipped_)
  {
    values = functions_->Levels().ValuesAtPoints(coefficients, { surface_.Threads(), {} });
    functions_->Space().Copies().FillPoints(functions_->Space().Distribution(), values);
  }
  surface_.Together(
    [&]
    {
      if (!isInputClipped_)
      {
        values = EvaluateAtClippedPoints(
          functions_->Space().Own().Functions(), coefficients, surface_.Threads());
      }
      const vtkSmartPointer<vtkAbstractArray> array =
        MakePointArray(BasisFunctionName, values, VTK_DOUBLE);
      output->GetPointData()->AddArray(isInputClipped_ ? array : this->AtPointsShown(array));
      output->GetPointData()->SetActiveScalars(BasisFunctionName);
    });
}

} // namespace gridfem
