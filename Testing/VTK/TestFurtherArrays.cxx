// Tests that several arrays in one run have the results that each of them has alone.

#include "FilterSupport.h"

#include "vtkFloatArray.h"
#include "vtkHarmonicInterpolation.h"
#include "vtkHeatDiffusion.h"
#include "vtkScreenedPoisson.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// Copies an array to another type.
template<class Array>
void Convert(vtkPolyData* surface, const char* name)
{
  vtkDataArray* given = surface->GetPointData()->GetArray(name);
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(given->GetNumberOfComponents());
  array->SetNumberOfTuples(given->GetNumberOfTuples());
  for (int c = 0; c < given->GetNumberOfComponents(); ++c)
  {
    array->CopyComponent(c, given, c);
  }
  surface->GetPointData()->AddArray(array);
}

/// A sphere with arrays of different types and sizes, which are known at one point in three, and
/// with cell arrays.
vtkSmartPointer<vtkPolyData> MakeSurface(bool isKnownEverywhere)
{
  auto surface = ToPolyData(GeodesicSphere(3));
  int point = 0;
  const auto known = [&](double value)
  { return isKnownEverywhere || point++ % 3 == 0 ? value : NaN; };
  AddPointArray(
    surface, "small", 1, [&](const Vec3& p, int c) { return known(1e-3 * Wave(p, c)); });
  point = 0;
  AddPointArray(surface, "large", 1, [&](const Vec3& p, int) { return known(1e5 * p[2]); });
  AddPointArray(surface, "vectors", 3, [](const Vec3& p, int c) { return Wave(p, c); });
  AddPointArray(surface, "colors", 3, [](const Vec3& p, int c) { return 128 + 60 * Wave(p, c); });
  Convert<vtkFloatArray>(surface, "vectors");
  Convert<vtkUnsignedCharArray>(surface, "colors");
  for (const char* name : { "on cells", "more on cells" })
  {
    vtkNew<vtkDoubleArray> cells;
    cells->SetName(name);
    for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
    {
      cells->InsertNextValue(std::sin(0.01 * double(cell)) + (name[0] == 'm' ? 1.0 : 0.0));
    }
    surface->GetCellData()->AddArray(cells);
  }
  return surface;
}

template<class Filter>
vtkSmartPointer<Filter> Make(vtkPolyData* surface, const char* array, int association = Points)
{
  auto filter = vtkSmartPointer<Filter>::New();
  filter->SetDepth(4);
  filter->SetInputDataObject(surface);
  filter->SetInputArrayToProcess(0, 0, 0, association, array);
  return filter;
}

double RangeOf(const std::vector<double>& values)
{
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most - *least;
}

/// Compares a result with the result of the array alone.
template<class Filter>
void ExpectAsAlone(Filter* all, vtkPolyData* surface, const char* array, const std::string& name,
  const char* nameAlone, int association = Points)
{
  auto alone = Make<Filter>(surface, array, association);
  alone->Update();
  vtkDataArray* result = all->GetOutput()->GetPointData()->GetArray(name.c_str());
  vtkDataArray* expected = alone->GetOutput()->GetPointData()->GetArray(nameAlone);
  ASSERT_NE(result, nullptr) << name;
  ASSERT_NE(expected, nullptr) << array;
  EXPECT_EQ(result->GetDataType(), expected->GetDataType()) << name;
  const std::vector<double> values = Values(expected);
  // The smoother sums several columns in another order, in single precision.
  EXPECT_LE(Difference(Values(result), values),
    (result->GetDataType() == VTK_DOUBLE ? 1e-9 : 1e-6) * RangeOf(values))
    << name;
}

template<class Filter>
void ExpectAllAsAlone(vtkPolyData* surface, const char* result)
{
  auto filter = Make<Filter>(surface, "small");
  for (const char* further : { "large", "vectors", "colors" })
  {
    if (surface->GetPointData()->HasArray(further))
    {
      filter->AddFurtherArray(further);
    }
  }
  filter->Update();
  ExpectAsAlone<Filter>(filter, surface, "small", result, result);
  EXPECT_STREQ(filter->GetOutput()->GetPointData()->GetScalars()->GetName(), result);
  for (const char* further : { "large", "vectors", "colors" })
  {
    if (surface->GetPointData()->HasArray(further))
    {
      ExpectAsAlone<Filter>(filter, surface, further, std::string(further) + "_" + result, result);
    }
  }
}

TEST(FurtherArrays, AreSmoothedAsAlone)
{
  ExpectAllAsAlone<vtkHeatDiffusion>(MakeSurface(true), "Diffused");
}

TEST(FurtherArrays, AreSolvedForAsAlone)
{
  ExpectAllAsAlone<vtkScreenedPoisson>(MakeSurface(true), "Solution");
}

TEST(FurtherArrays, AreInterpolatedAsAlone)
{
  auto surface = MakeSurface(false);
  surface->GetPointData()->RemoveArray("vectors"); // known at other points
  surface->GetPointData()->RemoveArray("colors");
  ExpectAllAsAlone<vtkHarmonicInterpolation>(surface, "Interpolated");
}

