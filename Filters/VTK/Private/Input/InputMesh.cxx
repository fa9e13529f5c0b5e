#include "Input/InputMesh.h"

#include "Input/CellCorners.h"
#include "Input/InputValidation.h"
#include "Input/PointCoordinates.h"
#include "Pieces/PieceArrays.h"

#include "Base/Parallel.h"
#include "Grid/CopiedTriangles.h"
#include "Grid/Field.h"
#include "Grid/PolygonTriangles.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace gridfem
{
namespace
{

constexpr vtkIdType CellsPerReport = 1 << 16;

/// Collects the triangles of one vtkPolyData.
class TriangleCollector
{
public:
  TriangleCollector(const std::vector<Vec3>& points, InputMesh& mesh, TriangleMesh& triangles)
    : points_(points), mesh_(mesh), triangles_(triangles)
  {
  }

  void AddPolygon(Id cell, vtkIdType size, const vtkIdType* ids)
  {
    this->CheckIds(cell, size, ids);
    if (size == 3)
    {
      this->Add(cell, ids[0], ids[1], ids[2]);
    }
    else if (size > 3)
    {
      for (const Triangle& triangle : TrianglesOfPolygon(points_, cell, { ids, ids + size }))
      {
        this->Add(cell, triangle[0], triangle[1], triangle[2]);
      }
    }
  }

  void AddStrip(Id cell, vtkIdType size, const vtkIdType* ids)
  {
    this->CheckIds(cell, size, ids);
    for (vtkIdType k = 0; k + 2 < size; ++k)
    {
      const vtkIdType flip = k & 1; // every second triangle of a strip is turned over
      this->Add(cell, ids[k], ids[k + 1 + flip], ids[k + 2 - flip]);
    }
  }

private:
  void Add(Id cell, Id a, Id b, Id c)
  {
    triangles_.triangles.push_back({ a, b, c });
    mesh_.sourceCell.push_back(cell);
  }

  void CheckIds(Id cell, vtkIdType size, const vtkIdType* ids) const
  {
    RequireCorners(cell, size, ids, static_cast<vtkIdType>(points_.size()), "mesh");
  }

  const std::vector<Vec3>& points_;
  InputMesh& mesh_;
  TriangleMesh& triangles_;
};

std::vector<Vec3> ReadPoints(vtkPolyData* input, int threads)
{
  std::vector<Vec3> points(input->GetNumberOfPoints());
  const auto copy = [&](const auto* coordinates)
  {
    ParallelRanges(input->GetNumberOfPoints(), threads,
      [&](Id begin, Id end)
      { std::copy(coordinates + 3 * begin, coordinates + 3 * end, points[begin].data()); });
  };
  if (!points.empty() && !VisitCoordinates(input->GetPoints(), copy))
  {
    for (vtkIdType k = 0; k < input->GetNumberOfPoints(); ++k)
    {
      input->GetPoint(k, points[k].data());
    }
  }
  return points;
}

/// Copies three corners for every triangle. Returns false if one names a point that does not exist.
template<class Corner>
bool CopyTriangles(const Corner* corners, Id numberOfPoints, int threads, TriangleMesh& mesh)
{
  const Id wrong = ParallelSum(static_cast<Id>(mesh.triangles.size()), threads, Id{ 0 },
    [&](Id begin, Id end)
    {
      Id count = 0;
      for (Id t = begin; t < end; ++t)
      {
        for (int k = 0; k < 3; ++k)
        {
          const Id point = corners[3 * t + k];
          mesh.triangles[t][k] = point;
          count += point < 0 || point >= numberOfPoints ? 1 : 0;
        }
      }
      return count;
    });
  return wrong == 0;
}

/// Copies the triangles of a cell array. It also returns false if its corners are no plain array of
/// either size, which VTK allows from 9.6 on.
bool CopyTriangles(vtkCellArray* polys, Id numberOfPoints, int threads, TriangleMesh& mesh)
{
  vtkDataArray* const corners = polys->GetConnectivityArray();
  if (auto* ids = vtkArrayDownCast<vtkAOSDataArrayTemplate<vtkTypeInt64>>(corners))
  {
    return CopyTriangles(ids->GetPointer(0), numberOfPoints, threads, mesh);
  }
  auto* ids = vtkArrayDownCast<vtkAOSDataArrayTemplate<vtkTypeInt32>>(corners);
  return ids && CopyTriangles(ids->GetPointer(0), numberOfPoints, threads, mesh);
}

/// Takes the short way if all polygons are triangles. Returns false, and reads nothing, if they are
/// not or if one of them is invalid.
bool ReadTriangles(
  vtkCellArray* polys, Id firstCell, int threads, InputMesh& mesh, TriangleMesh& triangles)
{
  if (!polys || polys->IsHomogeneous() != 3)
  {
    return false;
  }
  const Id numberOfPoints = static_cast<Id>(triangles.points.size());
  triangles.triangles.resize(polys->GetNumberOfCells());
  if (!CopyTriangles(polys, numberOfPoints, threads, triangles))
  {
    triangles.triangles.clear();
    return false;
  }
  mesh.sourceCell.resize(polys->GetNumberOfCells());
  std::iota(mesh.sourceCell.begin(), mesh.sourceCell.end(), firstCell);
  return true;
}

template<class Add>
void ForEachCell(vtkCellArray* cells, Id firstCell, const Progress& progress, Add&& add)
{
  if (!cells)
  {
    return;
  }
  const vtkIdType count = cells->GetNumberOfCells();
  vtkNew<vtkIdList> storage;
  for (vtkIdType k = 0; k < count; ++k)
  {
    if (k % CellsPerReport == 0)
    {
      progress.Check(double(k) / double(count));
    }
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    GetCorners(cells, k, size, ids, storage);
    add(firstCell + k, size, ids);
  }
}

/// Keeps the triangles of cells for which isKept(mark) is true. `ghosts` holds the marks of the
/// cells; null if there are none.
template<class IsKept>
void KeepCells(
  vtkUnsignedCharArray* ghosts, InputMesh& mesh, TriangleMesh& triangles, IsKept&& isKept)
{
  KeepTriangles(triangles, mesh.sourceCell,
    [&](std::size_t t) { return isKept(ghosts ? ghosts->GetValue(mesh.sourceCell[t]) : 0); });
}

bool IsShown(int mark)
{
  return (mark & (vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::DUPLICATECELL)) == 0;
}

/// Joins the seams of the triangles.
void Join(InputMesh& mesh, TriangleMesh& triangles, int threads)
{
  JoinedSeams joined = JoinSeams(triangles, threads);
  mesh.isWelded = true;
  mesh.moved = std::move(joined.moved);
  if (!joined.sourceTriangle.empty())
  {
    std::vector<Id> sourceCell;
    sourceCell.reserve(joined.sourceTriangle.size());
    for (const Id triangle : joined.sourceTriangle)
    {
      sourceCell.push_back(mesh.sourceCell[triangle]);
    }
    mesh.sourceCell = std::move(sourceCell);
  }
}

/// Reads the triangles of all cells, including ghosts, into `triangles`.
InputMesh ReadCells(
  vtkPolyData* input, int threads, const Progress& progress, TriangleMesh& triangles)
{
  InputMesh mesh;
  triangles.points = ReadPoints(input, threads);
  TriangleCollector collector(triangles.points, mesh, triangles);
  const Id firstPolygon = input->GetNumberOfVerts() + input->GetNumberOfLines();
  if (!ReadTriangles(input->GetPolys(), firstPolygon, threads, mesh, triangles))
  {
    triangles.triangles.reserve(input->GetNumberOfPolys());
    mesh.sourceCell.reserve(input->GetNumberOfPolys());
    ForEachCell(input->GetPolys(), firstPolygon, progress,
      [&](Id cell, vtkIdType size, const vtkIdType* ids)
      { collector.AddPolygon(cell, size, ids); });
  }
  ForEachCell(input->GetStrips(), firstPolygon + input->GetNumberOfPolys(), progress,
    [&](Id cell, vtkIdType size, const vtkIdType* ids) { collector.AddStrip(cell, size, ids); });
  return mesh;
}

} // namespace

InputMesh ReadInputMesh(
  vtkPolyData* input, bool weldCoincidentPoints, int threads, const Progress& progress)
{
  auto triangles = std::make_shared<TriangleMesh>();
  InputMesh mesh = ReadCells(input, threads, progress, *triangles);
  if (triangles->triangles.empty())
  {
    throw InvalidInput(
      "The input has no polygons and no triangle strips, but the filter needs a surface. "
      "Extract Surface makes one from a volume mesh, Delaunay 2D from the points of a "
      "height field.");
  }
  KeepCells(GhostsOf(input->GetCellData(), input->GetNumberOfCells()), mesh, *triangles, IsShown);
  if (triangles->triangles.empty())
  {
    throw InvalidInput("All polygons lie outside the Domain Array, or are hidden or duplicates "
                       "according to the array vtkGhostType.");
  }
  mesh.copied = DropCopies(*triangles, mesh.sourceCell, threads);
  if (weldCoincidentPoints)
  {
    Join(mesh, *triangles, threads);
  }
  mesh.triangles = std::move(triangles);
  return mesh;
}

std::vector<Vec3> ReadPointsLike(const InputMesh& mesh, vtkPolyData* data)
{
  std::vector<Vec3> points = ReadPoints(data, 1);
  for (const MovedPoint& moved : mesh.moved)
  {
    points[moved.point] = points[moved.twin];
  }
  return points;
}

InputMesh ReadPiece(vtkPolyData* piece, int threads, InputMesh& copies)
{
  auto triangles = std::make_shared<TriangleMesh>();
  InputMesh mesh = piece ? ReadCells(piece, threads, {}, *triangles) : InputMesh();
  vtkUnsignedCharArray* const ghosts =
    piece ? GhostsOf(piece->GetCellData(), piece->GetNumberOfCells()) : nullptr;
  auto triangleCopies = std::make_shared<TriangleMesh>();
  copies = {};
  if (ghosts)
  {
    *triangleCopies = *triangles;
    copies.sourceCell = mesh.sourceCell;
    KeepCells(ghosts, copies, *triangleCopies,
      [](int mark) { return (mark & vtkDataSetAttributes::DUPLICATECELL) != 0; });
    KeepCells(ghosts, mesh, *triangles, IsShown);
  }
  mesh.copied = DropCopies(*triangles, mesh.sourceCell, threads);
  copies.triangles = std::move(triangleCopies);
  mesh.triangles = std::move(triangles);
  return mesh;
}

std::pair<Id, Id> TrianglesOfCell(const InputMesh& mesh, Id cell)
{
  const auto begin = mesh.sourceCell.begin();
  const auto range = std::equal_range(begin, mesh.sourceCell.end(), cell);
  return { range.first - begin, range.second - begin };
}

MultiVector MeansOnCells(const InputMesh& mesh, const MultiVector& onTriangles, Id cells)
{
  return MeansOnCells(*mesh.triangles, mesh.sourceCell, onTriangles, cells);
}

} // namespace gridfem
