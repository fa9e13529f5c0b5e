#include "Output/FlatMapOutput.h"

#include "Output/InterpolatedArrays.h"
#include "Output/SolverOutput.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <limits>

namespace gridfem
{
namespace
{

using Flat = ParameterizationSolver::Flat;

constexpr double NoResult = std::numeric_limits<double>::quiet_NaN();
constexpr const char* TextureName = "TCoords"; // of float: the PLY writer takes no other type

/// Copies all arrays but ghost flags and ids, which belong to the input.
void CopyArrays(vtkDataSetAttributes* input, vtkIdType count, const char* kind,
  const std::vector<Id>& places, vtkDataSetAttributes* output)
{
  vtkNew<vtkIdList> from;
  for (const Id place : places)
  {
    from->InsertNextId(place);
  }
  for (int k = 0; k < input->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* array = input->GetAbstractArray(k);
    if (BelongsToItsPlaces(array, input))
    {
      continue;
    }
    RequireLength(array, count, kind);
    output->AddArray(PickTuples(array, from));
  }
}

/// Adds what is known about each chart, and whether all of them have converged.
void AddChartNumbers(const std::vector<ParameterizationSolver::Chart>& charts, vtkPolyData* output)
{
  std::vector<Id> euler;
  std::vector<Id> loops;
  std::vector<Id> flipped;
  std::vector<double> angle;
  std::vector<double> area;
  bool hasConverged = true;
  int steps = 0;
  for (const ParameterizationSolver::Chart& chart : charts)
  {
    euler.push_back(chart.topology.euler);
    loops.push_back(chart.topology.loops);
    flipped.push_back(chart.flipped);
    angle.push_back(chart.angle);
    area.push_back(chart.area);
    hasConverged = hasConverged && chart.hasConverged;
    steps = std::max(steps, chart.steps);
  }
  vtkFieldData* field = output->GetFieldData();
  field->AddArray(MakeIdArray("EulerCharacteristic", euler));
  field->AddArray(MakeIdArray("BoundaryLoops", loops));
  field->AddArray(MakeIdArray("FlippedTriangles", flipped));
  AddFieldNumbers(output, "MeanAngleDistortion", angle);
  AddFieldNumbers(output, "MeanAreaDistortion", area);
  AddFieldInt(output, "Converged", hasConverged ? 1 : 0);
  AddFieldInt(output, "Iterations", steps);
}

} // namespace

void AddFlatMap(
  const ParameterizationSolver::Result& result, const InputMesh& mesh, vtkPolyData* output)
{
  const Flat& flat = result.flat;
  const auto triangles = static_cast<Id>(mesh.triangles->triangles.size());
  const vtkIdType cells = output->GetNumberOfCells();
  MultiVector distortion = MultiVector::Zero(triangles, 2);
  std::vector<Id> chart(static_cast<std::size_t>(cells), -1);
  for (std::size_t k = 0; k < flat.triangleOf.size(); ++k)
  {
    const Id triangle = flat.triangleOf[k];
    distortion.row(triangle) << flat.angle[k], flat.area[k];
    chart[mesh.sourceCell[triangle]] = flat.chart[k];
  }
  MultiVector means = MeansOnCells(mesh, distortion, cells);
  for (vtkIdType cell = 0; cell < cells; ++cell)
  {
    if (chart[static_cast<std::size_t>(cell)] < 0)
    {
      means.row(cell).setConstant(NoResult); // it has an area, but no place in the map
    }
  }
  vtkCellData* data = output->GetCellData();
  data->AddArray(MakePointArray("AngleDistortion", means.col(0), VTK_DOUBLE));
  data->AddArray(MakePointArray("AreaDistortion", means.col(1), VTK_DOUBLE));
  data->AddArray(MakeIdArray("ChartId", chart));
  ColorByCells(output, "AreaDistortion");
  AddChartNumbers(result.charts, output);
  if (!result.splitsPoints)
  {
    MultiVector texture = MultiVector::Constant(static_cast<Id>(flat.vertexOf.size()), 2, NoResult);
    for (Id point = 0; point < texture.rows(); ++point)
    {
      const Id vertex = flat.vertexOf[point];
      if (vertex >= 0)
      {
        texture.row(point) = flat.texture.row(vertex);
      }
    }
    output->GetPointData()->SetTCoords(MakePointArray(TextureName, texture, VTK_FLOAT));
  }
}

void WriteFlatMap(const ParameterizationSolver::Result& result, const InputMesh& mesh,
  vtkPolyData* input, vtkPolyData* output)
{
  const Flat& flat = result.flat;
  const TriangleMesh& surface = *mesh.triangles;
  const Bounds bounds = BoundsOf(surface.points, UsedPoints(surface));
  const double gap = 0.1 * (bounds.high - bounds.low).norm();
  const Vec3 middle = 0.5 * (bounds.low + bounds.high);
  const double height = flat.points.col(1).maxCoeff();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (Id k = 0; k < flat.points.rows(); ++k)
  {
    points->InsertNextPoint(bounds.high[0] + gap + flat.points(k, 0),
      middle[1] - 0.5 * height + flat.points(k, 1), middle[2]);
  }
  vtkNew<vtkCellArray> polygons;
  std::vector<Id> cells;
  std::vector<Id> charts(flat.chart.begin(), flat.chart.end());
  for (std::size_t k = 0; k < flat.triangles.size(); ++k)
  {
    const std::array<vtkIdType, 3> corners{ flat.triangles[k][0], flat.triangles[k][1],
      flat.triangles[k][2] };
    polygons->InsertNextCell(3, corners.data());
    cells.push_back(mesh.sourceCell[flat.triangleOf[k]]);
  }
  output->SetPoints(points);
  output->SetPolys(polygons);
  vtkPointData* ofPoints = output->GetPointData();
  vtkCellData* ofCells = output->GetCellData();
  CopyArrays(input->GetPointData(), input->GetNumberOfPoints(), "points", flat.pointOf, ofPoints);
  CopyArrays(input->GetCellData(), input->GetNumberOfCells(), "cells", cells, ofCells);
  MultiVector places(flat.points.rows(), 3);
  for (Id k = 0; k < places.rows(); ++k)
  {
    places.row(k) = surface.points[flat.pointOf[k]].transpose();
  }
  ofPoints->SetTCoords(MakePointArray(TextureName, flat.texture, VTK_FLOAT));
  ofPoints->AddArray(MakePointArray("SurfacePosition", places, VTK_DOUBLE));
  ofPoints->AddArray(MakeIdArray("SurfacePoint", flat.pointOf));
  ofCells->AddArray(MakePointArray("AngleDistortion", flat.angle, VTK_DOUBLE));
  ofCells->AddArray(MakePointArray("AreaDistortion", flat.area, VTK_DOUBLE));
  ofCells->AddArray(MakeIdArray("ChartId", charts));
  ofCells->SetActiveScalars("AreaDistortion");
  AddChartNumbers(result.charts, output);
}

} // namespace gridfem
