// Tests TrackMetric of Screened Poisson and Laplace Spectrum. If only the points of a surface move,
// it keeps its functions, and results belong to the moved surface.

#include "FilterSupport.h"
#include "GrowingSphere.h"

#include "vtkLaplaceSpectrum.h"
#include "vtkScreenedPoisson.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

using Algorithm = vtkSurfaceFEMAlgorithm;
using Map = std::function<Vec3(const Vec3&)>;

constexpr int Spaces[] = { Algorithm::Grid, Algorithm::HatFunctions };

Vec3 Turn(const Vec3& p)
{
  return Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()) * p + Vec3(3, -2, 5);
}

/// Makes all arrays anew, as a reader does. The point array "f" belongs to the mesh before.
vtkSmartPointer<vtkPolyData> Read(const TriangleMesh& mesh, const Map& map)
{
  auto data = ToPolyData(mesh);
  AddPointArray(data, "f", 1, Wave);
  data->SetPoints(ToPolyData(Mapped(mesh, map))->GetPoints());
  return data;
}

Vec3 Stay(const Vec3& p)
{
  return p;
}

template<class Filter>
void SetOptions(Filter* filter, int space)
{
  filter->SetFunctionSpace(space);
  filter->SetDepth(4);
  filter->SetTolerance(1e-13);
  filter->SetMaximumIterations(500);
  filter->SetParameterUnits(Algorithm::World);
}

class TrackMetric : public ::testing::Test
{
protected:
  using Setting = std::function<void(vtkScreenedPoisson*)>;

  void Begin(
    int space, const Setting& set = [](vtkScreenedPoisson*) {})
  {
    poisson = vtkSmartPointer<vtkScreenedPoisson>::New();
    this->Prepare(poisson, space, set);
    poisson->TrackMetricOn();
    poisson->SetInputData(Read(mesh, Stay));
    poisson->Update();
  }

  void Prepare(vtkScreenedPoisson* filter, int space, const Setting& set)
  {
    SetOptions(filter, space);
    filter->SetScreeningWeight(2.0);
    filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
    set(filter);
  }

  std::vector<double> Follow(vtkPolyData* data)
  {
    poisson->SetInputData(data);
    poisson->Update();
    EXPECT_EQ(FieldValue(poisson->GetOutput(), "Converged"), 1);
    return PointValues(poisson->GetOutput(), "Solution");
  }

  std::vector<double> Rebuilt(
    vtkPolyData* data, int space, const Setting& set = [](vtkScreenedPoisson*) {})
  {
    fresh = vtkSmartPointer<vtkScreenedPoisson>::New();
    this->Prepare(fresh, space, set);
    fresh->SetInputData(data);
    fresh->Update();
    return PointValues(fresh->GetOutput(), "Solution");
  }

  /// Returns the numbers of runs of Space, System and Hierarchy.
  std::vector<vtkIdType> Runs() const
  {
    return { poisson->GetNumberOfRuns("Space"), poisson->GetNumberOfRuns("System"),
      poisson->GetNumberOfRuns("Hierarchy") };
  }

  TriangleMesh mesh = Transform(GeodesicSphere(8), { 1, 2, 0 }, 0.3);
  vtkSmartPointer<vtkScreenedPoisson> poisson;
  vtkSmartPointer<vtkScreenedPoisson> fresh;
};

TEST_F(TrackMetric, ARigidMotionChangesNothing)
{
  for (const int space : Spaces)
  {
    this->Begin(space);
    const auto before = PointValues(poisson->GetOutput(), "Solution");
    EXPECT_LT(Difference(this->Follow(Read(mesh, Turn)), before), 1e-10);
    EXPECT_EQ(this->Runs(), (std::vector<vtkIdType>{ 1, 2, 2 }));
    EXPECT_NEAR(FieldValue(poisson->GetOutput(), "LargestStretchRatio"), 1.0, 1e-7);
  }
}

