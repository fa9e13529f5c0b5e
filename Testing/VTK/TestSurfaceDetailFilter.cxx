// Surface Detail as a user of VTK sees it.
#include "FilterSupport.h"

#include "vtkConnectivityAwareBasis.h"
#include "vtkSurfaceDetail.h"

#include <gtest/gtest.h>

#include <limits>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr const char* DetailStages[] = { "Space", "System", "Metric", "Weights", "Signal",
  "Hierarchy", "RightHandSide", "Solve" };

/// A sphere with waves on it, normals and a mask of its upper half.
vtkSmartPointer<vtkPolyData> WavySphere()
{
  TriangleMesh mesh = Transform(GeodesicSphere(16), { 1, 2, 3 }, 0.4);
  for (Vec3& p : mesh.points)
  {
    p *= 1.0 + 0.03 * std::sin(12.0 * p[0]) * std::sin(12.0 * p[1]);
  }
  auto data = ToPolyData(mesh);
  AddPointArray(data, "upper", 1, [](const Vec3& p, int) { return p[2] > 0.0 ? 1.0 : 0.5; });
  AddPointArray(data, "f", 2, Wave);
  data->GetPointData()->SetNormals(
    AddPointArray(data, "n", 3, [](const Vec3& p, int c) { return p.normalized()[c]; }));
  return data;
}

vtkSmartPointer<vtkSurfaceDetail> DetailOf(vtkPolyData* data, int functionSpace)
{
  auto filter = vtkSmartPointer<vtkSurfaceDetail>::New();
  filter->SetInputData(data);
  filter->SetDepth(4);
  filter->SetScreeningWeight(500.0);
  filter->SetFunctionSpace(functionSpace);
  return filter;
}

/// The stages that run again.
std::vector<std::string> Reruns(vtkSurfaceDetail* filter, const std::function<void()>& change)
{
  std::vector<vtkIdType> before;
  for (const char* stage : DetailStages)
  {
    before.push_back(filter->GetNumberOfRuns(stage));
  }
  change();
  filter->Update();
  std::vector<std::string> runs;
  for (std::size_t k = 0; k < std::size(DetailStages); ++k)
  {
    if (filter->GetNumberOfRuns(DetailStages[k]) != before[k])
    {
      runs.emplace_back(DetailStages[k]);
    }
  }
  return runs;
}

/// Standard deviation of the distances from the centre, relative to their mean: smoothing shrinks.
double Roughness(vtkPolyData* data)
{
  double sum = 0.0;
  double squares = 0.0;
  for (vtkIdType p = 0; p < data->GetNumberOfPoints(); ++p)
  {
    const double radius = Vec3(data->GetPoint(p)).norm();
    sum += radius;
    squares += radius * radius;
  }
  const double points = double(data->GetNumberOfPoints());
  return std::sqrt(squares * points / (sum * sum) - 1.0);
}

std::vector<double> Positions(vtkPolyData* data)
{
  return Values(data->GetPoints()->GetData());
}

class SurfaceDetailFilter : public ::testing::TestWithParam<int>
{
};

} // namespace

TEST_P(SurfaceDetailFilter, SharpensAndSmooths)
{
  const auto sphere = WavySphere();
  for (const int transfer : { 0, 1, 2, 3, 4 })
  {
    const auto filter = DetailOf(sphere, GetParam());
    filter->SetTransferFunction(transfer);
    const auto roughness = [&](double scale)
    {
      filter->SetDetailScale(scale);
      filter->Update();
      EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1);
      return Roughness(filter->GetOutput());
    };
    EXPECT_LT(roughness(0.0), 0.9 * Roughness(sphere)) << transfer;
    EXPECT_GT(roughness(2.0), 1.1 * Roughness(sphere)) << transfer;
    filter->SetDetailScale(1.0);
    filter->Update();
    EXPECT_EQ(Positions(filter->GetOutput()), Positions(sphere)) << transfer;
  }
}

