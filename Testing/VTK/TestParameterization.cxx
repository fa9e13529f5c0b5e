// Parameterization as a user of VTK sees it.
#include "FilterSupport.h"

#include "vtkParameterization.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

vtkSmartPointer<vtkParameterization> Flattened(vtkPolyData* surface)
{
  auto filter = vtkSmartPointer<vtkParameterization>::New();
  filter->SetInputData(surface);
  filter->Update();
  return filter;
}

vtkPolyData* FlatOf(vtkParameterization* filter)
{
  return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(1));
}

} // namespace

/// A rectangle stays as it is. Texture coordinates have its aspect ratio.
TEST(Parameterization, ARectangleKeepsItsShape)
{
  const auto surface = ToPolyData(FlatRectangle(8, 4, 3.0, 1.5));
  AddPointArray(surface, "x", 1, [](const Vec3& p, int) { return p[0]; });
  const auto filter = Flattened(surface);
  vtkPolyData* flat = FlatOf(filter);
  ASSERT_EQ(flat->GetNumberOfPoints(), surface->GetNumberOfPoints());
  ASSERT_EQ(flat->GetNumberOfCells(), surface->GetNumberOfCells());
  double bounds[6];
  flat->GetBounds(bounds);
  EXPECT_NEAR(bounds[1] - bounds[0], 3.0, 1e-9);
  EXPECT_NEAR(bounds[3] - bounds[2], 1.5, 1e-9);
  EXPECT_EQ(bounds[4], bounds[5]);
  EXPECT_GT(bounds[0], 3.0); // beside the surface
  vtkDataArray* texture = filter->GetOutput()->GetPointData()->GetTCoords();
  ASSERT_TRUE(texture);
  EXPECT_EQ(texture->GetNumberOfComponents(), 2);
  double range[2];
  texture->GetRange(range, 0);
  EXPECT_EQ(range[1], 1.0);
  texture->GetRange(range, 1);
  EXPECT_NEAR(range[1], 0.5, 1e-9);
  for (const double angle : Values(filter->GetOutput()->GetCellData()->GetArray("AngleDistortion")))
  {
    EXPECT_NEAR(angle, 0.0, 1e-4);
  }
  EXPECT_TRUE(flat->GetPointData()->HasArray("x"));
}

/// Points on the cut are there twice. Each knows its place on the surface.
TEST(Parameterization, AClosedSurfaceIsCut)
{
  const TriangleMesh mesh = GeodesicSphere(6);
  const auto surface = ToPolyData(mesh);
  const auto filter = Flattened(surface);
  vtkPolyData* flat = FlatOf(filter);
  EXPECT_FALSE(filter->GetOutput()->GetPointData()->GetTCoords());
  EXPECT_TRUE(flat->GetPointData()->GetTCoords());
  EXPECT_GT(flat->GetNumberOfPoints(), surface->GetNumberOfPoints());
  EXPECT_EQ(flat->GetNumberOfCells(), surface->GetNumberOfCells());
  vtkFieldData* field = filter->GetOutput()->GetFieldData();
  EXPECT_EQ(field->GetArray("EulerCharacteristic")->GetTuple1(0), 2);
  EXPECT_EQ(field->GetArray("BoundaryLoops")->GetTuple1(0), 0);
  EXPECT_EQ(field->GetArray("FlippedTriangles")->GetTuple1(0), 0);
  EXPECT_EQ(field->GetArray("Converged")->GetTuple1(0), 1);
  EXPECT_EQ(field->GetArray("Iterations")->GetTuple1(0), 0);
  EXPECT_GT(field->GetArray("MeanAngleDistortion")->GetTuple1(0), 0.0);
  EXPECT_GT(field->GetArray("MeanAreaDistortion")->GetTuple1(0), 0.0);
  for (vtkIdType k = 0; k < flat->GetNumberOfPoints(); ++k)
  {
    const auto point =
      static_cast<std::size_t>(flat->GetPointData()->GetArray("SurfacePoint")->GetTuple1(k));
    Vec3 place;
    flat->GetPointData()->GetArray("SurfacePosition")->GetTuple(k, place.data());
    EXPECT_EQ(place, mesh.points[point]);
  }
}