TEST_F(TrackMetric, AScaledSurfaceScales)
{
  const double scale = 2.5;
  const auto grow = [=](const Vec3& p) { return Vec3(scale * p); };
  for (const int space : Spaces)
  {
    // λ is per squared length.
    this->Begin(space);
    const auto before = PointValues(poisson->GetOutput(), "Solution");
    poisson->SetScreeningWeight(2.0 / (scale * scale));
    EXPECT_LT(Difference(this->Follow(Read(mesh, grow)), before), 1e-10);
    for (const int units : { Algorithm::UnitArea, Algorithm::UnitCube })
    {
      this->Begin(space, [=](vtkScreenedPoisson* filter) { filter->SetParameterUnits(units); });
      const auto inUnits = PointValues(poisson->GetOutput(), "Solution");
      EXPECT_LT(Difference(this->Follow(Read(mesh, grow)), inUnits), 1e-10) << units;
    }
    vtkNew<vtkLaplaceSpectrum> spectrum;
    SetOptions(spectrum.Get(), space);
    spectrum->TrackMetricOn();
    spectrum->SetNumberOfModes(9);
    std::vector<double> values[2];
    for (const bool isGrown : { false, true })
    {
      spectrum->SetInputData(Read(mesh, isGrown ? Map(grow) : Map(Stay)));
      spectrum->Update();
      values[isGrown] = Values(spectrum->GetOutput()->GetFieldData()->GetArray("Eigenvalues"));
    }
    EXPECT_EQ(spectrum->GetNumberOfRuns("Space"), 1);
    ASSERT_EQ(values[0].size(), values[1].size());
    for (std::size_t k = 0; k < values[0].size(); ++k)
    {
      EXPECT_NEAR(values[1][k] * scale * scale, values[0][k], 1e-8 * values[0].back());
    }
  }
}

/// Hat functions belong to the moved mesh itself.
TEST_F(TrackMetric, OnHatFunctionsItIsTheSolutionOfTheMovedMesh)
{
  const auto moved = Read(mesh, Bend);
  AddPointArray(moved, "s", 3, [](const Vec3& p, int c) { return Wave(p, c) + 0.2 * c; });
  const auto start = Read(mesh, Stay);
  AddPointArray(start, "s", 3, Wave);
  const std::vector<Setting> settings = {
    [](vtkScreenedPoisson*) {},
    [](vtkScreenedPoisson* filter) { filter->SetParameterUnits(Algorithm::UnitArea); },
    [](vtkScreenedPoisson* filter)
    {
      filter->UseValueGradientOn();
      filter->SetGradientScale(1.5);
    },
    [](vtkScreenedPoisson* filter) { filter->SetInputArrayToProcess(1, 0, 0, Points, "s"); },
    [](vtkScreenedPoisson* filter) // the coordinates, and the shape they make
    { filter->SetInputArrayToProcess(0, 0, 0, Points, "None"); },
    [](vtkScreenedPoisson* filter)
    {
      filter->SetInputArrayToProcess(0, 0, 0, Points, "None");
      filter->UseValueGradientOn();
      filter->SetGradientScale(1.5);
    },
    [](vtkScreenedPoisson* filter)
    { filter->SetInputArrayToProcess(3, 0, 0, Points, "weight"); } // constrained
  };
  for (vtkPolyData* data : { start.Get(), moved.Get() })
  {
    AddPointArray(data, "weight", 1, [](const Vec3&, int) { return 0.5; })->SetValue(3, 2.0);
  }
  for (std::size_t k = 0; k < settings.size(); ++k)
  {
    this->Begin(Algorithm::HatFunctions);
    settings[k](poisson);
    this->Follow(start);
    const auto tracked = this->Follow(moved);
    EXPECT_EQ(poisson->GetNumberOfRuns("Space"), 1) << k;
    const auto expected = this->Rebuilt(moved, Algorithm::HatFunctions, settings[k]);
    EXPECT_LT(Difference(tracked, expected), 1e-9) << k;
    for (const char* name : { "Displacement", "NormalDisplacement" })
    {
      EXPECT_LT(
        Difference(PointValues(poisson->GetOutput(), name), PointValues(fresh->GetOutput(), name)),
        1e-9)
        << k;
    }
    EXPECT_GT(FieldValue(poisson->GetOutput(), "LargestStretchRatio"), 1.1);
  }
}

