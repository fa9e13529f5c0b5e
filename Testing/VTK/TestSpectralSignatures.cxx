// Tests Spectral Signatures: on a sphere against exact series, on modes from Laplace Spectrum, and
// refusals.

#include "Largest.h"
#include "Spectra.h"

#include "Grid/TriangleMesh.h"

#include "vtkSpectralSignatures.h"

#include "vtkTable.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

using Signatures = vtkSpectralSignatures;

class SpectralSignaturesFilter : public ::testing::Test
{
protected:
  SpectralSignaturesFilter() : messages(filter)
  {
    filter->SetDepth(5);
    filter->SetNumberOfModes(25);
    filter->SetNumberOfScales(4);
    filter->SetInputData(ToPolyData(sphere));
  }

  std::vector<double> Run(const char* name)
  {
    filter->Update();
    return PointValues(filter->GetOutput(), name);
  }

  const TriangleMesh sphere = GeodesicSphere(16);
  vtkNew<Signatures> filter;
  Messages messages;
};

/// Checks the first point. The test of the solver checks all points.
TEST_F(SpectralSignaturesFilter, TheHeatKernelOfASphereIsItsSeries)
{
  const auto signature = this->Run("HeatKernelSignature");
  const auto times = Values(filter->GetOutput()->GetFieldData()->GetArray("HeatTimes"));
  ASSERT_EQ(times.size(), 4u);
  ASSERT_EQ(signature.size(), 4 * sphere.points.size());
  for (int k = 0; k < 4; ++k)
  {
    double series = 0.0;
    for (int l = 0; l < 5; ++l)
    {
      series += (2 * l + 1) * std::exp(-l * (l + 1) * times[k]);
    }
    // 1,000 flat triangles and cells of 1/16 of the radius: 2 % for the fourth degree.
    EXPECT_NEAR(signature[k], series, 0.02 * series);
  }
  EXPECT_NEAR(this->Run("WaveKernelSignature").at(0), 1.0, 0.02);
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1);
  EXPECT_TRUE(messages.warnings.empty());
}

TEST_F(SpectralSignaturesFilter, ModesOfTheInputAreTaken)
{
  const auto own = this->Run("HeatKernelSignature");
  filter->SetInputData(WithModes(ToPolyData(sphere), 25));
  const vtkIdType runs = filter->GetNumberOfRuns("Solve");
  filter->SetNumberOfModes(7); // not used
  EXPECT_LT(Difference(this->Run("HeatKernelSignature"), own), 1e-6);
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), runs);
}

/// A triangle is divided at a hanging node if seams are joined. Integrals of values then differ.
TEST_F(SpectralSignaturesFilter, CarriedModesAreReadAgainIfSeamsAreNoLongerJoined)
{
  TriangleMesh mesh = GeodesicSphere(3);
  const auto [a, b, c] = mesh.triangles[0];
  const auto middle = static_cast<Id>(mesh.points.size());
  mesh.points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
  mesh.triangles[0] = { a, middle, c };
  mesh.triangles.push_back({ middle, b, c });
  const auto surface = WithModes(ToPolyData(mesh), 9, 4);
  AddPointArray(surface, "f", 1, Wave);
  surface->GetPointData()->GetArray("f")->SetComponent(middle, 0, 9.0);
  const auto run = [&](Signatures* signatures, bool welds)
  {
    signatures->SetInputData(surface);
    signatures->SetInputArrayToProcess(0, 0, 0, Points, "f");
    signatures->SetFilterType(Signatures::LowPass);
    signatures->SetLastMode(5);
    signatures->SetWeldCoincidentPoints(welds);
    signatures->Update();
    EXPECT_EQ(signatures->GetNumberOfRuns("Solve"), 0);
    return PointValues(signatures->GetOutput(), "Filtered");
  };
  const auto joined = run(filter, true);
  const auto apart = run(filter, false);
  EXPECT_GT(Difference(joined, apart), 1e-3);
  EXPECT_EQ(apart, run(vtkNew<Signatures>(), false));
  EXPECT_TRUE(messages.errors.empty() && messages.warnings.empty());
}

