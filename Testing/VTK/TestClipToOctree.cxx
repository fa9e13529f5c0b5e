// Tests Clip To Octree: ports, arrays, precision, polygons of every kind.

#include "FilterSupport.h"

#include "Grid/TriangleMesh.h"
#include "Integrals/QuadratureRule.h"

#include "vtkClipToOctree.h"

#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkStringArray.h"
#include "vtkTriangle.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <numeric>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

vtkPolyData* Clipped(vtkClipToOctree* filter)
{
  filter->Update();
  return filter->GetOutput();
}

double Area(vtkPolyData* data, vtkIdType cell)
{
  vtkNew<vtkIdList> ids;
  data->GetCellPoints(cell, ids);
  double p[3][3];
  for (int k = 0; k < 3; ++k)
  {
    data->GetPoint(ids->GetId(k), p[k]);
  }
  return vtkTriangle::TriangleArea(p[0], p[1], p[2]);
}

/// Returns the area of the clipped triangles by source cell.
std::vector<double> AreaBySource(vtkPolyData* clipped, vtkIdType cells)
{
  std::vector<double> area(cells, 0.0);
  const auto source = Values(clipped->GetCellData()->GetArray("SourceCellId"));
  for (vtkIdType cell = 0; cell < clipped->GetNumberOfCells(); ++cell)
  {
    area[std::size_t(source[cell])] += Area(clipped, cell);
  }
  return area;
}

/// Makes an L-shaped hexagon of area 3 in the plane z = 0.
vtkSmartPointer<vtkPolyData> ConcavePolygon(double scale, double shift)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const double corners[6][2] = { { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } };
  vtkNew<vtkCellArray> polys;
  polys->InsertNextCell(6);
  for (int k = 0; k < 6; ++k)
  {
    polys->InsertCellPoint(
      points->InsertNextPoint(scale * corners[k][0] + shift, scale * corners[k][1] + shift, 0.0));
  }
  data->SetPoints(points);
  data->SetPolys(polys);
  return data;
}

/// Makes a regular polygon whose every second corner is drawn in by a part of the radius.
vtkSmartPointer<vtkPolyData> Star(int size, double depth)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> polys;
  polys->InsertNextCell(size);
  for (int k = 0; k < size; ++k)
  {
    const double angle = 2.0 * M_PI * k / size;
    const double radius = 1.0 - depth * (k % 2);
    polys->InsertCellPoint(
      points->InsertNextPoint(radius * std::cos(angle), radius * std::sin(angle), 0.0));
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(polys);
  return data;
}

/// Large polygons must be fast, because an abort cannot stop the triangulation of a polygon.
TEST(ClipToOctree, PolygonsWithManyCornersAreCutInSecondsOrRefused)
{
  vtkNew<vtkClipToOctree> filter;
  filter->SetDepth(3);
  for (const auto& [size, depth] : { std::pair(100000, 0.0), std::pair(4000, 0.2) })
  {
    const double area =
      0.5 * size * (1.0 - depth) * std::sin(2.0 * M_PI / size); // of triangles to the center
    filter->SetInputData(Star(size, depth));
    EXPECT_NEAR(AreaBySource(Clipped(filter), 1)[0], area, 1e-9);
  }
  filter->SetInputData(Star(100000, 0.2));
  ExpectRefused(filter, "Split it into smaller polygons");
}

TEST(ClipToOctree, InputPointsComeFirstAndAreasAddUp)
{
  const TriangleMesh mesh = GeodesicSphere(6);
  auto input = ToPolyData(mesh);
  vtkNew<vtkClipToOctree> filter;
  filter->SetDepth(4);
  filter->SetInputData(input);
  vtkPolyData* output = Clipped(filter);
  ASSERT_GT(output->GetNumberOfPoints(), input->GetNumberOfPoints());
  for (vtkIdType point = 0; point < input->GetNumberOfPoints(); ++point)
  {
    EXPECT_EQ(Vec3(output->GetPoint(point)), Vec3(input->GetPoint(point)));
  }
  const auto area = AreaBySource(output, input->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    EXPECT_NEAR(area[cell], Area(input, cell), 1e-12);
  }
}

TEST(ClipToOctree, AnAutomaticDepthClipsAsTheSameDepthDoes)
{
  auto input = ToPolyData(Torus(40, 20, 1.0, 0.4));
  vtkNew<vtkClipToOctree> automatic;
  automatic->SetDepth(0);
  automatic->SetInputData(input);
  vtkPolyData* output = Clipped(automatic);
  const double depth = FieldValue(output, "GridDepth");
  ASSERT_GE(depth, 2);
  vtkNew<vtkClipToOctree> given;
  given->SetDepth(static_cast<int>(depth));
  given->SetInputData(input);
  EXPECT_EQ(output->GetNumberOfCells(), Clipped(given)->GetNumberOfCells());
  EXPECT_EQ(
    Values(output->GetPoints()->GetData()), Values(given->GetOutput()->GetPoints()->GetData()));
}

