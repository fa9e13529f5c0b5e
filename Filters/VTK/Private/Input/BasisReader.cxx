#include "Input/BasisReader.h"

#include "Base/Errors.h"
#include "Grid/PatchChoice.h"
#include "Output/BasisConversion.h"
#include "Pipeline/vtkSurfaceBasisHolder.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

namespace gridfem
{
namespace
{

/// The distance, in cells, that a point may lie outside its cell in addition to the rounding of its
/// coordinates.
constexpr double OutsideCell = 1e-9;

vtkDataArray* RequireArray(vtkFieldData* fields, const char* name, int components, Id tuples)
{
  vtkDataArray* array = fields->GetArray(name);
  if (!array)
  {
    throw InvalidInput("Array '" + std::string(name) +
                       "' is missing. Run the basis filter again instead of editing its output.");
  }
  if (array->GetNumberOfComponents() != components ||
      (tuples >= 0 && array->GetNumberOfTuples() != tuples))
  {
    throw InvalidInput("Array '" + std::string(name) + "' has " +
                       std::to_string(array->GetNumberOfTuples()) + " tuples of " +
                       std::to_string(array->GetNumberOfComponents()) + " components, expected " +
                       (tuples >= 0 ? std::to_string(tuples) + " tuples of " : std::string()) +
                       std::to_string(components) + ".");
  }
  return array;
}

Id IntegerIn(vtkDataArray* array, vtkIdType tuple, int component, Id limit)
{
  const double value = array->GetComponent(tuple, component); // exact up to 2^53
  if (!(value >= 0.0 && value < static_cast<double>(limit)))
  {
    throw InvalidInput("Array '" + std::string(array->GetName()) + "' has the value " +
                       std::to_string(value) + " at " + std::to_string(tuple) +
                       ", allowed are 0 to " + std::to_string(limit - 1) + ".");
  }
  return static_cast<Id>(value);
}

bool FlagOf(vtkPolyData* data, const char* name)
{
  vtkDataArray* array = data->GetFieldData()->GetArray(name);
  return !array || array->GetNumberOfTuples() == 0 || array->GetComponent(0, 0) != 0.0;
}

Grid ReadGrid(vtkFieldData* fields)
{
  Grid grid;
  vtkDataArray* origin = RequireArray(fields, GridOriginName, 3, 1);
  grid.origin =
    Vec3(origin->GetComponent(0, 0), origin->GetComponent(0, 1), origin->GetComponent(0, 2));
  grid.spacing = RequireArray(fields, GridSpacingName, 1, 1)->GetComponent(0, 0);
  grid.depth =
    static_cast<int>(IntegerIn(RequireArray(fields, GridDepthName, 1, 1), 0, 0, MaximumDepth + 1));
  if (!(grid.spacing > 0.0) || !grid.origin.allFinite() || grid.depth < MinimumDepth)
  {
    throw InvalidInput("GridOrigin, GridSpacing or GridDepth is out of range.");
  }
  return grid;
}

std::vector<MortonKey> ReadCells(vtkFieldData* fields, const Grid& grid)
{
  vtkDataArray* array = RequireArray(fields, OctreeCellsName, 3, -1);
  std::vector<MortonKey> cells(array->GetNumberOfTuples());
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    CellIndex cell;
    for (int axis = 0; axis < 3; ++axis)
    {
      cell[axis] = static_cast<int>(IntegerIn(array, k, axis, grid.CellsPerSide()));
    }
    cells[k] = MortonEncode(cell);
    if (k > 0 && cells[k] <= cells[k - 1])
    {
      throw InvalidInput(
        "Array 'OctreeCells' is not in Morton order at " + std::to_string(k) + ".");
    }
  }
  return cells;
}

/// Returns the relative error of a coordinate, which was stored and then converted to the grid.
double RoundingOf(vtkPolyData* data)
{
  const bool isSingle = data->GetPoints()->GetDataType() == VTK_FLOAT;
  return isSingle ? std::numeric_limits<float>::epsilon()
                  : 8.0 * std::numeric_limits<double>::epsilon();
}

/// Returns the area, in cells, that rounded corners can give to a triangle without area.
double LargestRounding(
  vtkPolyData* data, const InputMesh& mesh, const ClippedMesh& clipped, Id piece)
{
  double largest = 0.0;
  for (const Id corner : mesh.triangles->triangles[clipped.pieceTriangle[piece]])
  {
    largest = std::max(largest, mesh.triangles->points[corner].cwiseAbs().maxCoeff());
  }
  return SmallestPatchArea + 4.0 * RoundingOf(data) * largest / clipped.grid.spacing;
}

/// Throws for a grid that is smaller than the mesh. If it is tiny, the tolerance of
/// RequireInsideCells has no bound.
void RequireGridAround(const Grid& grid, const TriangleMesh& mesh, double rounding)
{
  for (const auto& triangle : mesh.triangles)
  {
    for (const Id corner : triangle)
    {
      const Vec3& point = mesh.points[corner];
      const double outside = (point - grid.origin).cwiseAbs().maxCoeff() -
                             2.0 * grid.spacing * grid.CellsPerSide() -
                             rounding * point.cwiseAbs().maxCoeff();
      if (!(outside <= 0.0))
      {
        throw InvalidInput("The grid of 'GridOrigin', 'GridSpacing' and 'GridDepth' does not "
                           "reach point " +
                           std::to_string(corner) +
                           ": the mesh was moved or changed after it was clipped. Clip it again.");
      }
    }
  }
}

void RequireInsideCells(const GivenCells& given, const TriangleMesh& mesh, double rounding)
{
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const CellIndex cell = MortonDecode(given.ofTriangle[t]);
    for (const Id corner : mesh.triangles[t])
    {
      const Vec3& point = mesh.points[corner];
      const Vec3 local = given.grid.ToGrid(point) - Vec3(cell[0], cell[1], cell[2]);
      const double size = point.cwiseAbs().maxCoeff();
      const double outside = OutsideCell + rounding * size / given.grid.spacing;
      if (!(local.minCoeff() >= -outside && local.maxCoeff() <= 1.0 + outside))
      {
        throw InvalidInput(
          "Point " + std::to_string(corner) +
          " does not lie in its octree cell: the mesh was moved or changed after it was clipped. "
          "Clip it again.");
      }
    }
  }
}