/// A strip with one side is opened without a cut of its own. Its points there are still twice in
/// the map, so the surface itself can have no texture.
TEST(Parameterization, PointsWithTwoPlacesHaveNoTextureCoordinates)
{
  TriangleMesh strip; // six quads, half a turn
  for (int k = 0; k < 6; ++k)
  {
    const double angle = 2.0 * 3.14159265358979323846 * k / 6.0;
    const Vec3 middle(2.0 * std::cos(angle), 2.0 * std::sin(angle), 0.0);
    const Vec3 across =
      std::cos(angle / 2.0) * middle.normalized() + std::sin(angle / 2.0) * Vec3(0.0, 0.0, 1.0);
    strip.points.push_back(middle - 0.4 * across);
    strip.points.push_back(middle + 0.4 * across);
  }
  for (Id k = 0; k < 6; ++k)
  {
    const bool isLast = k == 5;
    const Id a = isLast ? 1 : 2 * k + 2;
    const Id b = isLast ? 0 : 2 * k + 3;
    strip.triangles.push_back({ 2 * k, 2 * k + 1, b });
    strip.triangles.push_back({ 2 * k, b, a });
  }
  const auto filter = Flattened(ToPolyData(strip));
  EXPECT_FALSE(filter->GetOutput()->GetPointData()->GetTCoords());
  vtkPolyData* flat = FlatOf(filter);
  EXPECT_EQ(flat->GetNumberOfPoints(), 14);
  ASSERT_TRUE(flat->GetPointData()->GetTCoords());
}

TEST(Parameterization, PointsWithoutPolygonsHaveNoPlaceInTheTexture)
{
  TriangleMesh mesh = FlatRectangle(3, 2, 3.0, 2.0);
  mesh.points.insert(mesh.points.begin() + 5, Vec3(0.5, 0.5, 7.0));
  for (auto& corners : mesh.triangles)
  {
    for (Id& corner : corners)
    {
      corner += corner >= 5 ? 1 : 0;
    }
  }
  const auto filter = Flattened(ToPolyData(mesh));
  vtkDataArray* texture = filter->GetOutput()->GetPointData()->GetTCoords();
  ASSERT_TRUE(texture);
  EXPECT_EQ(texture->GetDataType(), VTK_FLOAT);
  for (vtkIdType k = 0; k < texture->GetNumberOfTuples(); ++k)
  {
    EXPECT_EQ(std::isnan(texture->GetComponent(k, 0)), k == 5) << k;
    EXPECT_EQ(std::isnan(texture->GetComponent(k, 1)), k == 5) << k;
  }
}

/// A face that another one covers has an area, but no place in the map.
TEST(Parameterization, FacesWithoutAPlaceHaveNoDistortion)
{
  TriangleMesh mesh = FlatRectangle(4, 3, 3.0, 2.0);
  const auto first = static_cast<Id>(mesh.points.size());
  for (const Id corner : mesh.triangles[7])
  {
    mesh.points.push_back(mesh.points[corner]);
  }
  mesh.triangles.push_back({ first, first + 1, first + 2 });
  const auto filter = Flattened(ToPolyData(mesh));
  vtkCellData* cells = filter->GetOutput()->GetCellData();
  vtkIdType without = 0;
  for (vtkIdType cell = 0; cell < filter->GetOutput()->GetNumberOfCells(); ++cell)
  {
    const bool hasNone = cells->GetArray("ChartId")->GetComponent(cell, 0) < 0;
    without += hasNone ? 1 : 0;
    for (const char* name : { "AngleDistortion", "AreaDistortion" })
    {
      EXPECT_EQ(std::isnan(cells->GetArray(name)->GetComponent(cell, 0)), hasNone) << name << cell;
    }
  }
  EXPECT_EQ(without, 1);
}
