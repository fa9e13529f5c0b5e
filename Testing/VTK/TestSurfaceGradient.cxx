// Surface Gradient as a user of VTK sees it.
#include "FilterSupport.h"

#include "vtkConnectivityAwareBasis.h"
#include "vtkSurfaceGradient.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// Makes a square sheet of quadrilaterals and triangles in the plane z = 0, slightly turned.
vtkSmartPointer<vtkPolyData> MixedSheet(int n)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(VTK_DOUBLE);
  const Eigen::AngleAxisd turn(0.2, Vec3(1, 1, 0.5).normalized());
  for (int j = 0; j <= n; ++j)
  {
    for (int i = 0; i <= n; ++i)
    {
      const Vec3 p = turn * Vec3(double(i) / n, double(j) / n, 0.0);
      points->InsertNextPoint(p.data());
    }
  }
  vtkNew<vtkCellArray> polys;
  for (vtkIdType j = 0; j < n; ++j)
  {
    for (vtkIdType i = 0; i < n; ++i)
    {
      const vtkIdType a = j * (n + 1) + i;
      const vtkIdType b = a + n + 1;
      if ((i + j) % 2)
      {
        polys->InsertNextCell({ a, a + 1, b + 1, b });
      }
      else
      {
        polys->InsertNextCell({ a, a + 1, b + 1 });
        polys->InsertNextCell({ a, b + 1, b });
      }
    }
  }
  data->SetPoints(points);
  data->SetPolys(polys);
  return data;
}

} // namespace

class SurfaceGradient : public ::testing::TestWithParam<int>
{
};

TEST_P(SurfaceGradient, OfALinearArrayIsItsSlopeAtPointsAndOnCells)
{
  const auto sheet = MixedSheet(12);
  const Vec3 slope = Eigen::AngleAxisd(0.2, Vec3(1, 1, 0.5).normalized()) * Vec3(3, -2, 0);
  AddPointArray(sheet, "f", 2,
    [&](const Vec3& p, int c) { return (c == 0 ? 1.0 : -4.0) * slope.dot(p) + 7.0; });
  vtkNew<vtkSurfaceGradient> filter;
  filter->SetInputData(sheet);
  filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
  filter->SetDepth(4);
  filter->SetTolerance(1e-8);
  filter->SetFunctionSpace(this->GetParam());
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  ASSERT_EQ(output->GetNumberOfPoints(), sheet->GetNumberOfPoints());
  ASSERT_EQ(output->GetNumberOfCells(), sheet->GetNumberOfCells());
  for (vtkDataSetAttributes* data : { static_cast<vtkDataSetAttributes*>(output->GetPointData()),
         static_cast<vtkDataSetAttributes*>(output->GetCellData()) })
  {
    vtkDataArray* gradient = data->GetArray("Gradient");
    vtkDataArray* laplacian = data->GetArray("Laplacian");
    ASSERT_TRUE(gradient && laplacian);
    ASSERT_EQ(gradient->GetNumberOfComponents(), 6);
    ASSERT_EQ(laplacian->GetNumberOfComponents(), 2);
    for (vtkIdType i = 0; i < gradient->GetNumberOfTuples(); ++i)
    {
      for (int c = 0; c < 6; ++c)
      {
        const double expected = (c < 3 ? 1.0 : -4.0) * slope[c % 3];
        ASSERT_NEAR(gradient->GetComponent(i, c), expected, 1e-4);
      }
      ASSERT_NEAR(laplacian->GetComponent(i, 0), 0.0, 1e-2);
    }
  }
  EXPECT_EQ(output->GetFieldData()->GetArray("Converged")->GetComponent(0, 0), 1);
}

