// Functional Map as a user of VTK sees it.
#include "FilterSupport.h"

#include "vtkFieldData.h"
#include "vtkFunctionalMap.h"
#include "vtkIntArray.h"
#include "vtkLaplaceSpectrum.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// A closed surface without any symmetry.
TriangleMesh Pebble(int fineness)
{
  return Mapped(GeodesicSphere(fineness),
    [](const Vec3& p)
    {
      const double bump = 0.8 * std::exp(-6.0 * (p - Vec3(0.6, 0.7, 0.4)).squaredNorm());
      return Vec3((1.0 + bump) * Vec3(1.6 * p[0], p[1], 0.7 * p[2]));
    });
}

vtkSmartPointer<vtkFunctionalMap> MapTo(vtkPolyData* surface, vtkDataObject* reference)
{
  auto filter = vtkSmartPointer<vtkFunctionalMap>::New();
  filter->SetInputDataObject(0, surface);
  filter->SetInputDataObject(2, reference);
  filter->SetDepth(5);
  filter->SetNumberOfModes(20);
  return filter;
}

vtkSmartPointer<vtkPolyData> WithAllModes(vtkPolyData* surface, int modes)
{
  vtkNew<vtkLaplaceSpectrum> spectrum;
  spectrum->SetInputData(surface);
  spectrum->SetDepth(5);
  spectrum->SetNumberOfModes(modes);
  spectrum->AllModesOn();
  spectrum->Update();
  vtkSmartPointer<vtkPolyData> output = spectrum->GetOutput();
  return output;
}

} // namespace

/// Real numbers are linear between points, so coordinates of the reference arrive as places. Labels
/// come from a point, and colors stay bytes.
TEST(FunctionalMap, ArraysOfTheReferenceArrive)
{
  const auto surface = ToPolyData(Pebble(8));
  const auto reference = ToPolyData(Transform(Pebble(10), { 1, 2, 3 }, 1.0, 2.0, { 3, 2, 1 }));
  AddPointArray(reference, "where", 3, [](const Vec3& p, int c) { return p[c]; });
  AddPointArray(surface, "where", 1, Wave);
  vtkNew<vtkIntArray> label;
  label->SetName("label");
  vtkNew<vtkUnsignedCharArray> color;
  color->SetName("color");
  color->SetNumberOfComponents(3);
  for (vtkIdType k = 0; k < reference->GetNumberOfPoints(); ++k)
  {
    label->InsertNextValue(static_cast<int>(7 * k));
    color->InsertNextTuple3(double(k % 256), 10.0, 255.0);
  }
  reference->GetPointData()->AddArray(label);
  reference->GetPointData()->AddArray(color);
  const auto filter = MapTo(surface, reference);
  const Messages messages(filter);
  filter->Update();
  EXPECT_TRUE(messages.errors.empty());
  EXPECT_EQ(messages.warnings, std::vector<std::string>());
  vtkPolyData* output = filter->GetOutput();
  const std::vector<double> places = PointValues(output, "ReferencePlace");
  EXPECT_LT(Difference(PointValues(output, "where"), places), 1e-12);
  EXPECT_EQ(PointValues(output, "where_input"), PointValues(surface, "where"));
  const std::vector<double> labels = PointValues(output, "label");
  const std::vector<double> corners = PointValues(output, "ReferenceCorners");
  for (std::size_t k = 0; k < labels.size(); ++k)
  {
    const double point = labels[k] / 7.0;
    EXPECT_TRUE(
      point == corners[3 * k] || point == corners[3 * k + 1] || point == corners[3 * k + 2]);
  }
  EXPECT_EQ(output->GetPointData()->GetArray("color")->GetDataType(), VTK_UNSIGNED_CHAR);
  EXPECT_EQ(PointValues(output, "color")[1], 10.0);
  EXPECT_EQ(FieldValue(output, "Converged"), 1.0);
  EXPECT_LT(FieldValue(output, "MeanMismatch"), 0.1);
  vtkDataArray* matrix = output->GetFieldData()->GetArray("FunctionalMap");
  EXPECT_EQ(matrix->GetNumberOfTuples(), matrix->GetNumberOfComponents());
  // The same colors at the same places.
  auto* shown = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(1));
  EXPECT_EQ(shown->GetNumberOfPoints(), reference->GetNumberOfPoints());
  EXPECT_STREQ(shown->GetPointData()->GetScalars()->GetName(), "MatchingColors");
  EXPECT_STREQ(output->GetPointData()->GetScalars()->GetName(), "MatchingColors");
}

