// Harmonic Interpolation as a user of VTK sees it.
#include "FilterSupport.h"

#include "vtkConnectivityAwareBasis.h"
#include "vtkHarmonicInterpolation.h"

#include "vtkFloatArray.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <utility>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

vtkSmartPointer<vtkHarmonicInterpolation> Interpolate(vtkPolyData* data, const char* values)
{
  auto filter = vtkSmartPointer<vtkHarmonicInterpolation>::New();
  filter->SetInputData(data);
  filter->SetInputArrayToProcess(0, 0, 0, Points, values);
  filter->SetDepth(5);
  return filter;
}

/// Interpolates an array of places in space.
vtkSmartPointer<vtkHarmonicInterpolation> InterpolateFrom(
  vtkPolyData* places, const char* values, vtkPolyData* surface)
{
  auto filter = Interpolate(surface, "None");
  filter->SetInputData(2, places);
  filter->SetInputArrayToProcess(2, 2, 0, Points, values);
  return filter;
}

/// A ring between the radii 1 and e, flat but turned.
vtkSmartPointer<vtkPolyData> Ring(int around, int across)
{
  TriangleMesh mesh = FlatRectangle(around, across);
  for (Vec3& p : mesh.points)
  {
    const double angle = 2.0 * EIGEN_PI * p[0];
    p = std::exp(p[1]) * Vec3(std::cos(angle), std::sin(angle), 0.0);
  }
  // The ends of the strip meet to rounding.
  for (int j = 0; j <= across; ++j)
  {
    mesh.points[j * (around + 1) + around] = mesh.points[j * (around + 1)];
  }
  return ToPolyData(Transform(mesh, { 1, 2, 3 }, 0.3));
}

/// The filter names what it needs, and passes its input on until then.
void ExpectToBeChosen(
  vtkHarmonicInterpolation* filter, const char* message = "Choose a Value Array")
{
  Messages messages(filter);
  EXPECT_EQ(filter->GetExecutive()->Update(), 1);
  EXPECT_TRUE(messages.errors.empty());
  ExpectOne(messages.warnings, message);
  EXPECT_TRUE(PassesOn(filter, "Interpolated"));
}

class HarmonicInterpolation : public ::testing::TestWithParam<int>
{
};

} // namespace

/// Between two circles the harmonic function is the logarithm of the radius.
TEST_P(HarmonicInterpolation, OfTwoCirclesIsTheLogarithm)
{
  const auto ring = Ring(120, 20);
  AddPointArray(ring, "Known", 1,
    [](const Vec3& p, int)
    {
      const double r = std::log(p.norm());
      return r < 1e-6 || r > 1.0 - 1e-6 ? 3.0 + 2.0 * r : NaN;
    });
  const auto filter = Interpolate(ring, "Known");
  filter->SetFunctionSpace(this->GetParam());
  filter->Update();
  const auto found = PointValues(filter->GetOutput(), "Interpolated");
  double square = 0.0;
  for (vtkIdType k = 0; k < ring->GetNumberOfPoints(); ++k)
  {
    square += std::pow(found[k] - 3.0 - 2.0 * std::log(Vec3(ring->GetPoint(k)).norm()), 2);
  }
  EXPECT_LT(std::sqrt(square / double(found.size())), 0.005); // of a range of 2
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1);
}

/// From the poles of a sphere, the function is log tan of half the polar angle. It is cut off near
/// the poles, where the resolution ends. Its level 0 is the equator.
TEST_P(HarmonicInterpolation, OfTwoPolesIsOddAndMonotonous)
{
  const auto sphere = ToPolyData(GeodesicSphere(24));
  AddPointArray(sphere, "Value", 1, [](const Vec3& p, int) { return p[2]; });
  AddPointArray(
    sphere, "Mask", 1, [](const Vec3& p, int) { return std::abs(p[2]) > 0.9999 ? 1.0 : 0.0; });
  const auto filter = Interpolate(sphere, "Value");
  filter->SetFunctionSpace(this->GetParam());
  filter->SetInputArrayToProcess(1, 0, 0, Points, "Mask");
  filter->Update();
  const auto found = PointValues(filter->GetOutput(), "Interpolated");
  const auto known = PointValues(sphere, "Value");
  double scale = 0.0; // of log((1 + z) / (1 - z)), by least squares
  double size = 0.0;
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    if (std::abs(known[k]) < 0.8)
    {
      const double exact = std::log((1.0 + known[k]) / (1.0 - known[k]));
      scale += exact * found[k];
      size += exact * exact;
    }
  }
  scale /= size;
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    EXPECT_LE(std::abs(found[k]), 1.0 + 1e-6);
    if (std::abs(known[k]) > 0.9999)
    {
      EXPECT_NEAR(found[k], known[k], 2e-6);
    }
    if (std::abs(known[k]) < 0.8)
    {
      EXPECT_NEAR(found[k], scale * std::log((1.0 + known[k]) / (1.0 - known[k])), 0.01);
    }
  }
}

