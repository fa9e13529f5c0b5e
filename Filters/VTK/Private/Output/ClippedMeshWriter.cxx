#include "Output/ClippedMeshWriter.h"

#include "Input/PointCoordinates.h"
#include "Output/ClippedFans.h"
#include "Output/InterpolatedArrays.h"
#include "Output/SolverOutput.h"
#include "Pipeline/Allocation.h"

#include "Base/Errors.h"
#include "Base/Parallel.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSignedCharArray.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>
#include <limits>

namespace gridfem
{
namespace
{

/// Returns the input's points, then the cut points. Points of joined seams are at their common
/// place, so that the clipped mesh is connected there when it is read again.
template<class Real>
void FillPoints(
  vtkPoints* input, const InputMesh& mesh, const ClippedMesh& clipped, int threads, Real* output)
{
  const Id inputs = clipped.numberOfInputPoints;
  const auto copy = [&](const auto* given)
  {
    ParallelRanges(inputs, threads,
      [&](Id begin, Id end) { std::copy(given + 3 * begin, given + 3 * end, output + 3 * begin); });
  };
  if (!VisitCoordinates(input, copy))
  {
    for (Id point = 0; point < inputs; ++point)
    {
      StorePoint(Vec3(input->GetPoint(point)), output + 3 * point);
    }
  }
  for (const MovedPoint& moved : mesh.moved)
  {
    StorePoint(mesh.triangles->points[moved.point], output + 3 * moved.point);
  }
  ParallelRanges(static_cast<Id>(clipped.position.size()) - inputs, threads,
    [&](Id begin, Id end)
    {
      for (Id point = inputs + begin; point < inputs + end; ++point)
      {
        StorePoint(clipped.grid.ToWorld(clipped.position[point]), output + 3 * point);
      }
    });
}

vtkSmartPointer<vtkPoints> MakePoints(
  vtkPolyData* input, const InputMesh& mesh, const ClippedMesh& clipped, int threads)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(OutputPrecision(input->GetPoints()));
  SetTuples(points->GetData(), static_cast<vtkIdType>(clipped.position.size()));
  VisitCoordinates(points, [&](auto* coordinates)
    { FillPoints(input->GetPoints(), mesh, clipped, threads, coordinates); });
  return points;
}

/// Returns the triangles of the fans, in the order of the pieces. Clip has ensured that 32 bits are
/// enough for the corners of pieces. Triangles may have more corners.
template<class Ids>
vtkSmartPointer<vtkCellArray> MakeTriangles(const ClippedMesh& clipped, int threads)
{
  const Id count = clipped.NumberOfTriangles();
  auto offsets = NewArray<Ids>(nullptr, count + 1);
  auto connectivity = NewArray<Ids>(nullptr, 3 * count);
  using Value = typename Ids::ValueType;
  Value* offset = offsets->GetPointer(0);
  Value* corner = connectivity->GetPointer(0);
  ForEachFan(clipped, threads,
    [&](Id piece, Id begin, Id end)
    {
      const Index* corners = clipped.corners.data() + clipped.pieceBegin[piece];
      for (Id triangle = begin; triangle < end; ++triangle)
      {
        const Id k = triangle - begin;
        offset[triangle] = 3 * static_cast<Value>(triangle);
        corner[3 * triangle] = corners[0];
        corner[3 * triangle + 1] = corners[k + 1];
        corner[3 * triangle + 2] = corners[k + 2];
      }
    });
  offset[count] = 3 * static_cast<Value>(count);
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, connectivity);
  return cells;
}

/// Uses 32 bits, because half the size takes half the time.
vtkSmartPointer<vtkCellArray> MakeTriangles(const ClippedMesh& clipped, int threads)
{
  const bool isSmall = 3 * clipped.NumberOfTriangles() <= std::numeric_limits<Index>::max();
  return isSmall ? MakeTriangles<vtkTypeInt32Array>(clipped, threads)
                 : MakeTriangles<vtkTypeInt64Array>(clipped, threads);
}

