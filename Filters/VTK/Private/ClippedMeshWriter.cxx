#include "ClippedMeshWriter.h"

#include "Errors.h"
#include "InterpolatedArrays.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstring>

namespace gridfem
{
namespace
{

vtkSmartPointer<vtkIdTypeArray> NewIds(const char* name, Id tuples, int components = 1)
{
  auto array = vtkSmartPointer<vtkIdTypeArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

vtkSmartPointer<vtkIntArray> NewInts(const char* name, Id tuples, int components = 1)
{
  auto array = vtkSmartPointer<vtkIntArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

void AddInt(vtkPolyData* output, const char* name, int value)
{
  auto array = NewInts(name, 1);
  array->SetValue(0, value);
  output->GetFieldData()->AddArray(array);
}

vtkSmartPointer<vtkPoints> MakePoints(vtkPolyData* input, const ClippedMesh& clipped)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(OutputPrecision(input->GetPoints()));
  points->SetNumberOfPoints(static_cast<vtkIdType>(clipped.position.size()));
  for (Id point = 0; point < clipped.numberOfInputPoints; ++point)
  {
    points->SetPoint(point, input->GetPoint(point));
  }
  for (Id point = clipped.numberOfInputPoints; point < points->GetNumberOfPoints(); ++point)
  {
    const Vec3 position = clipped.grid.ToWorld(clipped.position[point]);
    points->SetPoint(point, position.data());
  }
  return points;
}

/// Triangles of the fans, in the order of the pieces.
vtkSmartPointer<vtkCellArray> MakeTriangles(const ClippedMesh& clipped)
{
  const Id count = clipped.NumberOfTriangles();
  vtkNew<vtkIdTypeArray> offsets;
  vtkNew<vtkIdTypeArray> connectivity;
  offsets->SetNumberOfValues(count + 1);
  connectivity->SetNumberOfValues(3 * count);
  Id triangle = 0;
  for (Id piece = 0; piece < clipped.NumberOfPieces(); ++piece)
  {
    const Id first = clipped.pieceBegin[piece];
    for (Id k = first + 1; k + 1 < clipped.pieceBegin[piece + 1]; ++k, ++triangle)
    {
      offsets->SetValue(triangle, 3 * triangle);
      connectivity->SetValue(3 * triangle, clipped.corners[first]);
      connectivity->SetValue(3 * triangle + 1, clipped.corners[k]);
      connectivity->SetValue(3 * triangle + 2, clipped.corners[k + 1]);
    }
  }
  offsets->SetValue(count, 3 * count);
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, connectivity);
  return cells;
}

void AddCellIds(const InputMesh& mesh, const ClippedMesh& clipped, vtkPolyData* output)
{
  auto source = NewIds(SourceCellIdName, clipped.NumberOfTriangles());
  auto octree = NewIds(OctreeCellIdName, clipped.NumberOfTriangles());
  Id triangle = 0;
  for (Id piece = 0; piece < clipped.NumberOfPieces(); ++piece)
  {
    const Id fan = clipped.pieceBegin[piece + 1] - clipped.pieceBegin[piece] - 2;
    for (Id k = 0; k < fan; ++k, ++triangle)
    {
      source->SetValue(triangle, mesh.sourceCell[clipped.pieceTriangle[piece]]);
      octree->SetValue(triangle, clipped.pieceCell[piece]);
    }
  }
  output->GetCellData()->AddArray(source);
  output->GetCellData()->AddArray(octree);
}

void AddGrid(const ClippedMesh& clipped, vtkPolyData* output)
{
  auto cells = NewInts(OctreeCellsName, static_cast<Id>(clipped.cells.size()), 3);
  for (std::size_t cell = 0; cell < clipped.cells.size(); ++cell)
  {
    cells->SetTypedTuple(static_cast<vtkIdType>(cell), MortonDecode(clipped.cells[cell]).data());
  }
  output->GetFieldData()->AddArray(cells);

  vtkNew<vtkDoubleArray> origin;
  origin->SetName(GridOriginName);
  origin->SetNumberOfComponents(3);
  origin->InsertNextTuple(clipped.grid.origin.data());
  output->GetFieldData()->AddArray(origin);

  vtkNew<vtkDoubleArray> spacing;
  spacing->SetName(GridSpacingName);
  spacing->InsertNextValue(clipped.grid.spacing);
  output->GetFieldData()->AddArray(spacing);
  AddInt(output, GridDepthName, clipped.grid.depth);
}

/// Field arrays of an earlier clip, when the input is the output of one of our filters.
bool IsClipField(const char* name)
{
  const auto isName = [name](const char* other) { return name && std::strcmp(name, other) == 0; };
  return isName(OctreeCellsName) || isName(GridOriginName) || isName(GridSpacingName) ||
         isName(GridDepthName) || isName(WeldCoincidentPointsName) || isName(PatchCellIdName) ||
         isName(PatchBasisIdsName) || isName(NumberOfBasisFunctionsName) ||
         isName(ConnectivityAwareName);
}

} // namespace

bool CarriesClip(vtkPolyData* data)
{
  return data && data->GetFieldData()->HasArray(OctreeCellsName) &&
         data->GetCellData()->HasArray(OctreeCellIdName);
}

bool CarriesBasis(vtkPolyData* data)
{
  return CarriesClip(data) && data->GetFieldData()->HasArray(PatchBasisIdsName) &&
         data->GetCellData()->HasArray(PatchIdName);
}

int OutputPrecision(vtkPoints* input)
{
  return input->GetDataType() == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE;
}

void WriteClippedFrame(vtkPolyData* input, const InputMesh& mesh, const ClippedMesh& clipped,
  bool weldCoincidentPoints, vtkPolyData* frame)
{
  frame->Initialize();
  frame->SetPoints(MakePoints(input, clipped));
  frame->SetPolys(MakeTriangles(clipped));
  AddCellIds(mesh, clipped, frame);
  AddGrid(clipped, frame);
  AddInt(frame, WeldCoincidentPointsName, weldCoincidentPoints);
}

void AddInputArrays(
  vtkPolyData* input, const InputMesh& mesh, const ClippedMesh& clipped, vtkPolyData* output)
{
  InterpolatePointArrays(input->GetPointData(), *mesh.triangles, clipped, output->GetPointData());
  CopyCellArrays(input->GetCellData(), input->GetNumberOfCells(), output->GetCellData(),
    output->GetCellData()->GetArray(SourceCellIdName));
  vtkFieldData* fields = input->GetFieldData();
  for (int k = 0; k < fields->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* array = fields->GetAbstractArray(k);
    if (!IsClipField(array->GetName()))
    {
      output->GetFieldData()->AddArray(array);
    }
  }
}

std::vector<Id> PatchesOfTriangles(const FunctionSpace& space)
{
  std::vector<Id> patches;
  patches.reserve(space.clipped.NumberOfTriangles());
  for (Id piece = 0; piece < space.clipped.NumberOfPieces(); ++piece)
  {
    const Id fan = space.clipped.pieceBegin[piece + 1] - space.clipped.pieceBegin[piece] - 2;
    patches.insert(patches.end(), fan, space.piecePatch[piece]);
  }
  return patches;
}

void WriteBasis(const FunctionSpace& space, const std::vector<Id>& cellPatch,
  bool weldCoincidentPoints, vtkPolyData* output)
{
  auto patchId = NewIds(PatchIdName, static_cast<Id>(cellPatch.size()));
  std::copy(cellPatch.begin(), cellPatch.end(), patchId->GetPointer(0));
  output->GetCellData()->AddArray(patchId);

  const Level& finest = space.Finest();
  auto patchCell = NewIds(PatchCellIdName, finest.NumberOfPatches());
  auto basisIds = NewIds(PatchBasisIdsName, finest.NumberOfPatches(), FunctionsPerPatch);
  const std::vector<MortonKey>& cells = space.clipped.cells;
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
  AddInt(output, NumberOfBasisFunctionsName, finest.numberOfFunctions);
  AddInt(output, ConnectivityAwareName, space.support == FunctionSupport::ConnectivityAware);
  AddInt(output, WeldCoincidentPointsName, weldCoincidentPoints);
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
