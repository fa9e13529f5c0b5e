// Heat Diffusion as a user of VTK sees it.
#include "FilterSupport.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkHeatDiffusion.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr double Radius = 2.0;

/// Makes a sphere with the components z, which decays by exp(-2 t / r²), and 1.
vtkSmartPointer<vtkPolyData> Input()
{
  auto data = ToPolyData(GeodesicSphere(24, Radius));
  AddPointArray(data, "z", 1, [](const Vec3& p, int) { return p[2]; });
  AddPointArray(data, "one", 1, [](const Vec3&, int) { return 1.0; });
  return data;
}

vtkSmartPointer<vtkHeatDiffusion> MakeFilter(double time, int steps)
{
  auto filter = vtkSmartPointer<vtkHeatDiffusion>::New();
  filter->SetDepth(5);
  filter->SetInputDataObject(Input());
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "z");
  filter->SetParameterUnits(vtkSurfaceFEMAlgorithm::World);
  filter->SetDiffusionTime(time);
  filter->SetNumberOfSteps(steps);
  return filter;
}

/// Returns the values at the points of the sphere, at a step.
std::vector<double> DiffusedAt(vtkHeatDiffusion* filter, double step)
{
  EXPECT_EQ(filter->UpdateTimeStep(step), 1);
  return PointValues(filter->GetOutputDataObject(0), "Diffused");
}

void ExpectNear(
  const std::vector<double>& found, const std::vector<double>& expected, double tolerance)
{
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    ASSERT_NEAR(found[i], expected[i], tolerance);
  }
}

double HeightAtPole(const std::vector<double>& values)
{
  return *std::max_element(values.begin(), values.end());
}

} // namespace

TEST(HeatDiffusionFilter, DecaysInTimeStepsAsTheSphereSays)
{
  auto filter = MakeFilter(0.8, 4);
  for (const int step : { 4, 1, 3 })
  {
    const double exact = Radius * std::exp(-2.0 * 0.2 * step / (Radius * Radius));
    EXPECT_NEAR(HeightAtPole(DiffusedAt(filter, step)), exact, 0.01);
  }
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 4);
  EXPECT_EQ(filter->GetNumberOfRuns("Hierarchy"), 1);
}

/// The heat of a point has the sign of the given heat, from the first step on.
TEST(HeatDiffusionFilter, TheHeatOfAPointIsPositiveAndLargeWhereItWasPut)
{
  for (const int space : { 0, 1 })
  {
    for (const double time : { 0.1, 0.4, 2.0 }) // the root is 5, 10 and 23 cells
    {
      auto filter = MakeFilter(time, 2);
      auto sphere = Input();
      const Vec3 source(sphere->GetPoint(100));
      AddPointArray(sphere, "heat", 1, [&](const Vec3& p, int) { return p == source ? 1.0 : 0.0; });
      filter->SetInputDataObject(sphere);
      filter->SetFunctionSpace(space);
      filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "heat");
      for (const int step : { 1, 2 })
      {
        const std::vector<double> heat = DiffusedAt(filter, step);
        ASSERT_TRUE(AllFinite(heat));
        const double most = HeightAtPole(heat);
        EXPECT_GT(*std::min_element(heat.begin(), heat.end()), -1e-3 * most) << time;
        EXPECT_GT(heat[100], (step == 1 ? 0.87 : 0.97) * most) << time << " " << step;
      }
    }
  }
}

/// Widths are in the unit of the points, for any unit of the time.
TEST(HeatDiffusionFilter, TakesWidthsInTheUnitOfThePoints)
{
  const double time = 0.3;
  const std::vector<double> expected = DiffusedAt(MakeFilter(time, 1), 1);
  for (const int units : { vtkSurfaceFEMAlgorithm::World, vtkSurfaceFEMAlgorithm::UnitArea })
  {
    auto filter = MakeFilter(7.0, 1);
    filter->SetParameterUnits(units);
    filter->SetAmount(vtkHeatDiffusion::FullWidth);
    filter->SetFWHM(std::sqrt(16.0 * std::log(2.0) * time));
    ExpectNear(DiffusedAt(filter, 1), expected, 1e-6);
    EXPECT_NEAR(FieldValue(filter->GetOutputDataObject(0), "DiffusionTime"), time, 1e-12);
    filter->SetAmount(vtkHeatDiffusion::StandardDeviation);
    filter->SetSigma(std::sqrt(2.0 * time));
    ExpectNear(DiffusedAt(filter, 1), expected, 1e-6);
  }
}