TEST_F(TrackMetric, OnAGridItIsTheSolutionInTheMetricOfTheMotion)
{
  const TriangleMesh moved = Mapped(mesh, Bend);
  const auto given = Read(mesh, Stay);
  vtkNew<vtkDoubleArray> metric;
  metric->SetName("metric");
  metric->SetNumberOfComponents(9);
  const auto frameOf = [](const TriangleMesh& of, std::size_t t)
  {
    const auto& corner = of.triangles[t];
    const Vec3 a = of.points[corner[1]] - of.points[corner[0]];
    const Vec3 b = of.points[corner[2]] - of.points[corner[0]];
    Eigen::Matrix3d columns;
    columns << a, b, a.cross(b).normalized();
    return columns;
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const Eigen::Matrix3d map = frameOf(moved, t) * frameOf(mesh, t).inverse();
    const Eigen::Matrix3d tensor = map.transpose() * map;
    metric->InsertNextTuple(tensor.data());
  }
  given->GetCellData()->AddArray(metric);
  this->Begin(Algorithm::Grid);
  const auto tracked = this->Follow(Read(mesh, Bend));
  const auto inMetric = this->Rebuilt(given, Algorithm::Grid,
    [](vtkScreenedPoisson* filter) { filter->SetInputArrayToProcess(5, 0, 0, Cells, "metric"); });
  EXPECT_LT(Difference(tracked, inMetric), 1e-10);
  // The result is also near that on a grid of the moved surface.
  EXPECT_LT(Difference(tracked, this->Rebuilt(Read(mesh, Bend), Algorithm::Grid)), 0.02);
}

TEST_F(TrackMetric, OnlyWhatDependsOnAMotionIsComputedAgain)
{
  this->Begin(Algorithm::Grid);
  const auto before = PointValues(poisson->GetOutput(), "Solution");
  const auto bent = this->Follow(Read(mesh, Bend));
  EXPECT_EQ(this->Runs(), (std::vector<vtkIdType>{ 1, 2, 2 }));
  EXPECT_LT(Difference(this->Follow(Read(mesh, Bend)), bent), 1e-11); // read again
  EXPECT_EQ(this->Runs(), (std::vector<vtkIdType>{ 1, 2, 2 }));
  poisson->SetScreeningWeight(5.0);
  poisson->Update();
  EXPECT_EQ(this->Runs(), (std::vector<vtkIdType>{ 1, 2, 3 }));
  poisson->SetScreeningWeight(2.0);
  EXPECT_LT(Difference(this->Follow(Read(mesh, Stay)), before), 1e-11); // back again
  EXPECT_EQ(poisson->GetNumberOfRuns("Space"), 1);
  this->Follow(Read(mesh, Turn));
  EXPECT_LT(Difference(this->Follow(Read(mesh, Bend)), bent), 1e-11); // whatever was in between
  EXPECT_EQ(poisson->GetNumberOfRuns("Space"), 1);
  // Another depth makes the current surface the first one.
  poisson->SetDepth(5);
  poisson->Update();
  EXPECT_EQ(poisson->GetNumberOfRuns("Space"), 2);
  EXPECT_EQ(FieldValue(poisson->GetOutput(), "LargestStretchRatio"), 1.0);
  this->Follow(Read(mesh, Turn));
  EXPECT_EQ(poisson->GetNumberOfRuns("Space"), 2);
}

TEST_F(TrackMetric, OtherCellsAndLostTrianglesStartAgain)
{
  this->Begin(Algorithm::Grid);
  const auto turned = Read(GeodesicSphere(9), Turn);
  EXPECT_EQ(this->Follow(turned), this->Rebuilt(turned, Algorithm::Grid));
  EXPECT_EQ(poisson->GetNumberOfRuns("Space"), 2);
  TriangleMesh swapped = GeodesicSphere(9);
  std::swap(swapped.triangles[0], swapped.triangles[7]);
  this->Follow(Read(swapped, Bend));
  EXPECT_EQ(poisson->GetNumberOfRuns("Space"), 3);
  const auto corner = swapped.triangles[11];
  const Vec3 place = swapped.points[corner[0]];
  const Vec3 lost = swapped.points[corner[1]];
  const auto collapsed = Read(swapped, [=](const Vec3& p) { return p == lost ? place : p; });
  EXPECT_EQ(this->Follow(collapsed), this->Rebuilt(collapsed, Algorithm::Grid));
  EXPECT_EQ(poisson->GetNumberOfRuns("Space"), 4);
}