TEST_F(SpectralSignaturesFilter, AModeThatIsMissingIsNamed)
{
  auto data = WithModes(ToPolyData(sphere), 25);
  data->GetPointData()->RemoveArray("Mode017");
  filter->SetInputData(data);
  ExpectRefused(filter, "Mode017");
}

TEST_F(SpectralSignaturesFilter, TheLastMultipletIsCompleted)
{
  filter->SetNumberOfModes(11);
  filter->Update();
  auto* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
  EXPECT_EQ(table->GetNumberOfRows(), 16);
}

TEST_F(SpectralSignaturesFilter, ShapeDNADoesNotDependOnSizeAndPlace)
{
  const auto fingerprint = [&](const TriangleMesh& mesh)
  {
    filter->SetInputData(ToPolyData(mesh));
    filter->Update();
    return Column(filter, "ShapeDNA");
  };
  const auto plain = fingerprint(sphere);
  const double area = SurfaceArea(sphere);
  for (int k = 1; k < 4; ++k)
  {
    EXPECT_NEAR(plain[k], 2 * area, 0.01 * 2 * area); // 1 % for the first degree
  }
  const auto scaled = fingerprint(Transform(sphere, { 0, 0, 1 }, 0.0, 8.0, { 3, 0, 0 }));
  // The turned surface lies in the grid in another way. An eigenvalue changes by its error.
  const auto turned = fingerprint(Transform(sphere, { 1, 2, 3 }, 0.5));
  for (std::size_t k = 1; k < plain.size(); ++k)
  {
    EXPECT_NEAR(scaled[k] / plain[k], 1.0, 1e-6); // the tolerance of the eigenvalues
    EXPECT_NEAR(turned[k] / plain[k], 1.0, 0.01);
  }
}

TEST_F(SpectralSignaturesFilter, DistancesStartAtTheSources)
{
  EXPECT_TRUE(this->Run("BiharmonicDistance").empty()); // no source, no distance
  filter->AddSourcePointId(7);
  const auto one = this->Run("BiharmonicDistance");
  EXPECT_EQ(one[7], 0.0);
  EXPECT_EQ(this->Run("DiffusionDistance")[7], 0.0);
  // The farthest point is the antipode: d² = Σ (2l + 1) / 4π 2 / (l (l + 1))² over odd l.
  const double exact = std::sqrt((3.0 / 4 + 7.0 / 144) * 4 / (4 * 3.14159265358979));
  EXPECT_NEAR(*std::max_element(one.begin(), one.end()), exact, 0.02 * exact);
  filter->ClearSourcePointIds();
  filter->AddSourcePointId(50);
  EXPECT_EQ(this->Run("BiharmonicDistance")[7], one[50]); // symmetric
}

TEST_F(SpectralSignaturesFilter, SourcesAreThePointsNearestToThoseOfTheThirdInput)
{
  filter->AddSourcePointId(7);
  const auto expected = this->Run("BiharmonicDistance");
  filter->ClearSourcePointIds();
  vtkNew<vtkPolyData> place;
  vtkNew<vtkPoints> points;
  const Vec3 near = 1.1 * sphere.points[7];
  points->InsertNextPoint(near.data());
  place->SetPoints(points);
  filter->SetInputDataObject(2, place);
  EXPECT_EQ(this->Run("BiharmonicDistance"), expected);
}

TEST_F(SpectralSignaturesFilter, ASourceThatIsNoPointIsRefused)
{
  filter->AddSourcePointId(vtkIdType(sphere.points.size()));
  ExpectRefused(filter, "Source Point Ids");
}