TEST_P(SurfaceGradient, HasDivergenceAndCurlOfVectors)
{
  // On the plane there are a source and a rotation. On the unit sphere there are ∇z, whose
  // divergence is -2 z, and the rotation around z, whose curl is 2 z.
  const auto sheet = MixedSheet(12);
  const Eigen::AngleAxisd turn(0.2, Vec3(1, 1, 0.5).normalized());
  AddPointArray(sheet, "v", 3,
    [&](const Vec3& p, int c)
    {
      const Vec3 q = turn.inverse() * p;
      return (turn * Vec3(3 * q[0] - 5 * q[1], 5 * q[0] + q[1], 0))[c];
    });
  const auto sphere = ToPolyData(GeodesicSphere(16));
  AddPointArray(
    sphere, "slope", 3, [](const Vec3& p, int c) { return Vec3(Vec3::UnitZ() - p[2] * p)[c]; });
  AddPointArray(
    sphere, "rotation", 3, [](const Vec3& p, int c) { return Vec3(Vec3::UnitZ().cross(p))[c]; });
  const auto check = [&](vtkPolyData* data, const char* name, double tolerance,
                       const auto& divergence, const auto& curl)
  {
    vtkNew<vtkSurfaceGradient> filter;
    filter->SetInputData(data);
    filter->SetInputArrayToProcess(0, 0, 0, Points, name);
    filter->SetDepth(4);
    filter->SetTolerance(1e-7);
    filter->SetFunctionSpace(this->GetParam());
    filter->Update();
    ASSERT_TRUE(filter->GetOutput()->GetCellData()->GetArray("Curl")) << name;
    const auto foundDivergence = PointValues(filter->GetOutput(), "Divergence");
    const auto foundCurl = PointValues(filter->GetOutput(), "Curl");
    for (vtkIdType point = 0; point < data->GetNumberOfPoints(); ++point)
    {
      const Vec3 p(data->GetPoint(point));
      ASSERT_NEAR(foundDivergence[point], divergence(p), tolerance) << name << " " << point;
      ASSERT_NEAR(foundCurl[point], curl(p), tolerance) << name << " " << point;
    }
  };
  const auto zero = [](const Vec3&) { return 0.0; };
  check(
    sheet, "v", 1e-3, [](const Vec3&) { return 4.0; }, [](const Vec3&) { return 10.0; });
  check(
    sphere, "slope", 0.2, [](const Vec3& p) { return -2 * p[2]; }, zero);
  check(sphere, "rotation", 0.2, zero, [](const Vec3& p) { return 2 * p[2]; });
}

/// Decomposes a source, an eddy and a stream around the axis on a torus, at points and on cells.
TEST_P(SurfaceGradient, TakesVectorsApart)
{
  const auto torus = ToPolyData(Torus(80, 40, 1.0, 0.4));
  const auto normal = [](const Vec3& p)
  { return Vec3((p - Vec3(p[0], p[1], 0.0).normalized()).normalized()); };
  const auto slope = [&](const Vec3& p) { return Vec3(Vec3::UnitX() - normal(p)[0] * normal(p)); };
  const auto eddy = [&](const Vec3& p) { return Vec3(normal(p).cross(Vec3::UnitZ())); };
  const auto stream = [](const Vec3& p)
  { return Vec3(Vec3(-p[1], p[0], 0.0) / (p[0] * p[0] + p[1] * p[1])); };
  AddPointArray(torus, "v", 3,
    [&](const Vec3& p, int c) // with a part along the normal that does not count
    { return (slope(p) + 2.0 * eddy(p) + 3.0 * stream(p) + p[1] * normal(p))[c]; });
  AddPointArray(torus, "f", 1, Wave);
  vtkNew<vtkSurfaceGradient> filter;
  Messages messages(filter);
  filter->SetInputData(torus);
  filter->SetInputArrayToProcess(0, 0, 0, Points, "v");
  filter->SetDepth(5);
  filter->SetFunctionSpace(this->GetParam());
  filter->Update();
  EXPECT_FALSE(filter->GetOutput()->GetPointData()->GetArray("GradientPart"));
  filter->HodgeDecompositionOn();
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 1);
  EXPECT_EQ(filter->GetNumberOfRuns("HodgeDecomposition"), 1);
  EXPECT_TRUE(messages.warnings.empty());
  const auto check = [&](const char* name, const auto& expected)
  {
    const auto found = PointValues(filter->GetOutput(), name);
    for (vtkIdType point = 0; point < torus->GetNumberOfPoints(); ++point)
    {
      const Vec3 v(found[3 * point], found[3 * point + 1], found[3 * point + 2]);
      ASSERT_LT((v - expected(Vec3(torus->GetPoint(point)))).norm(), 0.2) << name << " " << point;
    }
  };
  check("GradientPart", slope);
  check("RotationPart", [&](const Vec3& p) { return Vec3(2.0 * eddy(p)); });
  check("HarmonicPart", [&](const Vec3& p) { return Vec3(3.0 * stream(p)); });
  for (const char* name : { "GradientPart", "RotationPart", "HarmonicPart" })
  {
    vtkDataArray* onCells = filter->GetOutput()->GetCellData()->GetArray(name);
    ASSERT_TRUE(onCells) << name;
    EXPECT_EQ(onCells->GetNumberOfComponents(), 3);
  }
  EXPECT_TRUE(filter->GetOutput()->GetPointData()->GetArray("Potential"));
  EXPECT_TRUE(filter->GetOutput()->GetPointData()->GetArray("StreamFunction"));
  filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
  ExpectRefused(filter, "three components");
}

