// Gaussian Field as a user of VTK sees it.
#include "FilterSupport.h"

#include "vtkGaussianField.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

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

/// Adds observations of a wave at every 40th point, NaN at the others.
vtkDoubleArray* AddObservations(vtkPolyData* surface)
{
  vtkDoubleArray* array = AddPointArray(surface, "observed", 1, &Wave);
  for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
  {
    if (point % 40 != 0)
    {
      array->SetValue(point, std::nan(""));
    }
  }
  return array;
}

vtkPolyData* InputOf(vtkGaussianField* filter)
{
  return vtkPolyData::SafeDownCast(filter->GetInputDataObject(0, 0));
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
  ExpectRefused(filter, "Range is 0");
  filter->SetRange(0.01);
  const Messages messages(filter);
  filter->Update();
  ExpectOne(messages.warnings, "Range is only");
}

TEST(GaussianField, PredictsFromObservations)
{
  auto filter = MakeFilter(2);
  vtkPolyData* surface = InputOf(filter);
  vtkDoubleArray* observed = AddObservations(surface);
  filter->SetInputArrayToProcess(0, 0, 0, Points, "observed");
  const std::vector<double> prediction = ArrayOf(filter, "Prediction");
  const std::vector<double> error = ArrayOf(filter, "LeaveOneOutError");
  const std::vector<double> samples[] = { ArrayOf(filter, "Sample000"),
    ArrayOf(filter, "Sample001") };
  std::vector<double> off; // of the prediction
  for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
  {
    const bool isObserved = !std::isnan(observed->GetValue(point));
    ASSERT_EQ(std::isnan(error[point]), !isObserved);
    off.push_back(prediction[point] - Wave(Vec3(surface->GetPoint(point)), 0));
    for (const std::vector<double>& values : { prediction, samples[0], samples[1] })
    {
      if (isObserved)
      {
        ASSERT_NEAR(values[point], observed->GetValue(point), 0.01);
      }
    }
  }
  EXPECT_LT(RootMeanSquare(off), 0.45); // the wave itself has 0.9
  EXPECT_STREQ(filter->GetOutput()->GetPointData()->GetScalars()->GetName(), "Prediction");
  EXPECT_GT(FieldValue(filter->GetOutputDataObject(0), "LeaveOneOutRatio"), 0.0);
  // Other values and another noise need no other covariances.
  filter->SetObservationNoise(0.5);
  EXPECT_NE(ArrayOf(filter, "Prediction"), prediction);
  filter->SetObservationNoise(0.0);
  observed->SetValue(0, 9.0);
  observed->Modified();
  EXPECT_NEAR(ArrayOf(filter, "Prediction")[0], 9.0, 0.05);
  EXPECT_EQ(filter->GetNumberOfRuns("RightHandSide"), 1);
  filter->StatisticsOn();
  EXPECT_LT(ArrayOf(filter, "PredictionStandardDeviation")[40], 0.01);
  EXPECT_FALSE(filter->GetOutput()->GetPointData()->HasArray("Sample000"));
  filter->SetInputArrayToProcess(0, 0, 0, Points, "(None)");
  EXPECT_EQ(ArrayOf(filter, "SampleMean").size(), prediction.size());
  EXPECT_FALSE(filter->GetOutput()->GetPointData()->HasArray("Prediction"));
}

/// A mask, and the points of a second input, give the same observations as NaN at all others.
TEST(GaussianField, TakesObservationsFromAMaskOrFromPlaces)
{
  auto filter = MakeFilter(1);
  vtkPolyData* surface = InputOf(filter);
  vtkDoubleArray* observed = AddObservations(surface);
  filter->SetInputArrayToProcess(0, 0, 0, Points, "observed");
  const std::vector<double> expected = ArrayOf(filter, "Prediction");

  AddPointArray(surface, "all", 1, &Wave);
  vtkDoubleArray* mask = AddPointArray(surface, "mask", 1, [](const Vec3&, int) { return 0.0; });
  vtkNew<vtkPoints> places;
  vtkNew<vtkDoubleArray> values;
  values->SetName("there");
  for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
  {
    if (!std::isnan(observed->GetValue(point)))
    {
      mask->SetValue(point, 1.0);
      places->InsertNextPoint(surface->GetPoint(point));
      values->InsertNextValue(observed->GetValue(point));
    }
  }
  filter->SetInputArrayToProcess(0, 0, 0, Points, "all");
  filter->SetInputArrayToProcess(1, 0, 0, Points, "mask");
  EXPECT_EQ(ArrayOf(filter, "Prediction"), expected);

  vtkNew<vtkPolyData> stations;
  stations->SetPoints(places);
  stations->GetPointData()->SetScalars(values);
  filter->SetInputArrayToProcess(0, 0, 0, Points, "(None)");
  filter->SetInputDataObject(2, stations);
  const std::vector<double> found = ArrayOf(filter, "Prediction");
  for (std::size_t point = 0; point < expected.size(); ++point)
  {
    ASSERT_NEAR(found[point], expected[point], 1e-5); // coordinates of places are floats
  }
}