/// x, y and z are eigenfunctions on a sphere. The biharmonic function through samples of one comes
/// near it. A harmonic one does not.
TEST_P(HarmonicInterpolation, BiharmonicFunctionsFollowSmoothOnes)
{
  const auto sphere = ToPolyData(Transform(GeodesicSphere(24), { 1, 2, 3 }, 0.2));
  AddPointArray(sphere, "Value", 2, [](const Vec3& p, int c) { return 1.0 + p[c]; });
  auto* mask = AddPointArray(sphere, "Mask", 1, [](const Vec3&, int) { return 0.0; });
  for (vtkIdType k = 0; k < sphere->GetNumberOfPoints(); k += 47)
  {
    mask->SetValue(k, 1.0);
  }
  double error[2];
  for (const int smoothness : { 0, 1 })
  {
    const auto filter = Interpolate(sphere, "Value");
    filter->SetFunctionSpace(this->GetParam());
    filter->SetInputArrayToProcess(1, 0, 0, Points, "Mask");
    filter->SetSmoothness(smoothness);
    filter->SetTolerance(1e-8);
    filter->Update();
    const auto found = PointValues(filter->GetOutput(), "Interpolated");
    error[smoothness] = Difference(found, PointValues(sphere, "Value"));
    EXPECT_LT(FieldValue(filter->GetOutput(), "Misfit"), 2e-4);
  }
  EXPECT_GT(error[0], 0.1);
  EXPECT_LT(error[1], 0.05);
}

/// Uses more points than are solved for at once.
TEST_P(HarmonicInterpolation, BiharmonicFunctionsGoThroughManyPoints)
{
  const auto sphere = ToPolyData(GeodesicSphere(16));
  AddPointArray(sphere, "Value", 1, [](const Vec3& p, int) { return p[0] * p[1]; });
  vtkIdType point = 0;
  AddPointArray(sphere, "Mask", 1, [&](const Vec3&, int) { return double(point++ % 3 == 0); });
  const auto filter = Interpolate(sphere, "Value");
  filter->SetFunctionSpace(this->GetParam());
  filter->SetInputArrayToProcess(1, 0, 0, Points, "Mask");
  filter->SetSmoothness(vtkHarmonicInterpolation::Biharmonic);
  Messages messages(filter);
  filter->Update();
  EXPECT_EQ(messages.warnings.size() + messages.errors.size(), 0u);
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1);
  EXPECT_LT(FieldValue(filter->GetOutput(), "Misfit"), 1e-6);
  const auto found = PointValues(filter->GetOutput(), "Interpolated");
  EXPECT_LT(Difference(found, PointValues(sphere, "Value")), 0.02);
}

TEST_P(HarmonicInterpolation, TakesPointsOfAnotherDataSet)
{
  const auto sphere = ToPolyData(GeodesicSphere(12));
  AddPointArray(sphere, "Value", 3, [](const Vec3& p, int c) { return p[c]; });
  AddPointArray(sphere, "Mask", 1,
    [](const Vec3& p, int) { return p.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() > 0.9999; });
  const auto by_mask = Interpolate(sphere, "Value");
  by_mask->SetInputArrayToProcess(1, 0, 0, Points, "Mask");
  by_mask->SetFunctionSpace(this->GetParam());
  by_mask->Update();

  vtkNew<vtkPolyData> places; // near the six corners, off the surface
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> color;
  color->SetName("Color");
  color->SetNumberOfComponents(3);
  for (const double part : { 0.5, NaN }) // NaN is unknown, in one component or in all
  {
    points->InsertNextPoint(1.0, 1.0, part < 1.0 ? -1.0 : 1.0);
    color->InsertNextTuple3(part, NaN, part);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double sign : { -1.0, 1.0 })
    {
      const Vec3 p = sign * Vec3::Unit(axis);
      points->InsertNextPoint((1.3 * p).eval().data());
      color->InsertNextTuple(p.data());
    }
  }
  places->SetPoints(points);
  places->GetPointData()->AddArray(color);
  const auto by_place = InterpolateFrom(places, "Color", sphere);
  by_place->SetFunctionSpace(this->GetParam());
  by_place->Update();
  EXPECT_LT(Difference(PointValues(by_place->GetOutput(), "Interpolated"),
              PointValues(by_mask->GetOutput(), "Interpolated")),
    1e-6); // in single precision

  color->Fill(NaN);
  color->Modified();
  ExpectRefused(by_place, "all are NaN");
}