/// A Möbius strip has no sides, so that rotation has no direction.
TEST_P(SurfaceGradient, WarnsOfSurfacesWithOneSide)
{
  TriangleMesh mesh = FlatRectangle(60, 6);
  for (Vec3& p : mesh.points)
  {
    const double angle = 2 * M_PI * p[0];
    const double across = 0.6 * (p[1] - 0.5);
    const double radius = 1.0 + across * std::sin(0.5 * angle);
    p = Vec3(radius * std::cos(angle), radius * std::sin(angle), across * std::cos(0.5 * angle));
  }
  for (Id k = 0; k <= 6; ++k) // the last column is the first one upside down
  {
    mesh.points[61 * k + 60] = mesh.points[61 * (6 - k)];
  }
  const auto strip = ToPolyData(mesh);
  AddPointArray(strip, "v", 3, [](const Vec3& p, int c) { return Vec3(-p[1], p[0], 0.0)[c]; });
  vtkNew<vtkSurfaceGradient> filter;
  Messages messages(filter);
  filter->SetInputData(strip);
  filter->SetInputArrayToProcess(0, 0, 0, Points, "v");
  filter->SetDepth(4);
  filter->SetFunctionSpace(this->GetParam());
  filter->HodgeDecompositionOn();
  filter->Update();
  ExpectOne(messages.warnings, "1 of 1 connected components have only one side");
  for (const double value : PointValues(filter->GetOutput(), "RotationPart"))
  {
    ASSERT_EQ(value, 0.0);
  }
}

TEST_P(SurfaceGradient, IsComputedOnceAndAgainForAnotherArray)
{
  const auto sphere = ToPolyData(GeodesicSphere(8));
  AddPointArray(sphere, "f", 1, Wave);
  AddPointArray(sphere, "g", 1, [](const Vec3& p, int) { return p[1]; });
  vtkNew<vtkSurfaceGradient> filter;
  filter->SetInputData(sphere);
  filter->SetFunctionSpace(this->GetParam());
  filter->SetDepth(4);
  filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
  filter->Update();
  filter->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 1);
  filter->SetInputArrayToProcess(0, 0, 0, Points, "g");
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 2);
  EXPECT_EQ(filter->GetNumberOfRuns("System"), 1);
}

INSTANTIATE_TEST_SUITE_P(BothSpaces, SurfaceGradient,
  ::testing::Values(int(vtkSurfaceFEMAlgorithm::Grid), int(vtkSurfaceFEMAlgorithm::HatFunctions)));

