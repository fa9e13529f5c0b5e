// Principal Curvatures as a user of VTK sees it.
#include "FilterSupport.h"

#include "vtkPrincipalCurvatures.h"

#include <gtest/gtest.h>

#include <limits>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr const char* Names[] = { "MinimumCurvature", "MaximumCurvature", "MeanCurvature",
  "GaussianCurvature", "ShapeIndex", "Bending", "MinimumCurvatureDirection",
  "MaximumCurvatureDirection" };

} // namespace

TEST(PrincipalCurvaturesFilter, WritesAllArraysInWorldUnits)
{
  constexpr double Radius = 20.0;
  for (const double scale : { 0.0, 0.05 })
  {
    vtkNew<vtkPrincipalCurvatures> filter;
    filter->SetInputData(ToPolyData(GeodesicSphere(20, Radius), VTK_FLOAT));
    filter->SetSmoothingScale(scale);
    filter->SetDepth(5);
    filter->Update();
    const double expected[] = { 1.0 / Radius, 1.0 / Radius, 1.0 / Radius, 1.0 / Radius / Radius,
      1.0, 0.5 };
    for (int k = 0; k < 6; ++k)
    {
      for (const double value : PointValues(filter->GetOutput(), Names[k]))
      {
        ASSERT_NEAR(value, expected[k], 0.02 * expected[k]) << Names[k] << " " << scale;
      }
    }
    for (vtkIdType p = 0; p < filter->GetOutput()->GetNumberOfPoints(); ++p)
    {
      vtkPointData* data = filter->GetOutput()->GetPointData();
      const Vec3 a(data->GetArray(Names[6])->GetTuple3(p));
      const Vec3 b(data->GetArray(Names[7])->GetTuple3(p));
      ASSERT_NEAR(a.norm(), 1.0, 1e-12);
      ASSERT_NEAR(a.dot(b), 0.0, 1e-12);
    }
    EXPECT_EQ(filter->GetNumberOfRuns("Space"), scale > 0.0 ? 1 : 0);
  }
}

TEST(PrincipalCurvaturesFilter, FitsAgainOnlyAfterAChange)
{
  const auto sphere = ToPolyData(GeodesicSphere(8));
  vtkNew<vtkPrincipalCurvatures> filter;
  filter->SetInputData(sphere);
  filter->SetDepth(4);
  filter->Update();
  filter->SetDepth(5); // not used
  filter->SetNumberOfThreads(1);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 1);
  filter->SetSmoothingScale(0.1);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 2);
  filter->SetSmoothingScale(0.2);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 3);
  EXPECT_EQ(filter->GetNumberOfRuns("System"), 1);
  EXPECT_TRUE(filter->GetOutput()->GetFieldData()->HasArray("UsedDepth"));
  filter->SetSmoothingScale(0.0);
  filter->SetInputData(ToPolyData(Box(4)));
  filter->Update();
  EXPECT_FALSE(filter->GetOutput()->GetFieldData()->HasArray("UsedDepth"));
  filter->SetSmoothingScale(0.2);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("System"), 2);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), Box(4).points.size());
}

TEST(PrincipalCurvaturesFilter, RefusesWhatItCannotUse)
{
  for (const double scale :
    { -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    vtkNew<vtkPrincipalCurvatures> filter;
    filter->SetInputData(ToPolyData(GeodesicSphere(4)));
    filter->SetSmoothingScale(scale);
    ExpectRefused(filter, "Smoothing Scale");
  }
  for (const double scale : { 0.0, 1e-30, 1e30 })
  {
    TriangleMesh mesh = GeodesicSphere(4);
    vtkNew<vtkPrincipalCurvatures> filter;
    filter->SetInputData(ToPolyData(mesh));
    filter->SetSmoothingScale(scale);
    filter->SetDepth(3);
    const Messages messages(filter);
    filter->Update();
    EXPECT_TRUE(messages.errors.empty());
    for (const char* name : Names)
    {
      EXPECT_TRUE(AllFinite(PointValues(filter->GetOutput(), name))) << name << " " << scale;
    }
    mesh.points[0][0] = std::numeric_limits<double>::quiet_NaN();
    filter->SetInputData(ToPolyData(mesh));
    EXPECT_EQ(filter->GetExecutive()->Update(), 0) << scale;
    EXPECT_TRUE(IsEmptyData(filter->GetOutput()));
  }
  vtkNew<vtkPrincipalCurvatures> filter;
  vtkNew<vtkPolyData> empty;
  filter->SetInputData(empty);
  EXPECT_EQ(filter->GetExecutive()->Update(), 1);
}

TEST(PrincipalCurvaturesFilter, TakesCoincidentPointsAsOne)
{
  const TriangleMesh sphere = Unweld(GeodesicSphere(10));
  vtkNew<vtkPrincipalCurvatures> filter;
  filter->SetInputData(ToPolyData(sphere));
  filter->Update();
  const auto joined = PointValues(filter->GetOutput(), "MaximumCurvature");
  ASSERT_EQ(joined.size(), sphere.points.size());
  for (const double value : joined)
  {
    ASSERT_NEAR(value, 1.0, 1e-9);
  }
  filter->WeldCoincidentPointsOff();
  filter->Update();
  const auto alone = PointValues(filter->GetOutput(), "MaximumCurvature");
  ASSERT_EQ(alone.size(), sphere.points.size());
  for (const double value : alone)
  {
    ASSERT_NEAR(value, 0.0, 1e-9); // every triangle is alone
  }
}