/// Returns, for each cell of a part of a clipped mesh, its place among the cells of the whole.
std::vector<Id> PlacesOfCells(
  const std::vector<MortonKey>& part, const std::vector<MortonKey>& whole)
{
  std::vector<Id> places;
  places.reserve(part.size());
  auto place = whole.begin();
  for (const MortonKey cell : part)
  {
    place = std::lower_bound(place, whole.end(), cell);
    places.push_back(place - whole.begin());
  }
  return places;
}

void AddCellIds(const InputMesh& mesh, const ClippedMesh& clipped,
  const std::vector<MortonKey>& cells, int threads, vtkPolyData* output)
{
  const std::vector<Id> place = PlacesOfCells(clipped.cells, cells);
  auto source = NewArray<vtkIdTypeArray>(SourceCellIdName, clipped.NumberOfTriangles());
  auto octree = NewArray<vtkIdTypeArray>(OctreeCellIdName, clipped.NumberOfTriangles());
  auto color = NewArray<vtkSignedCharArray>(OctreeCellColorName, clipped.NumberOfTriangles());
  signed char* colors = color->GetPointer(0);
  vtkIdType* sources = source->GetPointer(0);
  vtkIdType* octreeCells = octree->GetPointer(0);
  const Array<Index> pieceCell = PieceCells(clipped, threads);
  ForEachFan(clipped, threads,
    [&](Id piece, Id begin, Id end)
    {
      std::fill(sources + begin, sources + end, mesh.sourceCell[clipped.pieceTriangle[piece]]);
      std::fill(octreeCells + begin, octreeCells + end, place[pieceCell[piece]]);
      const MortonKey parities = clipped.cells[pieceCell[piece]] & 7;
      std::fill(colors + begin, colors + end, static_cast<signed char>(parities));
    });
  output->GetCellData()->AddArray(source);
  output->GetCellData()->AddArray(octree);
  output->GetCellData()->AddArray(color);
}

void AddGrid(const Grid& grid, const std::vector<MortonKey>& keys, vtkPolyData* output)
{
  auto cells = NewArray<vtkIntArray>(OctreeCellsName, static_cast<Id>(keys.size()), 3);
  for (std::size_t cell = 0; cell < keys.size(); ++cell)
  {
    cells->SetTypedTuple(static_cast<vtkIdType>(cell), MortonDecode(keys[cell]).data());
  }
  output->GetFieldData()->AddArray(cells);

  auto origin = NewArray<vtkDoubleArray>(GridOriginName, 1, 3);
  origin->SetTypedTuple(0, grid.origin.data());
  output->GetFieldData()->AddArray(origin);
  AddFieldNumber(output, GridSpacingName, grid.spacing);
  AddFieldInt(output, GridDepthName, grid.depth);
}

} // namespace

int OutputPrecision(vtkPoints* input)
{
  return input->GetDataType() == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE;
}

void WriteClippedFrame(vtkPolyData* input, const InputMesh& mesh, const ClippedMesh& clipped,
  bool weldCoincidentPoints, int threads, vtkPolyData* frame)
{
  WriteClippedFrame(input, mesh, clipped, clipped.cells, weldCoincidentPoints, threads, frame);
}

void WriteClippedFrame(vtkPolyData* input, const InputMesh& mesh, const ClippedMesh& part,
  const std::vector<MortonKey>& cells, bool weldCoincidentPoints, int threads, vtkPolyData* frame)
{
  frame->Initialize();
  frame->SetPoints(MakePoints(input, mesh, part, threads));
  frame->SetPolys(MakeTriangles(part, threads));
  AddCellIds(mesh, part, cells, threads, frame);
  AddGrid(part.grid, cells, frame);
  AddFieldInt(frame, WeldCoincidentPointsName, weldCoincidentPoints);
}

void AddInputArrays(vtkPolyData* input, const InputMesh& mesh, const ClippedMesh& clipped,
  int threads, vtkPolyData* output)
{
  InterpolatePointArrays(input->GetPointData(), *mesh.triangles, clipped,
    !clipped.cutPoints.empty(), threads, output->GetPointData());
  CopyCellArrays(input->GetCellData(), input->GetNumberOfCells(), CarriesClip(input),
    output->GetCellData(), output->GetCellData()->GetArray(SourceCellIdName));
  AddFieldArrays(input, output);
}