/// Whether one of our points, once stored, equals theirs. Accepts points with NaN, which no
/// triangle uses.
bool IsStoredAs(const Vec3& ours, const Vec3& theirs, bool isSingle)
{
  const Vec3 stored = isSingle ? Vec3(ours.cast<float>().cast<double>()) : ours;
  return stored == theirs || theirs.hasNaN();
}

/// Whether the shortcut has the points and triangles of the data.
bool Fits(const SurfaceBasis& basis, vtkPolyData* data, const InputMesh& mesh)
{
  const TriangleMesh& ours = *basis.mesh;
  const TriangleMesh& theirs = *mesh.triangles;
  if (ours.points.size() != theirs.points.size() || ours.triangles != theirs.triangles)
  {
    return false;
  }
  const bool isSingle = data->GetPoints()->GetDataType() == VTK_FLOAT;
  for (std::size_t point = 0; point < ours.points.size(); ++point)
  {
    if (!IsStoredAs(ours.points[point], theirs.points[point], isSingle))
    {
      return false;
    }
  }
  return true;
}

bool IsMadeFrom(const SurfaceBasis& basis, const InputMesh& source)
{
  const TriangleMesh& ours = *basis.mesh;
  const TriangleMesh& theirs = *source.triangles;
  if (ours.points.size() != theirs.points.size() || ours.triangles != theirs.triangles)
  {
    return false;
  }
  const std::vector<char> used = UsedPoints(theirs); // others may be NaN, which equals nothing
  for (std::size_t point = 0; point < used.size(); ++point)
  {
    if (used[point] && ours.points[point] != theirs.points[point])
    {
      return false;
    }
  }
  return true;
}