TEST_F(SpectralSignaturesFilter, SourcesThatAreNowhereAreRefusedByName)
{
  for (const double wrong : { double(NAN), double(INFINITY) })
  {
    vtkNew<vtkPolyData> places;
    vtkNew<vtkPoints> points;
    points->InsertNextPoint(1, 0, 0);
    points->InsertNextPoint(0, wrong, 0);
    places->SetPoints(points);
    filter->SetInputDataObject(2, places);
    ExpectRefused(filter, "Sources: point 1");
  }
}

TEST_F(SpectralSignaturesFilter, SourcesWithoutPointsWarn)
{
  vtkNew<vtkPolyData> places;
  filter->SetInputDataObject(2, places);
  EXPECT_TRUE(this->Run("BiharmonicDistance").empty());
  ExpectOne(messages.warnings, "Sources has no points");
}

TEST_F(SpectralSignaturesFilter, AModeInsideTheBandPassesUnchanged)
{
  auto data = WithModes(ToPolyData(sphere), 25);
  filter->SetInputData(data);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Mode007");
  const auto mode = PointValues(data, "Mode007");
  const std::vector<double> nothing(mode.size(), 0.0);
  const auto expect = [&](int type, int first, int last, const std::vector<double>& expected)
  {
    filter->SetFilterType(type);
    filter->SetFirstMode(first);
    filter->SetLastMode(last);
    EXPECT_LT(Difference(this->Run("Filtered"), expected), 1e-6) << type << " " << first;
  };
  expect(Signatures::LowPass, 0, 7, mode);
  expect(Signatures::LowPass, 0, 6, nothing);
  expect(Signatures::HighPass, 7, 0, mode);
  expect(Signatures::HighPass, 8, 0, nothing);
  expect(Signatures::BandPass, 5, 10, mode);
  expect(Signatures::BandPass, 8, 1000, nothing);
}

TEST_F(SpectralSignaturesFilter, SurrogatesAreArraysLikeTheValues)
{
  auto data = WithModes(ToPolyData(sphere), 25);
  filter->SetInputData(data);
  filter->SetFilterType(Signatures::Surrogates);
  filter->SetNumberOfSurrogates(2);
  EXPECT_TRUE(this->Run("Surrogate000").empty()) << "without a Value Array";
  ASSERT_EQ(messages.warnings.size(), 1u);
  EXPECT_NE(messages.warnings[0].find("Value Array"), std::string::npos) << messages.warnings[0];
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Mode007");
  const auto first = this->Run("Surrogate000");
  ASSERT_EQ(first.size(), static_cast<std::size_t>(data->GetNumberOfPoints()));
  vtkPointData* points = filter->GetOutput()->GetPointData();
  EXPECT_TRUE(points->HasArray("Surrogate001"));
  EXPECT_FALSE(points->HasArray("Surrogate002"));
  EXPECT_FALSE(points->HasArray("Filtered"));
  EXPECT_STREQ(points->GetScalars()->GetName(), "Surrogate000");
  EXPECT_GT(Difference(first, PointValues(data, "Mode007")), 0.1);
  filter->SetSeed(2);
  EXPECT_GT(Difference(this->Run("Surrogate000"), first), 0.1);
}