/// Modes that come with the surfaces are used, and only the map is computed.
TEST(FunctionalMap, TakesCarriedModes)
{
  const auto surface = WithAllModes(ToPolyData(Pebble(8)), 16);
  const auto reference =
    WithAllModes(ToPolyData(Transform(Pebble(8), { 0, 0, 1 }, 1.0, 1.0, { 3, 2, 1 })), 16);
  const auto filter = MapTo(surface, reference);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 0);
  EXPECT_LT(FieldValue(filter->GetOutput(), "MeanMismatch"), 0.05);
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray("Mode000"),
    surface->GetPointData()->GetArray("Mode000"));
  // Few modes are not enough.
  const auto computed = MapTo(WithAllModes(ToPolyData(Pebble(8)), 5), reference);
  computed->Update();
  EXPECT_EQ(computed->GetNumberOfRuns("Solve"), 1);
  EXPECT_LT(FieldValue(computed->GetOutput(), "MeanMismatch"), 0.05);
}

TEST(FunctionalMap, ChangesRepeatWhatTheyMust)
{
  const auto surface = ToPolyData(Pebble(6));
  const auto reference = ToPolyData(Pebble(7));
  const auto filter = MapTo(surface, reference);
  filter->Update();
  filter->AddLandmark(3, 3);
  EXPECT_EQ(filter->GetNumberOfLandmarks(), 1);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Map"), 2);
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 1);
  // Another reference changes the map, and gives the bits of a new filter.
  const auto other = ToPolyData(Transform(Pebble(7), { 0, 1, 0 }, 0.5));
  filter->SetInputDataObject(2, other);
  filter->Update();
  const auto fresh = MapTo(surface, other);
  fresh->AddLandmark(3, 3);
  fresh->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 1);
  EXPECT_EQ(PointValues(filter->GetOutput(), "ReferencePlace"),
    PointValues(fresh->GetOutput(), "ReferencePlace"));
  filter->ClearLandmarks();
  filter->AddLandmark(3, 1000000);
  ExpectRefused(filter, "Landmarks", "1000000", "Reference");
}

/// The choice is missing, the reference has no surface, or it has several components.
TEST(FunctionalMap, RefusesReferences)
{
  const auto surface = ToPolyData(Pebble(6));
  const auto filter = MapTo(surface, nullptr);
  const Messages messages(filter);
  filter->Update();
  ExpectOne(messages.warnings, "Choose a Reference");
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), surface->GetNumberOfPoints());
  vtkNew<vtkPolyData> empty;
  filter->SetInputDataObject(2, empty);
  ExpectRefused(filter, "Reference has no surface");
  filter->SetInputDataObject(
    2, ToPolyData(Join(Pebble(4), Transform(Pebble(4), { 0, 0, 1 }, 0.0, 1.0, { 9, 0, 0 }))));
  ExpectRefused(filter, "Reference", "2 connected components");
}

/// Points that no polygon uses have no place, and colors that are gray.
TEST(FunctionalMap, UnusedPointsHaveNoPlace)
{
  TriangleMesh mesh = Pebble(6);
  mesh.points.push_back({ 3, 3, 3 });
  const auto reference = ToPolyData(Pebble(6));
  AddPointArray(reference, "f", 1, Wave);
  const auto filter = MapTo(ToPolyData(mesh), reference);
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  EXPECT_TRUE(std::isnan(PointValues(output, "ReferencePlace").back()));
  EXPECT_TRUE(std::isnan(PointValues(output, "Mismatch").back()));
  EXPECT_TRUE(std::isnan(PointValues(output, "f").back()));
  EXPECT_EQ(PointValues(output, "ReferenceCorners").back(), -1.0);
  EXPECT_TRUE(std::isfinite(PointValues(output, "f").front()));
}