TEST(SurfaceGradientFilter, TakesASharedBasis)
{
  const auto sphere = ToPolyData(GeodesicSphere(8));
  AddPointArray(sphere, "f", 1, Wave);
  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetInputData(sphere);
  basis->SetDepth(4);
  vtkNew<vtkSurfaceGradient> shared;
  shared->SetInputData(sphere);
  shared->SetBasisConnection(basis->GetOutputPort());
  shared->SetInputArrayToProcess(0, 0, 0, Points, "f");
  shared->Update();
  vtkNew<vtkSurfaceGradient> alone;
  alone->SetInputData(sphere);
  alone->SetDepth(4);
  alone->SetInputArrayToProcess(0, 0, 0, Points, "f");
  alone->Update();
  vtkDataArray* a = shared->GetOutput()->GetPointData()->GetArray("Gradient");
  vtkDataArray* b = alone->GetOutput()->GetPointData()->GetArray("Gradient");
  for (vtkIdType i = 0; i < a->GetNumberOfTuples(); ++i)
  {
    ASSERT_NEAR(a->GetComponent(i, 0), b->GetComponent(i, 0), 1e-9);
  }
}

/// The Laplacian of x² + 2 y² is 6, up to the boundary of a sheet.
TEST_P(SurfaceGradient, HasTheLaplacianUpToTheBoundary)
{
  const auto sheet = MixedSheet(48);
  const auto back = Eigen::AngleAxisd(-0.2, Vec3(1, 1, 0.5).normalized());
  AddPointArray(sheet, "f", 1,
    [&](const Vec3& p, int)
    {
      const Vec3 flat = back * p;
      return flat[0] * flat[0] + 2.0 * flat[1] * flat[1];
    });
  vtkNew<vtkSurfaceGradient> filter;
  filter->SetInputData(sheet);
  filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
  filter->SetDepth(6);
  filter->SetFunctionSpace(this->GetParam());
  filter->Update();
  for (const double laplacian : PointValues(filter->GetOutput(), "Laplacian"))
  {
    ASSERT_NEAR(laplacian, 6.0, 0.6);
  }
}

TEST(SurfaceGradientFilter, TakesTheCoordinatesWithoutAnArray)
{
  vtkNew<vtkSurfaceGradient> filter;
  const auto sphere = ToPolyData(GeodesicSphere(40));
  filter->SetInputData(sphere);
  filter->SetDepth(5);
  filter->Update();
  vtkDataArray* laplacian = filter->GetOutput()->GetPointData()->GetArray("Laplacian");
  double error = 0.0;
  for (vtkIdType i = 0; i < sphere->GetNumberOfPoints(); ++i)
  {
    const Vec3 found(laplacian->GetTuple3(i));
    error += (found + 2.0 * Vec3(sphere->GetPoint(i))).squaredNorm();
  }
  EXPECT_LT(std::sqrt(error / double(sphere->GetNumberOfPoints())), 0.1);
}

TEST(SurfaceGradientFilter, LeavesVerticesAndUnusedPointsAlone)
{
  const auto sphere = ToPolyData(GeodesicSphere(4));
  const double far[3] = { 9, 9, 9 };
  const vtkIdType lonely = sphere->GetPoints()->InsertNextPoint(far);
  vtkNew<vtkCellArray> verts;
  verts->InsertNextCell({ lonely });
  sphere->SetVerts(verts);
  AddPointArray(sphere, "f", 1, Wave);
  vtkNew<vtkSurfaceGradient> filter;
  filter->SetInputData(sphere);
  filter->SetDepth(3);
  filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
  filter->Update();
  ASSERT_EQ(filter->GetOutput()->GetNumberOfCells(), sphere->GetNumberOfCells());
  auto* laplacian = filter->GetOutput()->GetPointData()->GetArray("Laplacian");
  EXPECT_TRUE(std::isnan(laplacian->GetComponent(lonely, 0)));
  vtkDataArray* onCells = filter->GetOutput()->GetCellData()->GetArray("Laplacian");
  EXPECT_TRUE(std::isnan(onCells->GetComponent(0, 0))); // the vertex
  EXPECT_TRUE(std::isfinite(onCells->GetComponent(1, 0)));
}
