// Gaussian Field as a user of VTK sees it.
#include "FilterSupport.h"

#include "vtkGaussianField.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

vtkSmartPointer<vtkGaussianField> MakeFilter(int samples)
{
  auto filter = vtkSmartPointer<vtkGaussianField>::New();
  filter->SetDepth(5);
  filter->SetInputDataObject(ToPolyData(GeodesicSphere(16)));
  filter->SetNumberOfSamples(samples);
  return filter;
}

std::vector<double> ArrayOf(vtkGaussianField* filter, const char* name)
{
  filter->Update();
  return PointValues(filter->GetOutput(), name);
}

double RootMeanSquare(const std::vector<double>& values)
{
  double sum = 0.0;
  for (const double value : values)
  {
    sum += value * value;
  }
  return std::sqrt(sum / double(values.size()));
}

} // namespace

TEST(GaussianField, HasAnArrayForEachSample)
{
  auto filter = MakeFilter(3);
  filter->SetStandardDeviation(5.0);
  const std::vector<double> first = ArrayOf(filter, "Sample000");
  const std::vector<double> last = ArrayOf(filter, "Sample002");
  ASSERT_EQ(first.size(), GeodesicSphere(16).points.size());
  EXPECT_NE(first, last);
  EXPECT_FALSE(filter->GetOutput()->GetPointData()->HasArray("Sample003"));
  EXPECT_STREQ(filter->GetOutput()->GetPointData()->GetScalars()->GetName(), "Sample000");
  EXPECT_EQ(FieldValue(filter->GetOutputDataObject(0), "Converged"), 1);
  EXPECT_NEAR(RootMeanSquare(first), 5.0, 1.5); // some eighty ranges fit on the surface
  filter->SetSeed(2);
  EXPECT_NE(ArrayOf(filter, "Sample000"), first);
  filter->SetSeed(1);
  EXPECT_EQ(ArrayOf(filter, "Sample000"), first);
  EXPECT_EQ(filter->GetNumberOfRuns("Hierarchy"), 1);
}

/// On a sphere every point has the same standard deviation.
TEST(GaussianField, StatisticsHaveMeanAndStandardDeviation)
{
  constexpr int Samples = 100;
  auto filter = MakeFilter(Samples);
  filter->StatisticsOn();
  filter->SetStandardDeviation(2.0);
  const std::vector<double> mean = ArrayOf(filter, "SampleMean");
  const std::vector<double> deviation = ArrayOf(filter, "SampleStandardDeviation");
  EXPECT_FALSE(filter->GetOutput()->GetPointData()->HasArray("Sample000"));
  for (std::size_t i = 0; i < mean.size(); ++i)
  {
    ASSERT_NEAR(mean[i], 0.0, 5.0 * 2.0 / std::sqrt(Samples));
    ASSERT_NEAR(deviation[i], 2.0, 5.0 * 2.0 / std::sqrt(2.0 * Samples) + 0.04);
  }
  EXPECT_NEAR(RootMeanSquare(deviation), 2.0, 0.08);
}

TEST(GaussianField, RefusesNoRangeAndWarnsOfAShortOne)
{
  auto filter = MakeFilter(1);
  filter->SetRange(0.0);
  {
    const Messages messages(filter);
    EXPECT_EQ(filter->GetExecutive()->Update(), 0);
    ASSERT_EQ(messages.errors.size(), 1u);
    EXPECT_NE(messages.errors[0].find("Range is 0"), std::string::npos);
  }
  filter->SetRange(0.01);
  const Messages messages(filter);
  filter->Update();
  ASSERT_EQ(messages.warnings.size(), 1u);
  EXPECT_NE(messages.warnings[0].find("Range is only"), std::string::npos);
}