INSTANTIATE_TEST_SUITE_P(BothSpaces, HarmonicInterpolation,
  ::testing::Values(int(vtkSurfaceFEMAlgorithm::Grid), int(vtkSurfaceFEMAlgorithm::HatFunctions)));

TEST(HarmonicInterpolationFilter, LeavesComponentsWithoutAValueAndSaysSo)
{
  const TriangleMesh one = GeodesicSphere(6);
  const auto data = ToPolyData(Join(one, Transform(one, { 1, 0, 0 }, 0.0, 1.0, { 5.0, 0.0, 0.0 })));
  AddPointArray(data, "Value", 1, [](const Vec3& p, int) { return p[0] < 2 ? p[1] : NaN; });
  const auto filter = Interpolate(data, "Value");
  Messages messages(filter);
  filter->Update();
  ExpectOne(messages.warnings, "1 of 2 connected");
  const auto found = PointValues(filter->GetOutput(), "Interpolated");
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    ASSERT_EQ(std::isnan(found[k]), k >= one.points.size());
  }
}

TEST(HarmonicInterpolationFilter, SaysWhereValuesContradictEachOther)
{
  const auto sphere = ToPolyData(GeodesicSphere(8));
  vtkNew<vtkPolyData> places;
  vtkNew<vtkPoints> points;
  const double north[3] = { 0, 0, 1 };
  const double above[3] = { 0, 0, 1.1 };
  const double south[3] = { 0, 0, -1 };
  points->InsertNextPoint(north);
  points->InsertNextPoint(above);
  points->InsertNextPoint(south);
  places->SetPoints(points);
  auto* value = AddPointArray(places, "Value", 1, [](const Vec3&, int) { return 0.0; });
  value->SetValue(0, 1.0);
  value->SetValue(1, 3.0);
  const auto filter = InterpolateFrom(places, "Value", sphere);
  Messages messages(filter);
  filter->Update();
  ExpectOne(messages.warnings, "contradict");
  EXPECT_NEAR(FieldValue(filter->GetOutput(), "Misfit"), 1.0, 1e-3);
}

TEST(HarmonicInterpolationFilter, WarnsOfValuesFarFromTheSurface)
{
  vtkNew<vtkPolyData> places;
  vtkNew<vtkPoints> points;
  for (const double height : { 1.0, -1.01, 500.0 })
  {
    points->InsertNextPoint(0.0, 0.0, height);
  }
  places->SetPoints(points);
  AddPointArray(places, "Value", 1, [](const Vec3&, int) { return 2.0; });
  const auto filter = InterpolateFrom(places, "Value", ToPolyData(GeodesicSphere(8)));
  Messages messages(filter);
  filter->Update();
  ExpectOne(messages.warnings, "Values: 1 of its 3 points is farther than",
    "The farthest is point 2, at 499");
}

TEST(HarmonicInterpolationFilter, RefusesScalarsOfAnotherLengthThanThePlaces)
{
  TriangleMesh places;
  places.points = { Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ() };
  const auto values = ToPolyData(places);
  AddPointArray(values, "Height", 1, [](const Vec3& p, int) { return p[2]; });
  values->GetPointData()->SetActiveScalars("Height");
  values->GetPointData()->GetScalars()->SetNumberOfTuples(2);
  const auto filter = Interpolate(ToPolyData(GeodesicSphere(8)), "None");
  filter->SetInputData(2, values);
  ExpectRefused(filter, "In the input Values, the Value Array 'Height' has 2 values", "3 points");
}