TEST(ClipToOctree, EveryTriangleLiesInItsCell)
{
  vtkNew<vtkClipToOctree> filter;
  filter->SetDepth(4);
  filter->SetInputData(ToPolyData(Torus(20, 10, 1.0, 0.4)));
  vtkPolyData* output = Clipped(filter);
  const Vec3 origin(output->GetFieldData()->GetArray("GridOrigin")->GetTuple(0));
  const double spacing = FieldValue(output, "GridSpacing");
  EXPECT_EQ(FieldValue(output, "GridDepth"), 4);
  vtkDataArray* cells = output->GetFieldData()->GetArray("OctreeCells");
  vtkDataArray* cellId = output->GetCellData()->GetArray("OctreeCellId");
  ASSERT_TRUE(vtkIntArray::SafeDownCast(cells));
  EXPECT_EQ(cellId->GetDataType(), VTK_ID_TYPE);
  vtkNew<vtkIdList> ids;
  for (vtkIdType triangle = 0; triangle < output->GetNumberOfCells(); ++triangle)
  {
    const Vec3 low(cells->GetTuple(vtkIdType(cellId->GetComponent(triangle, 0))));
    output->GetCellPoints(triangle, ids);
    for (const vtkIdType point : *ids)
    {
      const Vec3 local = (Vec3(output->GetPoint(point)) - origin) / spacing - low;
      EXPECT_GE(local.minCoeff(), -1e-9);
      EXPECT_LE(local.maxCoeff<Eigen::PropagateNaN>(), 1 + 1e-9);
    }
  }
}

TEST(ClipToOctree, QuadraturePointsCarryTheArea)
{
  for (const int degree : { 2, 4, 6, 10, 12 })
  {
    vtkNew<vtkClipToOctree> filter;
    filter->SetDepth(3);
    filter->GenerateQuadraturePointsOn();
    filter->SetQuadratureDegree(degree);
    filter->SetInputData(ToPolyData(GeodesicSphere(4)));
    const vtkIdType triangles = Clipped(filter)->GetNumberOfCells();
    vtkPolyData* samples = filter->GetOutput(1);
    const vtkIdType expected = triangles * vtkIdType(TriangleRule(degree).points.size());
    EXPECT_EQ(samples->GetNumberOfPoints(), expected);
    EXPECT_EQ(samples->GetNumberOfVerts(), expected);
    const auto weight = PointValues(samples, "Weight");
    EXPECT_NEAR(
      std::accumulate(weight.begin(), weight.end(), 0.0), SurfaceArea(GeodesicSphere(4)), 1e-11);
    EXPECT_EQ(samples->GetPointData()->GetArray("SourceCellId")->GetNumberOfTuples(), expected);
  }
}

TEST(ClipToOctree, QuadraturePointsAreMadeUpToAMillionOrAsAsked)
{
  vtkNew<vtkClipToOctree> filter;
  filter->SetDepth(7);
  filter->SetInputData(ToPolyData(GeodesicSphere(16)));
  const auto points = [&]
  {
    filter->Update();
    return filter->GetOutput(1)->GetNumberOfPoints();
  };
  const vtkIdType some = points();
  EXPECT_EQ(some, 3 * filter->GetOutput()->GetNumberOfCells());
  filter->SetQuadratureDegree(6);
  EXPECT_EQ(points(), 0) << "four times as many are more than a million";
  filter->GenerateQuadraturePointsOn();
  EXPECT_EQ(points(), 4 * some);
  filter->GenerateQuadraturePointsOff();
  EXPECT_EQ(points(), 0);
  EXPECT_EQ(filter->GetNumberOfRuns("Space"), 1);
}