TEST_P(SurfaceDetailFilter, RepeatsOnlyWhatDependsOnAChange)
{
  const auto filter = DetailOf(WavySphere(), GetParam());
  using Names = std::vector<std::string>;
  EXPECT_EQ(Reruns(filter, [] {}),
    Names({ "Space", "System", "Signal", "Hierarchy", "RightHandSide", "Solve" }));
  EXPECT_EQ(Reruns(filter, [&] { filter->SetDetailScale(0.3); }), Names());
  EXPECT_EQ(Reruns(filter, [&] { filter->SetInputArrayToProcess(1, 0, 0, Points, "upper"); }),
    Names({ "RightHandSide", "Solve" }));
  EXPECT_EQ(
    Reruns(filter, [&] { filter->SetScreeningWeight(50.0); }), Names({ "Hierarchy", "Solve" }));
  EXPECT_EQ(Reruns(filter, [&] { filter->SetTransferFunction(vtkSurfaceDetail::LargePositive); }),
    Names({ "Metric", "Weights", "Hierarchy", "RightHandSide", "Solve" }));
  EXPECT_EQ(Reruns(filter, [&] { filter->SetAnisotropy(3.0); }),
    Names({ "Weights", "Hierarchy", "RightHandSide", "Solve" }));
  EXPECT_EQ(Reruns(filter, [&] { filter->SetInputArrayToProcess(0, 0, 0, Points, "f"); }),
    Names({ "Signal", "RightHandSide", "Solve" }));
  EXPECT_EQ(Reruns(filter, [&] { filter->SetNumberOfThreads(1); }), Names());
}

/// What the stages keep gives what a new filter gives.
TEST_P(SurfaceDetailFilter, GivesTheSameAgainAsAtFirst)
{
  const auto sphere = WavySphere();
  const auto changed = DetailOf(sphere, GetParam());
  changed->SetTolerance(1e-10);
  changed->Update();
  changed->SetTransferFunction(vtkSurfaceDetail::LargeAbsolute);
  changed->Update();
  changed->SetAnisotropy(3.0);
  changed->SetInputArrayToProcess(1, 0, 0, Points, "upper");
  changed->SetDetailScale(0.5);
  changed->Update();
  const auto fresh = DetailOf(sphere, GetParam());
  fresh->SetTolerance(1e-10);
  fresh->SetTransferFunction(vtkSurfaceDetail::LargeAbsolute);
  fresh->SetAnisotropy(3.0);
  fresh->SetInputArrayToProcess(1, 0, 0, Points, "upper");
  fresh->SetDetailScale(0.5);
  fresh->Update();
  EXPECT_LE(Difference(Positions(changed->GetOutput()), Positions(fresh->GetOutput())), 1e-9);
  changed->SetTransferFunction(vtkSurfaceDetail::Isotropic);
  changed->Update();
  const auto isotropic = DetailOf(sphere, GetParam());
  isotropic->SetTolerance(1e-10);
  isotropic->SetInputArrayToProcess(1, 0, 0, Points, "upper");
  isotropic->SetDetailScale(0.5);
  isotropic->Update();
  EXPECT_LE(Difference(Positions(changed->GetOutput()), Positions(isotropic->GetOutput())), 1e-9);
}

TEST_P(SurfaceDetailFilter, ChangesWhereTheArraySays)
{
  const auto sphere = WavySphere();
  const auto filter = DetailOf(sphere, GetParam());
  filter->SetInputArrayToProcess(1, 0, 0, Points, "upper");
  filter->SetScreeningWeight(3000.0);
  filter->Update(); // scale 2 above, 1 below
  double above = 0.0;
  double farBelow = 0.0;
  for (vtkIdType p = 0; p < sphere->GetNumberOfPoints(); ++p)
  {
    const double moved =
      std::abs(filter->GetOutput()->GetPointData()->GetArray("NormalDisplacement")->GetTuple1(p));
    const double z = sphere->GetPoint(p)[2];
    above = z > 0.3 ? std::max(above, moved) : above;
    farBelow = z < -0.5 ? std::max(farBelow, moved) : farBelow;
  }
  EXPECT_GT(above, 5e-3);
  EXPECT_LT(farBelow, 0.05 * above);
}

TEST_P(SurfaceDetailFilter, FiltersAnArrayAndKeepsTheShape)
{
  const auto sphere = WavySphere();
  const auto filter = DetailOf(sphere, GetParam());
  filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
  filter->SetDetailScale(1.0);
  filter->Update();
  EXPECT_EQ(Positions(filter->GetOutput()), Positions(sphere));
  EXPECT_LE(
    Difference(PointValues(filter->GetOutput(), "Filtered"), PointValues(sphere, "f")), 1e-14);
  filter->SetDetailScale(0.0);
  filter->Update();
  EXPECT_GT(
    Difference(PointValues(filter->GetOutput(), "Filtered"), PointValues(sphere, "f")), 0.05);
}