void AddFieldArrays(vtkPolyData* input, vtkPolyData* output)
{
  vtkFieldData* fields = input->GetFieldData();
  for (int k = 0; k < fields->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* array = fields->GetAbstractArray(k);
    if (!IsClipFieldArray(array->GetName())) // arrays of an earlier clip
    {
      output->GetFieldData()->AddArray(array);
    }
  }
}

std::vector<Id> PatchesOfTriangles(const GridFunctions& space, int threads)
{
  std::vector<Id> patches(space.clipped.NumberOfTriangles());
  ForEachFan(space.clipped, threads,
    [&](Id piece, Id begin, Id end)
    { std::fill(patches.data() + begin, patches.data() + end, space.piecePatch[piece]); });
  return patches;
}

namespace
{

/// Returns the color of the octree cell, plus 8 if the patch is not the first in its cell. Such
/// patches show where connectivity separates the surface.
std::vector<signed char> ColorsOfPatches(const PatchLevel& level)
{
  std::vector<signed char> colors(level.NumberOfPatches());
  for (Id patch = 0; patch < level.NumberOfPatches(); ++patch)
  {
    const bool isFirst = patch == 0 || level.cell[patch - 1] != level.cell[patch];
    colors[patch] = static_cast<signed char>((level.cell[patch] & 7) + (isFirst ? 0 : 8));
  }
  return colors;
}

} // namespace

void WriteBasis(const PatchLevel& finest, const std::vector<MortonKey>& cells,
  FunctionSupport support, const std::vector<Id>& cellPatch, bool weldCoincidentPoints,
  vtkPolyData* output)
{
  output->GetCellData()->AddArray(MakeIdArray(PatchIdName, cellPatch));

  const std::vector<signed char> colors = ColorsOfPatches(finest);
  auto patchColor = NewArray<vtkSignedCharArray>(PatchColorName, static_cast<Id>(cellPatch.size()));
  std::transform(cellPatch.begin(), cellPatch.end(), patchColor->GetPointer(0),
    [&](Id patch) { return patch < 0 ? static_cast<signed char>(-1) : colors[patch]; });
  output->GetCellData()->AddArray(patchColor);
  auto patchCell = NewArray<vtkIdTypeArray>(PatchCellIdName, finest.NumberOfPatches());
  auto basisIds =
    NewArray<vtkIdTypeArray>(PatchBasisIdsName, finest.NumberOfPatches(), FunctionsPerPatch);
  for (Id patch = 0; patch < finest.NumberOfPatches(); ++patch)
  {
    const auto cell = std::lower_bound(cells.begin(), cells.end(), finest.cell[patch]);
    patchCell->SetValue(patch, cell - cells.begin());
    for (int corner = 0; corner < FunctionsPerPatch; ++corner)
    {
      basisIds->SetTypedComponent(patch, corner, finest.dof[patch][corner]);
    }
  }
  output->GetFieldData()->AddArray(patchCell);
  output->GetFieldData()->AddArray(basisIds);
  AddFieldInt(output, NumberOfBasisFunctionsName, finest.numberOfFunctions);
  AddFieldInt(output, ConnectivityAwareName, support == FunctionSupport::ConnectivityAware);
  AddFieldInt(output, WeldCoincidentPointsName, weldCoincidentPoints);
}

void PassArrays(vtkPolyData* from, vtkPolyData* to)
{
  for (int k = 0; k < from->GetCellData()->GetNumberOfArrays(); ++k)
  {
    to->GetCellData()->AddArray(from->GetCellData()->GetAbstractArray(k));
  }
  for (int k = 0; k < from->GetFieldData()->GetNumberOfArrays(); ++k)
  {
    to->GetFieldData()->AddArray(from->GetFieldData()->GetAbstractArray(k));
  }
}

} // namespace gridfem