TEST(ClipToOctree, CellsThatTouchHaveDifferentColors)
{
  vtkNew<vtkClipToOctree> filter;
  filter->SetDepth(4);
  filter->SetInputData(ToPolyData(GeodesicSphere(8)));
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  EXPECT_STREQ(output->GetCellData()->GetScalars()->GetName(), "OctreeCellColor");
  vtkDataArray* cells = output->GetFieldData()->GetArray("OctreeCells");
  std::map<std::array<int, 3>, double> colors;
  for (vtkIdType t = 0; t < output->GetNumberOfCells(); ++t)
  {
    const double* cell = cells->GetTuple3(
      static_cast<vtkIdType>(output->GetCellData()->GetArray("OctreeCellId")->GetTuple1(t)));
    const std::array<int, 3> key{ int(cell[0]), int(cell[1]), int(cell[2]) };
    const double color = output->GetCellData()->GetScalars()->GetTuple1(t);
    EXPECT_EQ(colors.emplace(key, color).first->second, color);
  }
  for (const auto& [a, colorA] : colors)
  {
    for (const auto& [b, colorB] : colors)
    {
      const int apart =
        std::max({ std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2]) });
      EXPECT_TRUE(apart != 1 || colorA != colorB);
    }
  }
}

TEST(ClipToOctree, ThreadsDoNotChangeABit)
{
  auto input = ToPolyData(GeodesicSphere(60)); // more points and pieces than one thread's block
  AddPointArray(input, "f", 2, Wave);
  const auto run = [&](int threads)
  {
    vtkNew<vtkClipToOctree> filter;
    filter->SetDepth(5);
    filter->SetNumberOfThreads(threads);
    filter->GenerateQuadraturePointsOn();
    filter->SetLevel(-1);
    filter->SetInputData(input);
    filter->Update();
    auto* mesh = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
    auto* samples = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(1));
    auto* octree = vtkPointSet::SafeDownCast(filter->GetOutputDataObject(2));
    return std::vector<std::vector<double>>{ Values(mesh->GetPoints()->GetData()),
      Values(mesh->GetPolys()->GetConnectivityArray()), PointValues(mesh, "f"),
      Values(mesh->GetCellData()->GetArray("SourceCellId")),
      Values(mesh->GetCellData()->GetArray("OctreeCellId")),
      Values(samples->GetPoints()->GetData()), PointValues(samples, "Weight"),
      Values(octree->GetPoints()->GetData()) };
  };
  EXPECT_EQ(run(3), run(1));
}

TEST(ClipToOctree, OctreeShowsOneLevelOrAll)
{
  vtkNew<vtkClipToOctree> filter;
  filter->SetDepth(4);
  filter->SetInputData(ToPolyData(GeodesicSphere(4)));
  const auto cellsOf = [&](int level)
  {
    filter->SetLevel(level);
    filter->Update();
    auto* octree = vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(2));
    for (vtkIdType cell = 0; level >= 0 && cell < octree->GetNumberOfCells(); ++cell)
    {
      EXPECT_EQ(octree->GetCellType(cell), VTK_VOXEL);
      EXPECT_EQ(
        octree->GetCellData()->GetArray("Level")->GetComponent(cell, 0), std::min(level, 4));
    }
    return octree->GetNumberOfCells();
  };
  EXPECT_EQ(cellsOf(0), 1);
  EXPECT_EQ(cellsOf(1), 8);
  const vtkIdType finest =
    filter->GetOutput()->GetFieldData()->GetArray("OctreeCells")->GetNumberOfTuples();
  EXPECT_EQ(cellsOf(4), finest);
  EXPECT_EQ(cellsOf(14), finest);
  EXPECT_EQ(cellsOf(-1), finest + cellsOf(3) + cellsOf(2) + 8 + 1);
  EXPECT_EQ(filter->GetNumberOfRuns("Space"), 1);
}

TEST(ClipToOctree, ConcavePolygonsOfAnyScaleAreDecomposed)
{
  for (const double scale : { 1.0, 1e-9, 1e9 })
  {
    vtkNew<vtkClipToOctree> filter;
    filter->SetDepth(3);
    filter->SetInputData(ConcavePolygon(scale, 0.0));
    const auto area = AreaBySource(Clipped(filter), 1);
    EXPECT_NEAR(area[0] / (scale * scale), 3.0, 1e-9);
  }
}