TEST(FurtherArrays, AreFoundAmongTheArraysOfThePlaces)
{
  auto places = MakeSurface(true);
  auto surface = ToPolyData(GeodesicSphere(4));
  auto run = [&](const char* array, const char* further)
  {
    auto filter = Make<vtkHarmonicInterpolation>(surface, array);
    filter->SetInputDataObject(2, places);
    filter->AddFurtherArray(further); // null: none
    filter->Update();
    return filter;
  };
  auto both = run("small", "large");
  EXPECT_LE(Difference(PointValues(both->GetOutput(), "large_Interpolated"),
              PointValues(run("large", nullptr)->GetOutput(), "Interpolated")),
    1e-9 * 2e5);
  EXPECT_LE(Difference(PointValues(both->GetOutput(), "Interpolated"),
              PointValues(run("small", nullptr)->GetOutput(), "Interpolated")),
    1e-9 * 4e-3);
}

TEST(FurtherArrays, AreOfCellsIfTheFirstIs)
{
  auto surface = MakeSurface(true);
  AddPointArray(surface, "more on cells", 1, [](const Vec3& p, int) { return p[0]; });
  auto filter = Make<vtkScreenedPoisson>(surface, "on cells", Cells);
  filter->AddFurtherArray("more on cells");
  filter->Update();
  ExpectAsAlone<vtkScreenedPoisson>(
    filter, surface, "more on cells", "more on cells_Solution", "Solution", Cells);
}

TEST(FurtherArrays, OfAnotherKindAreRefused)
{
  auto filter = Make<vtkHeatDiffusion>(MakeSurface(true), "small");
  filter->AddFurtherArray("on cells");
  ExpectRefused(filter, "As point data, the Further Array 'on cells' does not exist.");
}

TEST(FurtherArrays, KnownAtOtherPointsAreRefused)
{
  for (const bool fills : { true, false })
  {
    auto surface = MakeSurface(false);
    surface->GetPointData()->GetArray("large")->SetComponent(30, 0, NaN);
    vtkSmartPointer<vtkSurfaceFEMAlgorithm> filter;
    if (fills)
    {
      auto poisson = Make<vtkScreenedPoisson>(surface, "small");
      poisson->SetFillUnknown(true);
      poisson->AddFurtherArray("large");
      filter = poisson;
    }
    else
    {
      auto interpolation = Make<vtkHarmonicInterpolation>(surface, "small");
      interpolation->AddFurtherArray("large");
      filter = interpolation;
    }
    ExpectRefused(
      filter, "Some of the arrays 'small', 'large' are NaN at point 30 and some are not.");
  }
}

TEST(FurtherArrays, NeedAFirstOne)
{
  auto filter = Make<vtkHeatDiffusion>(MakeSurface(true), "");
  filter->AddFurtherArray("large");
  ExpectRefused(filter, "Choose the Array, too.");
}

TEST(FurtherArrays, MayBeActiveAttributes)
{
  auto surface = MakeSurface(true);
  surface->GetPointData()->SetActiveScalars("large");
  auto filter = Make<vtkHeatDiffusion>(surface, "small");
  filter->SetInputArrayToProcess(10, 0, 0, Points, vtkDataSetAttributes::SCALARS);
  filter->Update();
  ExpectAsAlone<vtkHeatDiffusion>(filter, surface, "large", "large_Diffused", "Diffused");
}

TEST(FurtherArrays, ThatAreNotChosenAreRefused)
{
  auto filter = Make<vtkHeatDiffusion>(MakeSurface(true), "small");
  filter->SetInputArrayToProcess(11, 0, 0, Points, "large");
  ExpectRefused(filter, "The Further Array 1 is not chosen");
  filter->SetInputArrayToProcess(10, 0, 0, Points, "None");
  ExpectRefused(filter, "The Further Array 1 is not chosen");
  filter->SetInputArrayToProcess(10, 0, 0, Points, vtkDataSetAttributes::TENSORS);
  ExpectRefused(filter, "the Further Array '' does not exist");
}

TEST(FurtherArrays, RunStagesAgainOnlyIfTheyChange)
{
  auto surface = MakeSurface(true);
  auto filter = Make<vtkHeatDiffusion>(surface, "small");
  filter->SetNumberOfSteps(3);
  filter->AddFurtherArray("large");
  filter->UpdateTimeStep(3.0);
  const vtkIdType solves = filter->GetNumberOfRuns("Solve");
  filter->UpdateTimeStep(2.0);
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), solves);
  const std::vector<double> before = PointValues(filter->GetOutput(), "large_Diffused");
  surface->GetPointData()->GetArray("large")->SetComponent(0, 0, 0.0);
  surface->GetPointData()->GetArray("large")->Modified();
  surface->Modified();
  filter->UpdateTimeStep(2.0);
  EXPECT_GT(Difference(PointValues(filter->GetOutput(), "large_Diffused"), before), 1.0);
  EXPECT_EQ(filter->GetNumberOfRuns("Hierarchy"), 1);

  filter->ClearFurtherArrays();
  filter->UpdateTimeStep(2.0);
  EXPECT_FALSE(filter->GetOutput()->GetPointData()->HasArray("large_Diffused"));
  EXPECT_TRUE(filter->GetOutput()->GetPointData()->HasArray("Diffused"));
}

} // namespace