TEST_F(TrackMetric, OffEverySurfaceHasFunctionsOfItsOwn)
{
  this->Begin(Algorithm::Grid);
  poisson->TrackMetricOff();
  const auto bent = Read(mesh, Bend);
  EXPECT_EQ(this->Follow(bent), this->Rebuilt(bent, Algorithm::Grid));
  EXPECT_EQ(poisson->GetNumberOfRuns("Space"), 2);
  EXPECT_FALSE(poisson->GetOutput()->GetFieldData()->HasArray("LargestStretchRatio"));
}

TEST_F(TrackMetric, WhatDoesNotGoTogetherIsRefused)
{
  this->Begin(Algorithm::Grid);
  const auto data = Read(mesh, Stay);
  AddPointArray(data, "metric", 6, [](const Vec3&, int c) { return c < 3 ? 1.0 : 0.0; });
  poisson->SetInputData(data);
  poisson->SetInputArrayToProcess(5, 0, 0, Points, "metric");
  ExpectRefused(poisson, "Track Metric");
  poisson->SetInputArrayToProcess(5, 0, 0, Points, "None");
  poisson->SetInputArrayToProcess(6, 0, 0, Points, "f");
  ExpectRefused(poisson, "Track Metric");
}

TEST_F(TrackMetric, TimeStepsSayWhichOneTheyStandOn)
{
  vtkNew<GrowingSphere> source;
  vtkNew<vtkLaplaceSpectrum> spectrum;
  spectrum->SetDepth(4);
  spectrum->SetNumberOfModes(4);
  spectrum->AllModesOn();
  spectrum->TrackMetricOn();
  spectrum->SetInputConnection(source->GetOutputPort());
  std::vector<double> scaled;
  for (const double time : { 2.0, 1.0, 3.0, 1.0 })
  {
    spectrum->UpdateTimeStep(time);
    const auto eigenvalues = Values(spectrum->GetOutput()->GetFieldData()->GetArray("Eigenvalues"));
    EXPECT_EQ(FieldValue(spectrum->GetOutput(), "ReferenceTime"), 2.0);
    scaled.push_back(eigenvalues[1] * time * time);
    EXPECT_NEAR(scaled.back(), scaled.front(), 1e-5);
  }
  EXPECT_EQ(spectrum->GetNumberOfRuns("Space"), 1);
  EXPECT_EQ(spectrum->GetNumberOfRuns("Solve"), 4);
}

/// Reads a scan that bends from files. The grid stays, and the solution equals the solution on a
/// new grid up to the errors of both.
TEST_F(TrackMetric, AScanBends)
{
  const std::string path = RealMesh("armadillo_100k.ply");
  if (path.empty())
  {
    GTEST_SKIP() << "no real meshes";
  }
  mesh = ReadMesh(path);
  const Bounds bounds = BoundsOf(mesh.points);
  const Vec3 center = 0.5 * (bounds.low + bounds.high);
  const double size = 0.5 * (bounds.high - bounds.low).maxCoeff<Eigen::PropagateNaN>();
  mesh = Mapped(mesh, [&](const Vec3& p) -> Vec3 { return (p - center) / size; });
  const auto set = [](vtkScreenedPoisson* filter)
  {
    filter->SetDepth(7);
    filter->SetTolerance(1e-8);
    filter->SetScreeningWeight(100.0);
  };
  this->Begin(Algorithm::Grid, set);
  const double first = poisson->GetStageSeconds("Space") + poisson->GetStageSeconds("System") +
                       poisson->GetStageSeconds("Hierarchy");
  const auto bent = Read(mesh, [](const Vec3& p) { return Vec3(p + 0.3 * (Bend(p) - p)); });
  const auto tracked = this->Follow(bent);
  const double again = poisson->GetStageSeconds("System") + poisson->GetStageSeconds("Hierarchy");
  EXPECT_EQ(this->Runs(), (std::vector<vtkIdType>{ 1, 2, 2 }));
  EXPECT_LT(again, first);
  EXPECT_LT(Difference(tracked, this->Rebuilt(bent, Algorithm::Grid, set)), 0.02);
}

} // namespace