/// The shape as an array gives the shape.
TEST_P(SurfaceDetailFilter, OfTheCoordinatesAsAnArrayIsTheShape)
{
  const auto sphere = WavySphere();
  AddPointArray(sphere, "xyz", 3, [](const Vec3& p, int c) { return p[c]; });
  const auto shape = DetailOf(sphere, GetParam());
  shape->Update();
  const auto array = DetailOf(sphere, GetParam());
  array->SetInputArrayToProcess(0, 0, 0, Points, "xyz");
  array->Update();
  const double moved = Difference(Positions(shape->GetOutput()), Positions(sphere));
  EXPECT_LE(Difference(PointValues(array->GetOutput(), "Filtered"), Positions(shape->GetOutput())),
    0.02 * moved);
}

TEST_P(SurfaceDetailFilter, RecomputesNormalsAndKeepsTheVolume)
{
  const auto sphere = WavySphere();
  const auto filter = DetailOf(sphere, GetParam());
  filter->SetDetailScale(0.0);
  filter->SetScreeningWeight(20.0);
  filter->KeepVolumeOn();
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  vtkDataArray* normals = output->GetPointData()->GetNormals();
  ASSERT_TRUE(normals);
  double radius = 0.0;
  for (vtkIdType p = 0; p < output->GetNumberOfPoints(); ++p)
  {
    const Vec3 place(output->GetPoint(p));
    radius += place.norm() / double(output->GetNumberOfPoints());
    EXPECT_GT(Vec3(normals->GetTuple3(p)).dot(place.normalized()), 0.97);
  }
  EXPECT_NEAR(radius, 1.0, 0.01); // without it, less than 0.95
}

INSTANTIATE_TEST_SUITE_P(BothSpaces, SurfaceDetailFilter,
  ::testing::Values(int(vtkSurfaceFEMAlgorithm::Grid), int(vtkSurfaceFEMAlgorithm::HatFunctions)));

TEST(SurfaceDetailOfVTK, RefusesWhatItCannotUse)
{
  constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
  const auto refuses = [](const char* name, const std::function<void(vtkSurfaceDetail*)>& set)
  {
    const auto sphere = WavySphere();
    const auto filter = DetailOf(sphere, vtkSurfaceFEMAlgorithm::Grid);
    set(filter);
    const Messages messages(filter);
    EXPECT_EQ(filter->GetExecutive()->Update(), 0) << name;
    ASSERT_EQ(messages.errors.size(), 1u) << name;
    EXPECT_NE(messages.errors[0].find(name), std::string::npos) << messages.errors[0];
    EXPECT_TRUE(IsEmptyData(filter->GetOutput())) << name;
  };
  refuses("DetailScale", [](auto* filter) { filter->SetDetailScale(NaN); });
  refuses("ScreeningWeight", [](auto* filter) { filter->SetScreeningWeight(-1.0); });
  refuses("SmoothingScale", [](auto* filter) { filter->SetSmoothingScale(NaN); });
  refuses("Anisotropy", [](auto* filter) { filter->SetAnisotropy(NaN); });
  refuses("TransferPoints", [](auto* filter) { filter->AddTransferPoint(0.0, 0.0); });
  refuses(
    "DetailScaleArray", [](auto* filter) { filter->SetInputArrayToProcess(1, 0, 0, Points, "f"); });
  refuses(
    "nothing", [](auto* filter) { filter->SetInputArrayToProcess(0, 0, 0, Points, "nothing"); });
}

TEST(SurfaceDetailOfVTK, TakesASharedBasis)
{
  const auto sphere = WavySphere();
  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetInputData(sphere);
  basis->SetDepth(4);
  const auto shared = DetailOf(sphere, vtkSurfaceFEMAlgorithm::Grid);
  shared->SetBasisConnection(basis->GetOutputPort());
  shared->SetDepth(7);
  shared->Update();
  const auto alone = DetailOf(sphere, vtkSurfaceFEMAlgorithm::Grid);
  alone->Update();
  EXPECT_LE(Difference(Positions(shared->GetOutput()), Positions(alone->GetOutput())), 1e-9);
}

/// A flat surface has no curvature to tell places apart.
TEST(SurfaceDetailOfVTK, OfAPlaneIsAPlane)
{
  const auto filter = DetailOf(ToPolyData(FlatRectangle(8, 8)), vtkSurfaceFEMAlgorithm::Grid);
  filter->SetTransferFunction(vtkSurfaceDetail::LargeAbsolute);
  filter->SetDetailScale(3.0);
  filter->Update();
  for (vtkIdType p = 0; p < filter->GetOutput()->GetNumberOfPoints(); ++p)
  {
    EXPECT_NEAR(filter->GetOutput()->GetPoint(p)[2], 0.0, 1e-9);
  }
}