TEST(ClipToOctree, SourceCellIdsCountVerticesLinesAndStrips)
{
  auto input = ConcavePolygon(1.0, 0.0);
  vtkNew<vtkCellArray> verts;
  verts->InsertNextCell({ 0 });
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1 });
  vtkNew<vtkCellArray> strips;
  const vtkIdType a = input->GetPoints()->InsertNextPoint(0, 0, 1);
  input->GetPoints()->InsertNextPoint(1, 0, 1);
  input->GetPoints()->InsertNextPoint(0, 1, 1);
  input->GetPoints()->InsertNextPoint(1, 1, 1);
  strips->InsertNextCell({ a, a + 1, a + 2, a + 3 });
  const vtkIdType concave[4] = { 0, 2, 3, 4 }; // an arrow with its reflex corner at (1,1)
  input->GetPolys()->InsertNextCell(4, concave);
  input->SetVerts(verts);
  input->SetLines(lines);
  input->SetStrips(strips);
  vtkNew<vtkIntArray> label;
  label->SetName("label");
  for (int k = 0; k < 5; ++k)
  {
    label->InsertNextValue(10 * k);
  }
  input->GetCellData()->AddArray(label);

  vtkNew<vtkClipToOctree> filter;
  filter->SetDepth(3);
  filter->SetInputData(input);
  vtkPolyData* output = Clipped(filter);
  const auto area = AreaBySource(output, 5);
  EXPECT_EQ(area[0], 0.0);
  EXPECT_EQ(area[1], 0.0);
  EXPECT_NEAR(area[2], 3.0, 1e-12);
  EXPECT_NEAR(area[3], 1.0, 1e-12);
  EXPECT_NEAR(area[4], 1.0, 1e-12);
  auto* copied = vtkIntArray::SafeDownCast(output->GetCellData()->GetArray("label"));
  ASSERT_TRUE(copied);
  const auto source = Values(output->GetCellData()->GetArray("SourceCellId"));
  for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
  {
    EXPECT_EQ(copied->GetValue(cell), 10 * source[cell]);
  }
}

TEST(ClipToOctree, PointArraysAreInterpolatedLinearly)
{
  auto input = ToPolyData(GeodesicSphere(5));
  AddPointArray(input, "linear", 2, [](const Vec3& p, int c) { return c + 2 * p[0] - p[2]; });
  vtkNew<vtkIntArray> integer;
  integer->SetName("integer");
  vtkNew<vtkStringArray> text;
  text->SetName("text");
  for (vtkIdType k = 0; k < input->GetNumberOfPoints(); ++k)
  {
    integer->InsertNextValue(int(k));
    text->InsertNextValue(std::to_string(k));
  }
  input->GetPointData()->AddArray(integer);
  input->GetPointData()->AddArray(text);
  vtkNew<vtkIntArray> field;
  field->SetName("field");
  field->InsertNextValue(3);
  input->GetFieldData()->AddArray(field);

  vtkNew<vtkClipToOctree> filter;
  filter->SetDepth(4);
  filter->SetInputData(input);
  vtkPolyData* output = Clipped(filter);
  vtkDataArray* linear = output->GetPointData()->GetArray("linear");
  for (vtkIdType k = 0; k < output->GetNumberOfPoints(); ++k)
  {
    const Vec3 p(output->GetPoint(k)); // a linear function of space is linear on every triangle
    EXPECT_NEAR(linear->GetComponent(k, 1), 1 + 2 * p[0] - p[2], 1e-12);
  }
  EXPECT_EQ(output->GetPointData()->GetAbstractArray("text")->GetNumberOfTuples(),
    output->GetNumberOfPoints());
  EXPECT_EQ(FieldValue(output, "field"), 3);
}

/// Whether a value equals the value at a corner of the source triangle.
bool IsOfACorner(vtkPolyData* input, vtkIdType cell, vtkDataArray* array, double value)
{
  vtkNew<vtkIdList> corners;
  input->GetCellPoints(cell, corners);
  return std::any_of(corners->begin(), corners->end(),
    [&](vtkIdType corner) { return array->GetComponent(corner, 0) == value; });
}