/// Places have more colors than the surface has points, so a color would be found for each point.
TEST(HarmonicInterpolationFilter, LeavesColorsOfPlacesBlackWhereNoneArrives)
{
  const TriangleMesh one = GeodesicSphere(4);
  const auto data = ToPolyData(Join(one, Transform(one, { 1, 0, 0 }, 0.0, 1.0, { 50.0, 0, 0 })));
  const auto places = ToPolyData(GeodesicSphere(12));
  for (const char* name : { "Color", "Other" })
  {
    vtkNew<vtkUnsignedCharArray> color;
    color->SetName(name);
    color->SetNumberOfComponents(3);
    color->SetNumberOfTuples(places->GetNumberOfPoints());
    color->Fill(200);
    places->GetPointData()->AddArray(color);
  }
  const auto filter = InterpolateFrom(places, "Color", data);
  filter->AddFurtherArray("Other");
  filter->Update();
  for (const char* name : { "Interpolated", "Other_Interpolated" })
  {
    const auto found = PointValues(filter->GetOutput(), name);
    ASSERT_EQ(found.size(), 6 * one.points.size());
    for (std::size_t k = 0; k < found.size(); ++k)
    {
      ASSERT_EQ(found[k], k < 3 * one.points.size() ? 200 : 0) << name << k;
    }
  }
}

TEST(HarmonicInterpolationFilter, FindsTheNearestPointOfAnyFinitePlace)
{
  const auto sphere = ToPolyData(GeodesicSphere(8));
  const Vec3 axes[3] = { Vec3::UnitX(), -Vec3::UnitY(), Vec3::UnitZ() };
  for (const double far : { 1e3, 1e18, 1e100, 1e154, 1e300 })
  {
    TriangleMesh places;
    for (const Vec3& axis : axes)
    {
      places.points.push_back(far * axis);
    }
    const auto values = ToPolyData(places);
    AddPointArray(
      values, "Value", 1, [](const Vec3& p, int) { return p[0] - p[1] > 0.0 ? 1.0 : 2.0; });
    const auto filter = InterpolateFrom(values, "Value", sphere);
    Messages messages(filter);
    filter->Update();
    ExpectOne(messages.warnings, "Values: 3 of its 3 points are farther than");
    EXPECT_LT(FieldValue(filter->GetOutput(), "Misfit"), 1e-5) << far;
    auto* interpolated = filter->GetOutput()->GetPointData()->GetScalars();
    for (vtkIdType point = 0; point < sphere->GetNumberOfPoints(); ++point)
    {
      const Vec3 at(sphere->GetPoint(point));
      for (const Vec3& axis : axes)
      {
        if ((at - axis).norm() < 1e-6)
        {
          EXPECT_NEAR(interpolated->GetTuple1(point), axis[2] > 0.0 ? 2.0 : 1.0, 1e-5) << far;
        }
      }
    }
  }
}

TEST(HarmonicInterpolationFilter, RunsOnlyWhatHasChangedAndTakesASharedBasis)
{
  const auto sphere = ToPolyData(GeodesicSphere(12));
  auto* value =
    AddPointArray(sphere, "Value", 1, [](const Vec3& p, int) { return p[2] > 0.9 ? p[0] : NaN; });
  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetInputData(sphere);
  basis->SetDepth(4);
  const auto filter = Interpolate(sphere, "Value");
  filter->SetBasisConnection(basis->GetOutputPort());
  filter->Update();
  filter->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 1);
  value->SetValue(0, 7.0);
  value->Modified();
  filter->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 2);
  EXPECT_EQ(filter->GetNumberOfRuns("Space"), 1);
}

/// The first Apply finds the array. With a second array of the kind, one has to be chosen.
TEST(HarmonicInterpolationFilter, TakesTheOnlyArrayThatIsKnownInPart)
{
  const auto sphere = ToPolyData(GeodesicSphere(8));
  const auto cap = [](const Vec3& p, int) { return p[2] > 0.5 ? p[0] : NaN; };
  AddPointArray(sphere, "Everywhere", 1, [](const Vec3& p, int) { return p[2]; });
  AddPointArray(sphere, "Nowhere", 1, [](const Vec3&, int) { return NaN; });
  AddPointArray(sphere, "Known", 1, cap);
  const auto chosen = Interpolate(sphere, "Known");
  chosen->Update();
  const auto filter = Interpolate(sphere, "None");
  filter->Update();
  EXPECT_EQ(PointValues(filter->GetOutput(), "Interpolated"),
    PointValues(chosen->GetOutput(), "Interpolated"));

  AddPointArray(sphere, "Other", 1, cap);
  sphere->Modified();
  ExpectToBeChosen(filter);
}

