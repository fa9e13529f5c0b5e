#include "Output/PathOutput.h"

#include "Output/InterpolatedArrays.h"
#include "Output/SolverOutput.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

namespace gridfem
{
namespace
{

std::vector<TrianglePlace> PlacesOf(
  const std::vector<PathSolver::Path>& paths, const TriangleMesh& mesh)
{
  std::vector<TrianglePlace> places;
  for (const PathSolver::Path& path : paths)
  {
    for (const PathPoint& point : path.path.points)
    {
      places.push_back({ mesh.triangles[point.triangle],
        { point.weights[0], point.weights[1], point.weights[2] } });
    }
  }
  return places;
}

void AddArraysAlongPaths(const std::vector<PathSolver::Path>& paths, const TriangleMesh& mesh,
  vtkPointData* input, vtkPointData* output)
{
  const std::vector<TrianglePlace> places = PlacesOf(paths, mesh);
  for (int k = 0; k < input->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* array = input->GetAbstractArray(k);
    if (BelongsToItsPlaces(array, input))
    {
      continue;
    }
    RequireLength(array, static_cast<Id>(mesh.points.size()), "points");
    output->AddArray(ValuesAtPlaces(array, places));
  }
}

struct PathArrays
{
  std::vector<double> arcLength;
  std::vector<double> weights; // three per point
  std::vector<std::array<Id, 3>> corners;
  std::vector<Id> cells;
};

PathArrays ArraysOfPaths(
  const std::vector<PathSolver::Path>& paths, const InputMesh& mesh, vtkPolyData* output)
{
  PathArrays arrays;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  for (const PathSolver::Path& path : paths)
  {
    lines->InsertNextCell(static_cast<int>(path.path.points.size()));
    double length = 0.0;
    Vec3 before = PositionOf(*mesh.triangles, path.path.points.front());
    for (const PathPoint& point : path.path.points)
    {
      const Vec3 position = PositionOf(*mesh.triangles, point);
      length += (position - before).norm();
      before = position;
      lines->InsertCellPoint(points->InsertNextPoint(position.data()));
      arrays.arcLength.push_back(length);
      arrays.cells.push_back(mesh.sourceCell[point.triangle]);
      const auto& corner = mesh.triangles->triangles[point.triangle];
      arrays.corners.push_back(corner);
      arrays.weights.insert(arrays.weights.end(), point.weights.data(), point.weights.data() + 3);
    }
  }
  output->SetPoints(points);
  output->SetLines(lines);
  return arrays;
}

} // namespace

void WritePaths(const std::vector<PathSolver::Path>& paths, const InputMesh& mesh,
  vtkPolyData* input, vtkPolyData* output)
{
  const PathArrays arrays = ArraysOfPaths(paths, mesh, output);
  vtkPointData* points = output->GetPointData();
  AddArraysAlongPaths(paths, *mesh.triangles, input->GetPointData(), points);
  const auto rows = [](const std::vector<double>& values, Id columns)
  {
    return MultiVector(Eigen::Map<const MultiVector>(
      values.data(), static_cast<Id>(values.size()) / columns, columns));
  };
  points->AddArray(MakePointArray("ArcLength", rows(arrays.arcLength, 1), VTK_DOUBLE));
  points->AddArray(MakeIdArray("CellId", arrays.cells));
  points->AddArray(MakeIdArray("CornerIds", arrays.corners));
  points->AddArray(MakePointArray("CornerWeights", rows(arrays.weights, 3), VTK_DOUBLE));
  points->SetActiveScalars("ArcLength");
  std::vector<double> lengths;
  std::vector<Id> sources;
  std::vector<Id> targets;
  vtkNew<vtkIntArray> shortest;
  shortest->SetName("Shortest");
  for (const PathSolver::Path& path : paths)
  {
    lengths.push_back(path.path.length);
    sources.push_back(path.source);
    targets.push_back(path.target);
    shortest->InsertNextValue(path.isShortest ? 1 : 0);
  }
  vtkCellData* cells = output->GetCellData();
  cells->AddArray(MakePointArray("Length", rows(lengths, 1), VTK_DOUBLE));
  cells->AddArray(MakeIdArray("SourceId", sources));
  cells->AddArray(MakeIdArray("TargetId", targets));
  cells->AddArray(shortest);
}

std::vector<Id> FirstPathThroughCells(
  const std::vector<PathSolver::Path>& paths, const InputMesh& mesh, Id cells)
{
  std::vector<Id> first(cells, -1);
  for (std::size_t path = 0; path < paths.size(); ++path)
  {
    for (const PathPoint& point : paths[path].path.points)
    {
      Id& ofCell = first[mesh.sourceCell[point.triangle]];
      ofCell = ofCell < 0 ? static_cast<Id>(path) : ofCell;
    }
  }
  return first;
}

} // namespace gridfem