/// A reader gives a new mesh and new arrays at every time. A mesh that stays keeps its functions
/// and its hierarchy, also within a mask.
TEST(HeatDiffusionFilter, FramesOnAMeshThatStaysRepeatOnlyTheSolve)
{
  const TriangleMesh mesh = GeodesicSphere(12, Radius);
  auto filter = MakeFilter(0.1, 1);
  filter->SetInputArrayToProcess(9, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "mask");
  for (int frame = 0; frame < 3; ++frame)
  {
    const auto input = [&](const TriangleMesh& of)
    {
      auto data = ToPolyData(of);
      AddPointArray(data, "z", 1, [=](const Vec3& p, int) { return std::sin(p[2] + frame); });
      AddPointArray(data, "mask", 1, [](const Vec3& p, int) { return p[0] > -0.5 ? 1.0 : 0.0; });
      return data;
    };
    filter->SetInputDataObject(input(mesh));
    const std::vector<double> values = DiffusedAt(filter, 1);
    EXPECT_EQ(filter->GetNumberOfRuns("Space"), 1);
    EXPECT_EQ(filter->GetNumberOfRuns("Hierarchy"), 1);
    EXPECT_EQ(filter->GetNumberOfRuns("Solve"), frame + 1);
    TriangleMesh part = mesh;
    part.triangles.clear();
    for (const auto& triangle : mesh.triangles)
    {
      if (std::all_of(triangle.begin(), triangle.end(),
            [&](Id point) { return mesh.points[point][0] > -0.5; }))
      {
        part.triangles.push_back(triangle);
      }
    }
    auto cut = MakeFilter(0.1, 1);
    cut->SetInputDataObject(input(part));
    const std::vector<double> expected = DiffusedAt(cut, 1);
    ASSERT_EQ(values.size(), expected.size());
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      EXPECT_TRUE(values[i] == expected[i] || (std::isnan(values[i]) && std::isnan(expected[i])));
    }
  }
}

TEST(HeatDiffusionFilter, AddsItsSourcePerWorldTime)
{
  auto filter = MakeFilter(0.8, 2);
  const std::vector<double> without = DiffusedAt(filter, 2);
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "one");
  const std::vector<double> with = DiffusedAt(filter, 2);
  ASSERT_EQ(with.size(), without.size());
  for (std::size_t i = 0; i < with.size(); ++i)
  {
    ASSERT_NEAR(with[i] - without[i], 0.8, 1e-4);
  }
}

TEST(HeatDiffusionFilter, WithoutAnArrayThePointsMove)
{
  auto filter = MakeFilter(0.8, 4);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "None");
  filter->UpdateTimeStep(2.0);
  const double radius = Radius * std::exp(-2.0 * 0.4 / (Radius * Radius));
  vtkPolyData* output = filter->GetOutput();
  for (vtkIdType k = 0; k < output->GetNumberOfPoints(); ++k)
  {
    EXPECT_NEAR(Vec3(output->GetPoint(k)).norm(), radius, 0.02);
  }
  EXPECT_TRUE(output->GetPointData()->HasArray("Displacement"));
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 4);
}

TEST(HeatDiffusionFilter, PointsWithoutPolygonsHaveNoValue)
{
  auto input = Input();
  input->GetPoints()->InsertNextPoint(0, 0, 9);
  AddPointArray(input, "z", 1, [](const Vec3& p, int) { return p[2]; });
  auto filter = MakeFilter(0.8, 1);
  filter->SetInputDataObject(input);
  EXPECT_TRUE(std::isnan(DiffusedAt(filter, 1).back()));
}

TEST(HeatDiffusionFilter, RefusesASourceOfOtherComponentsAndNoTime)
{
  auto filter = MakeFilter(0.1, 1);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "None");
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "one");
  ExpectRefused(filter, "'one' has 1 components");
  filter = MakeFilter(0.0, 1);
  ExpectRefused(filter, "Diffusion Time is 0");
}

/// Makes a square that is 0 at its boundary and 1 in the middle at first.
TEST(HeatDiffusionFilter, HoldsTheBoundary)
{
  auto input = ToPolyData(Transform(FlatRectangle(20, 20), { 1, 2, 3 }, 0.3));
  AddPointArray(input, "one", 1, [](const Vec3&, int) { return 1.0; });
  vtkDataArray* one = input->GetPointData()->GetArray("one");
  for (vtkIdType k = 0; k < one->GetNumberOfTuples(); ++k)
  {
    const vtkIdType column = k % 21;
    const vtkIdType row = k / 21;
    one->SetComponent(k, 0, column > 0 && column < 20 && row > 0 && row < 20 ? 1.0 : 0.0);
  }
  for (const int space : { 0, 1 })
  {
    auto filter = MakeFilter(0.1, 4);
    filter->SetInputDataObject(input);
    filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "one");
    filter->SetFunctionSpace(space);
    EXPECT_NEAR(HeightAtPole(DiffusedAt(filter, 4)), 0.9, 0.06); // the mean, nearly even
    filter->BoundaryValuesOn();
    const std::vector<double> held = DiffusedAt(filter, 4);
    // The first term of the series: 16 / π² exp(-2 π² t), others are 1e-3 of it.
    EXPECT_NEAR(HeightAtPole(held), 1.62 * std::exp(-19.74 * 0.1), 0.02);
    EXPECT_NEAR(held[0], 0.0, 1e-5);
    EXPECT_LT(FieldValue(filter->GetOutputDataObject(0), "Misfit"), 1e-4);
  }
  auto filter = MakeFilter(0.1, 1);
  filter->BoundaryValuesOn();
  const Messages messages(filter);
  filter->Update();
  ExpectOne(messages.warnings, "no boundary");
}

TEST(HeatDiffusionFilter, HoldsNoValuesOfCells)
{
  auto input = Input();
  AddPointArray(input, "mask", 1, [](const Vec3& p, int) { return p[2] > 1.0 ? 1.0 : 0.0; });
  vtkNew<vtkDoubleArray> cells;
  cells->SetName("cells");
  cells->SetNumberOfTuples(input->GetNumberOfCells());
  cells->Fill(1.0);
  input->GetCellData()->AddArray(cells);
  auto filter = MakeFilter(0.1, 1);
  filter->SetInputDataObject(input);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "cells");
  filter->SetInputArrayToProcess(2, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "mask");
  ExpectRefused(filter, "'cells' is a cell array");
}