/// A table of points and values gives the bits of an array with the same values. Rows whose point
/// is not on the surface are named and left out, and an array that can be taken goes first.
TEST(HarmonicInterpolationFilter, TakesATableOfPointsAndValues)
{
  const std::array<std::pair<vtkIdType, double>, 4> rows = { { { 0, -1.0 }, { 50, 3.0 },
    { 51, 2.5 }, { 200, 0.5 } } };
  const auto sphere = ToPolyData(GeodesicSphere(8));
  const auto known = ToPolyData(GeodesicSphere(8));
  AddPointArray(known, "Known", 1, [](const Vec3&, int) { return NaN; });
  const auto filter = Interpolate(sphere, "None");
  for (const auto& [point, value] : rows)
  {
    known->GetPointData()->GetArray("Known")->SetComponent(point, 0, value);
    filter->AddKnownValue(static_cast<double>(point), value);
  }
  const auto expected = Interpolate(known, "Known");
  expected->Update();
  filter->Update();
  EXPECT_EQ(PointValues(filter->GetOutput(), "Interpolated"),
    PointValues(expected->GetOutput(), "Interpolated"));

  Messages messages(filter);
  filter->AddKnownValue(1e6, 9.0);
  filter->AddKnownValue(3.5, 9.0);
  filter->AddKnownValue(-1.0, 9.0);
  EXPECT_EQ(filter->GetExecutive()->Update(), 1);
  ExpectOne(messages.warnings, "1e+06, 3.5, -1");
  EXPECT_EQ(PointValues(filter->GetOutput(), "Interpolated"),
    PointValues(expected->GetOutput(), "Interpolated"));

  filter->SetInputData(known);
  filter->ClearKnownValues();
  filter->AddKnownValue(7.0, 70.0);
  filter->Update();
  EXPECT_EQ(PointValues(filter->GetOutput(), "Interpolated"),
    PointValues(expected->GetOutput(), "Interpolated"));
}

TEST(HarmonicInterpolationFilter, NeedsAPointOfTheSurfaceInItsTable)
{
  const auto sphere = ToPolyData(GeodesicSphere(8));
  ExpectToBeChosen(Interpolate(sphere, "None"));
  const auto outside = Interpolate(sphere, "None");
  outside->AddKnownValue(-2.0, 1.0);
  ExpectToBeChosen(outside, "No point of Known Values is on the surface");

  const auto infinite = Interpolate(sphere, "None");
  infinite->AddKnownValue(2.0, NaN);
  ExpectRefused(infinite, "not finite");
}

/// Freeing the stages, as for less memory, keeps the table.
TEST(HarmonicInterpolationFilter, KeepsItsTable)
{
  const auto filter = Interpolate(ToPolyData(GeodesicSphere(8)), "None");
  filter->AddKnownValue(0.0, 1.0);
  filter->AddKnownValue(9.0, 2.0);
  filter->ReleaseDataFlagOn();
  filter->Update();
  const auto first = PointValues(filter->GetOutput(), "Interpolated");
  filter->Modified();
  filter->Update();
  EXPECT_EQ(PointValues(filter->GetOutput(), "Interpolated"), first);
  EXPECT_EQ(filter->GetNumberOfKnownValues(), 2);
}

TEST(HarmonicInterpolationFilter, RefusesWhatItCannotUse)
{
  const auto sphere = ToPolyData(GeodesicSphere(8));
  AddPointArray(sphere, "Value", 1, [](const Vec3& p, int) { return p[2]; });
  AddPointArray(sphere, "Nothing", 1, [](const Vec3&, int) { return NaN; });
  AddPointArray(
    sphere, "Infinite", 1, [](const Vec3& p, int) { return 1.0 / std::max(p[2], 0.0); });
  AddPointArray(sphere, "Vector", 3, [](const Vec3& p, int c) { return p[c]; });
  AddPointArray(sphere, "Zero", 1, [](const Vec3&, int) { return 0.0; });
  const auto expectRefused = [&](const char* values, const char* mask, const char* reason)
  {
    const auto filter = Interpolate(sphere, values);
    filter->SetInputArrayToProcess(1, 0, 0, Points, mask);
    ExpectRefused(filter, reason);
  };
  ExpectToBeChosen(Interpolate(sphere, "None"));
  expectRefused("Nothing", "None", "all are NaN");
  expectRefused("Infinite", "None", "not finite");
  expectRefused("Value", "Zero", "masked");
  expectRefused("Value", "Vector", "one component");

  vtkNew<vtkPolyData> nothing;
  vtkNew<vtkPoints> points;
  nothing->SetPoints(points);
  AddPointArray(nothing, "Value", 1, [](const Vec3&, int) { return 0.0; });
  const auto filter = Interpolate(sphere, "Value");
  filter->SetInputData(2, nothing);
  filter->SetInputArrayToProcess(2, 2, 0, Points, "Value");
  ExpectRefused(filter, "no points");
}