TEST_F(SpectralSignaturesFilter, TheTableHasCoefficientsAndWhatRemains)
{
  auto data = WithModes(ToPolyData(sphere), 25);
  const auto seventh = PointValues(data, "Mode007");
  const auto third = PointValues(data, "Mode003");
  for (const double constant : { 0.0, 5.0, 1e9 })
  {
    vtkNew<vtkDoubleArray> sum;
    sum->SetName("sum");
    for (std::size_t k = 0; k < seventh.size(); ++k)
    {
      sum->InsertNextValue(constant + 3.0 * third[k] - 4.0 * seventh[k]);
    }
    data->GetPointData()->AddArray(sum);
    filter->SetInputData(data);
    filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "sum");
    filter->SetFilterType(Signatures::LowPass);
    filter->SetLastMode(7);
    const double rounding = 1e-6 + 1e-15 * constant;
    EXPECT_LT(Difference(this->Run("Filtered"), Values(sum)), rounding) << constant;
    filter->SetFilterType(Signatures::HighPass);
    filter->SetFirstMode(1);
    std::vector<double> varying;
    for (std::size_t k = 0; k < seventh.size(); ++k)
    {
      varying.push_back(3.0 * third[k] - 4.0 * seventh[k]);
    }
    EXPECT_LT(Difference(this->Run("Filtered"), varying), rounding) << constant;
    const auto coefficient = Column(filter, "Coefficient");
    const auto remaining = Column(filter, "RemainingError");
    ASSERT_GE(remaining.size(), 25u);
    ASSERT_EQ(coefficient.size(), remaining.size());
    EXPECT_NEAR(std::abs(coefficient[0]), constant * std::sqrt(4 * M_PI), 1e-2 * constant + 1e-6);
    for (std::size_t mode = 1; mode < coefficient.size(); ++mode)
    {
      EXPECT_NEAR(coefficient[mode],
        mode == 3   ? 3.0
        : mode == 7 ? -4.0
                    : 0.0,
        10 * rounding)
        << mode;
      const double expected = mode < 3 ? 1.0 : mode < 7 ? 0.8 : 0.0;
      EXPECT_NEAR(remaining[mode], expected, mode < 7 ? 0.01 : 1e-5) << mode << " " << constant;
    }
  }
}

TEST_F(SpectralSignaturesFilter, TheMiddleScaleIsShown)
{
  const auto all = this->Run("HeatKernelSignature");
  const auto shown = this->Run("Signature");
  for (std::size_t k = 0; k < shown.size(); ++k)
  {
    ASSERT_EQ(shown[k], all[4 * k + 2]);
  }
  EXPECT_STREQ(filter->GetOutput()->GetPointData()->GetScalars()->GetName(), "Signature");
  filter->AddSourcePointId(3);
  filter->Update();
  EXPECT_STREQ(filter->GetOutput()->GetPointData()->GetScalars()->GetName(), "BiharmonicDistance");
}

TEST_F(SpectralSignaturesFilter, TheShapeItselfIsFiltered)
{
  // The coordinates of a sphere are modes of degree 1. A low pass at 3 keeps the sphere up to the
  // error of the grid and of the facets. The mean alone moves all points into the center.
  filter->SetFilterType(Signatures::LowPass);
  filter->SetLastMode(3);
  filter->Update();
  double largest = 0.0;
  for (std::size_t k = 0; k < sphere.points.size(); ++k)
  {
    const Vec3 moved(filter->GetOutput()->GetPoint(k));
    largest = Larger(largest, (moved - sphere.points[k]).norm());
  }
  EXPECT_LT(largest, 0.02);
  EXPECT_GT(largest, 0.0);
  filter->SetLastMode(0);
  filter->Update();
  EXPECT_LT(Vec3(filter->GetOutput()->GetPoint(9)).norm(), 1e-6);
}

TEST_F(SpectralSignaturesFilter, OnlyWhatDependsOnAChangeIsComputedAgain)
{
  filter->Update();
  filter->AddSourcePointId(3);
  filter->SetFilterType(Signatures::BandPass);
  filter->SetNumberOfScales(9);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 1);
  EXPECT_EQ(
    filter->GetOutput()->GetPointData()->GetArray("WaveKernelSignature")->GetNumberOfComponents(),
    9);
}

TEST_F(SpectralSignaturesFilter, ACellArrayIsNotFiltered)
{
  auto data = ToPolyData(sphere);
  vtkNew<vtkDoubleArray> cells;
  cells->SetName("c");
  cells->SetNumberOfTuples(data->GetNumberOfCells());
  cells->Fill(1.0);
  data->GetCellData()->AddArray(cells);
  filter->SetInputData(data);
  filter->SetFilterType(Signatures::LowPass);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "c");
  ExpectRefused(filter, "point array");
}

} // namespace