/// Returns the number of functions. It is at most eight for each patch, so that a damaged number
/// never takes all memory.
Index NumberOfFunctionsIn(vtkFieldData* fields)
{
  constexpr Id Limit = std::numeric_limits<Index>::max();
  const Id patches = RequireArray(fields, PatchCellIdName, 1, -1)->GetNumberOfTuples();
  return static_cast<Index>(IntegerIn(RequireArray(fields, NumberOfBasisFunctionsName, 1, 1), 0, 0,
    std::min(Limit, FunctionsPerPatch * patches) + 1));
}

PatchLevel ReadFinestLevel(vtkFieldData* fields, const ClippedMesh& clipped)
{
  PatchLevel finest;
  finest.depth = clipped.grid.depth;
  vtkDataArray* patchCell = RequireArray(fields, PatchCellIdName, 1, -1);
  const Id patches = patchCell->GetNumberOfTuples();
  vtkDataArray* basisIds = RequireArray(fields, PatchBasisIdsName, FunctionsPerPatch, patches);
  finest.numberOfFunctions = NumberOfFunctionsIn(fields);
  finest.cell.resize(patches);
  finest.dof.resize(patches);
  for (Id patch = 0; patch < patches; ++patch)
  {
    finest.cell[patch] =
      clipped.cells[IntegerIn(patchCell, patch, 0, static_cast<Id>(clipped.cells.size()))];
    for (int corner = 0; corner < FunctionsPerPatch; ++corner)
    {
      finest.dof[patch][corner] =
        static_cast<Index>(IntegerIn(basisIds, patch, corner, finest.numberOfFunctions));
    }
  }
  return finest;
}

GridFunctions RestoreFunctions(ClippedMesh clipped, Array<Index> piecePatch, PatchLevel finest,
  FunctionSupport support, const Progress& progress)
{
  try
  {
    return RestoreGridFunctions(
      std::move(clipped), std::move(piecePatch), std::move(finest), support, progress);
  }
  catch (const InvalidInput& error)
  {
    throw InvalidInput("The arrays 'PatchBasisIds', 'PatchCellId' and 'PatchId' do not fit the "
                       "surface. Run the basis filter again instead of editing its output. " +
                       std::string(error.what()));
  }
}

SurfaceBasis RebuildBasis(vtkPolyData* data, const InputMesh& mesh, const Progress& progress)
{
  ClippedMesh clipped =
    ReadClippedMesh(data, mesh, WeldsCoincidentPoints(data), progress.Part(0.0, 0.6));
  PatchLevel finest = ReadFinestLevel(data->GetFieldData(), clipped);
  vtkDataArray* patchId =
    RequireArray(data->GetCellData(), PatchIdName, 1, data->GetNumberOfCells());
  const Array<Index> pieceCell = PieceCells(clipped);
  Array<Index> piecePatch;
  piecePatch.reserve(clipped.pieceTriangle.size());
  for (Id piece = 0; piece < clipped.NumberOfPieces(); ++piece)
  {
    const vtkIdType cell = mesh.sourceCell[clipped.pieceTriangle[piece]];
    piecePatch.push_back(static_cast<Index>(IntegerIn(patchId, cell, 0, finest.NumberOfPatches())));
    // A triangle without area may belong to a patch that it shares an edge with.
    if (finest.cell[piecePatch.back()] != clipped.cells[pieceCell[piece]] &&
        PieceArea(clipped, piece) > LargestRounding(data, mesh, clipped, piece))
    {
      throw InvalidInput(
        "The patch of cell " + std::to_string(cell) +
        " lies in another octree cell: 'PatchId' and 'OctreeCellId' do not fit together.");
    }
  }
  const FunctionSupport support = FlagOf(data, ConnectivityAwareName)
                                    ? FunctionSupport::ConnectivityAware
                                    : FunctionSupport::Plain;
  return MakeSurfaceBasis(mesh.triangles,
    RestoreFunctions(std::move(clipped), std::move(piecePatch), std::move(finest), support,
      progress.Part(0.6, 1.0)),
    WeldsCoincidentPoints(data));
}