TEST(ClipToOctree, WhatCannotBeAveragedIsNot)
{
  auto input = ToPolyData(GeodesicSphere(5));
  vtkNew<vtkIntArray> label;
  label->SetName("label");
  vtkNew<vtkUnsignedCharArray> color;
  color->SetName("color");
  color->SetNumberOfComponents(3);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("ids");
  vtkNew<vtkIntArray> pedigree;
  pedigree->SetName("pedigree");
  for (vtkIdType k = 0; k < input->GetNumberOfPoints(); ++k)
  {
    label->InsertNextValue(int(1000 * k));
    const double red = std::round(100.0 + 50.0 * input->GetPoint(k)[0]);
    color->InsertNextTuple3(red, 255, 0);
    ghosts->InsertNextValue(k % 3 ? 0 : vtkDataSetAttributes::DUPLICATEPOINT);
    ids->InsertNextValue(k);
    pedigree->InsertNextValue(int(k));
  }
  input->GetPointData()->AddArray(label);
  input->GetPointData()->SetScalars(color);
  input->GetPointData()->AddArray(ghosts);
  input->GetPointData()->SetGlobalIds(ids);
  input->GetPointData()->SetPedigreeIds(pedigree);

  vtkNew<vtkClipToOctree> filter;
  filter->SetDepth(4);
  filter->SetInputData(input);
  vtkPolyData* output = Clipped(filter);
  vtkPointData* arrays = output->GetPointData();
  EXPECT_FALSE(arrays->HasArray("ids") || arrays->GetGlobalIds());
  EXPECT_FALSE(arrays->HasArray("pedigree") || arrays->GetPedigreeIds());
  auto* colors = vtkUnsignedCharArray::SafeDownCast(arrays->GetArray("color"));
  auto* labels = vtkIntArray::SafeDownCast(arrays->GetArray("label"));
  auto* flags =
    vtkUnsignedCharArray::SafeDownCast(arrays->GetArray(vtkDataSetAttributes::GhostArrayName()));
  ASSERT_TRUE(colors && labels && flags);
  EXPECT_EQ(arrays->GetScalars(), nullptr); // so that ParaView colors the cells
  for (vtkIdType k = 0; k < output->GetNumberOfPoints(); ++k)
  {
    // The colors of the corners were rounded, and so is their mean: half a step each.
    EXPECT_NEAR(colors->GetTypedComponent(k, 0), 100.0 + 50.0 * output->GetPoint(k)[0], 1.001);
    EXPECT_EQ(colors->GetTypedComponent(k, 1), 255);
  }
  const auto source = Values(output->GetCellData()->GetArray("SourceCellId"));
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
  {
    output->GetCellPoints(cell, points);
    for (const vtkIdType point : *points)
    {
      // A cut point on an edge takes the corner from either of its triangles: both have the edge.
      EXPECT_TRUE(IsOfACorner(input, vtkIdType(source[cell]), label, labels->GetValue(point)));
      EXPECT_TRUE(IsOfACorner(input, vtkIdType(source[cell]), ghosts, flags->GetValue(point)));
    }
  }
}

TEST(ClipToOctree, AnArrayOfWrongLengthIsRefusedByName)
{
  auto input = ToPolyData(GeodesicSphere(3));
  vtkNew<vtkFloatArray> shortArray;
  shortArray->SetName("short");
  shortArray->InsertNextValue(1.0f);
  input->GetPointData()->AddArray(shortArray);
  vtkNew<vtkClipToOctree> filter;
  filter->SetInputData(input);
  ExpectRefused(filter, "'short'");
}

TEST(ClipToOctree, OutputHasThePrecisionOfTheInput)
{
  for (const int precision : { VTK_FLOAT, VTK_DOUBLE, VTK_INT })
  {
    vtkNew<vtkClipToOctree> filter;
    filter->SetDepth(3);
    filter->GenerateQuadraturePointsOn();
    filter->SetInputData(ToPolyData(GeodesicSphere(4, 100.0), precision));
    const int expected = precision == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE;
    EXPECT_EQ(Clipped(filter)->GetPoints()->GetDataType(), expected);
    EXPECT_EQ(filter->GetOutput(1)->GetPoints()->GetDataType(), expected);
  }
}

TEST(ClipToOctree, WeldingJoinsCutPointsOfCoincidentEdges)
{
  auto input = ToPolyData(Unweld(GeodesicSphere(4)));
  vtkNew<vtkClipToOctree> filter;
  filter->SetDepth(3);
  filter->SetInputData(input);
  const vtkIdType welded = Clipped(filter)->GetNumberOfPoints();
  filter->WeldCoincidentPointsOff();
  EXPECT_GT(Clipped(filter)->GetNumberOfPoints(), welded);
  EXPECT_EQ(FieldValue(filter->GetOutput(), "WeldCoincidentPoints"), 0);
}

TEST(ClipToOctree, ClippingRunsAgainOnlyForANewMeshOrDepth)
{
  auto input = ToPolyData(GeodesicSphere(4));
  vtkNew<vtkClipToOctree> filter;
  filter->SetDepth(3);
  filter->SetInputData(input);
  filter->Update();
  vtkPoints* points = filter->GetOutput()->GetPoints();
  AddPointArray(input, "new", 1, [](const Vec3&, int) { return 1.0; });
  input->Modified();
  filter->Update();
  EXPECT_TRUE(filter->GetOutput()->GetPointData()->HasArray("new"));
  EXPECT_EQ(filter->GetNumberOfRuns("Space"), 1);
  EXPECT_EQ(filter->GetOutput()->GetPoints(), points); // later filters see an unchanged mesh
  filter->SetDepth(4);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Space"), 2);
  EXPECT_GE(filter->GetStageSeconds("Space"), 0.0);
  input->GetPoints()->SetPoint(0, 3, 3, 3);
  input->GetPoints()->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Space"), 3);
}

} // namespace