/// Observations by id are those of places at the points. A point may have several, and each has an
/// error of its own.
TEST(GaussianField, TakesObservationsById)
{
  auto filter = MakeFilter(1);
  filter->SetObservationNoise(0.4);
  filter->SetStandardDeviation(3.0);
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> values;
  for (const auto& [point, value] : { std::pair(vtkIdType(7), 1.0), std::pair(vtkIdType(900), 2.0),
         std::pair(vtkIdType(7), 4.0), std::pair(vtkIdType(7), 2.5) })
  {
    filter->AddObservation(point, value);
    places->InsertNextPoint(InputOf(filter)->GetPoint(point));
    values->InsertNextValue(value);
  }
  EXPECT_EQ(filter->GetNumberOfObservations(), 4);
  const std::vector<double> byId = ArrayOf(filter, "Prediction");
  const std::vector<double> error = ArrayOf(filter, "LeaveOneOutError");
  EXPECT_FALSE(std::isnan(error[7]) || std::isnan(error[900]) || !std::isnan(error[8]));
  vtkNew<vtkPolyData> stations;
  stations->SetPoints(places);
  stations->GetPointData()->SetScalars(values);
  filter->ClearObservations();
  EXPECT_FALSE((filter->Update(), filter->GetOutput()->GetPointData()->HasArray("Prediction")));
  filter->SetInputDataObject(2, stations);
  EXPECT_EQ(ArrayOf(filter, "Prediction"), byId);
  filter->SetInputDataObject(2, nullptr);

  // With a single value there, the mean of the three, the other point has more weight.
  filter->AddObservation(7, 2.5);
  filter->AddObservation(900, 2.0);
  EXPECT_GT(std::abs(ArrayOf(filter, "Prediction")[7] - byId[7]), 1e-3);

  filter->AddObservation(100000, 1.0);
  ExpectRefused(filter, "there is no point 100000");
}

/// Each point of a soup of triangles has several copies. Its value is still one observation.
TEST(GaussianField, CopiesOfAPointAreOneObservation)
{
  const TriangleMesh sphere = GeodesicSphere(8);
  const TriangleMesh soup = Unweld(sphere);
  const auto predict = [](const TriangleMesh& mesh)
  {
    auto filter = MakeFilter(1);
    filter->SetInputDataObject(ToPolyData(mesh));
    filter->SetObservationNoise(0.7);
    AddPointArray(InputOf(filter), "observed", 1,
      [](const Vec3& p, int) { return p[2] > 0.7 || p[2] < -0.8 ? p[0] + p[2] : std::nan(""); });
    filter->SetInputArrayToProcess(0, 0, 0, Points, "observed");
    return std::pair(ArrayOf(filter, "Prediction"), ArrayOf(filter, "LeaveOneOutError"));
  };
  const auto [ofSoup, errorOfSoup] = predict(soup);
  const auto [expected, expectedError] = predict(sphere);
  for (std::size_t point = 0; point < soup.points.size(); ++point)
  {
    const auto same = std::find(sphere.points.begin(), sphere.points.end(), soup.points[point]);
    ASSERT_NE(same, sphere.points.end());
    const std::size_t original = same - sphere.points.begin();
    ASSERT_NEAR(ofSoup[point], expected[original], 1e-5);
    ASSERT_EQ(std::isnan(errorOfSoup[point]), std::isnan(expectedError[original]));
    if (!std::isnan(errorOfSoup[point]))
    {
      ASSERT_NEAR(errorOfSoup[point], expectedError[original], 1e-5);
    }
  }
}

TEST(GaussianField, RefusesObservationsThatItCannotUse)
{
  auto filter = MakeFilter(1);
  vtkPolyData* surface = InputOf(filter);
  AddPointArray(surface, "none", 1, [](const Vec3&, int) { return std::nan(""); });
  AddPointArray(surface, "two", 2, &Wave);
  for (const auto& [name, reason] :
    { std::pair("none", "is known"), std::pair("two", "2 components") })
  {
    filter->SetInputArrayToProcess(0, 0, 0, Points, name);
    ExpectRefused(filter, reason);
  }
}