std::vector<Id> ReadSourceCells(vtkPolyData* data, const InputMesh& mesh)
{
  vtkDataArray* array =
    RequireArray(data->GetCellData(), SourceCellIdName, 1, data->GetNumberOfCells());
  constexpr Id Limit = Id(1) << 53; // OnSourceMesh knows the cells of the source
  std::vector<Id> source;
  source.reserve(mesh.sourceCell.size());
  for (const Id cell : mesh.sourceCell)
  {
    source.push_back(IntegerIn(array, cell, 0, Limit));
  }
  return source;
}

} // namespace

std::vector<MortonKey> ReadOctreeCells(vtkPolyData* data)
{
  return ReadCells(data->GetFieldData(), ReadGrid(data->GetFieldData()));
}

GivenCells ReadGivenCells(vtkPolyData* data, const InputMesh& mesh)
{
  GivenCells given;
  given.grid = ReadGrid(data->GetFieldData());
  given.cells = ReadCells(data->GetFieldData(), given.grid);
  vtkDataArray* octreeCell =
    RequireArray(data->GetCellData(), OctreeCellIdName, 1, data->GetNumberOfCells());
  given.ofTriangle.reserve(mesh.sourceCell.size());
  for (const Id cell : mesh.sourceCell)
  {
    given.ofTriangle.push_back(
      given.cells[IntegerIn(octreeCell, cell, 0, static_cast<Id>(given.cells.size()))]);
  }
  RequireGridAround(given.grid, *mesh.triangles, RoundingOf(data));
  RequireInsideCells(given, *mesh.triangles, RoundingOf(data));
  return given;
}

ClippedMesh ReadClippedMesh(
  vtkPolyData* data, const InputMesh& mesh, bool weldCoincidentPoints, const Progress& progress)
{
  Validate(*mesh.triangles);
  const GivenCells given = ReadGivenCells(data, mesh);
  progress.Check(0.3);
  return ClipOfGivenCells(*mesh.triangles, given, weldCoincidentPoints, progress.Part(0.3, 1.0));
}

BasisFacts ReadBasisFacts(vtkPolyData* data)
{
  vtkFieldData* const fields = data->GetFieldData();
  return { ReadGrid(fields), NumberOfFunctionsIn(fields), FlagOf(data, ConnectivityAwareName) };
}

bool WeldsCoincidentPoints(vtkPolyData* data)
{
  return FlagOf(data, WeldCoincidentPointsName);
}

SurfaceBasis ReadBasis(vtkPolyData* data, const InputMesh& mesh, const Progress& progress)
{
  auto* holder =
    vtkSurfaceBasisHolder::Find(data->GetFieldData()->GetAbstractArray(PatchBasisIdsName));
  if (holder)
  {
    SurfaceBasis basis = holder->OnClippedMesh();
    if (Fits(basis, data, mesh))
    {
      return basis;
    }
  }
  return RebuildBasis(data, mesh, progress);
}

SurfaceBasis ReadBasisFor(vtkPolyData* data, const InputMesh& source, const Progress& progress)
{
  auto* holder =
    vtkSurfaceBasisHolder::Find(data->GetFieldData()->GetAbstractArray(PatchBasisIdsName));
  if (holder && IsMadeFrom(holder->OnSourceMesh(), source) &&
      holder->OnSourceMesh().space->clipped.NumberOfTriangles() == data->GetNumberOfPolys())
  {
    return holder->OnSourceMesh();
  }
  const InputMesh mesh = ReadInputMesh(data, false, 1, progress.Part(0.0, 0.1));
  const SurfaceBasis basis = ReadBasis(data, mesh, progress.Part(0.1, 0.9));
  return OnSourceMesh(basis, ReadSourceCells(data, mesh), source);
}

} // namespace gridfem
