// Stitch Colors as a user of VTK sees it.
#include "FilterSupport.h"
#include "Largest.h"

#include "vtkConnectivityAwareBasis.h"
#include "vtkStitchColors.h"

#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkPLYReader.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr int NumberOfScans = 5;

Index ScanAt(const Vec3& p)
{
  const double turn = std::atan2(p[1], p[0]) / (2.0 * EIGEN_PI) + 0.5;
  return std::min(NumberOfScans - 1, static_cast<int>(NumberOfScans * turn));
}

double ColorAt(const Vec3& p, int c)
{
  return 120.0 + 50.0 * std::sin(2 * p[c] + p[2]) + 4.0 * std::sin(30 * p[(c + 1) % 3]);
}

/// Returns the color that a scanner sees.
double Seen(Index scan, double color, int c)
{
  const double gain[] = { 1.0, 0.92, 1.07, 0.95, 1.04 };
  const double offset[] = { 0.0, 20.0, -15.0, 25.0, -10.0 };
  return gain[scan] * color + (c == 1 ? -0.7 : 1.0) * offset[scan];
}

/// Adds the arrays True and Seen (double) and Scan (int) to the points.
void AddScans(vtkPolyData* data, const std::function<double(const Vec3&, int)>& color = ColorAt)
{
  AddPointArray(data, "True", 3, color);
  AddPointArray(
    data, "Seen", 3, [&](const Vec3& p, int c) { return Seen(ScanAt(p), color(p, c), c); });
  vtkNew<vtkIntArray> scan;
  scan->SetName("Scan");
  for (vtkIdType k = 0; k < data->GetNumberOfPoints(); ++k)
  {
    scan->InsertNextValue(10 * ScanAt(Vec3(data->GetPoint(k))) - 20);
  }
  data->GetPointData()->AddArray(scan);
}

/// Returns the root mean square of the differences along edges inside scans, or across seams.
double EdgeDifference(vtkPolyData* data, const std::vector<double>& values, bool isSeam)
{
  const auto scan = PointValues(data, "Scan");
  const auto components = static_cast<vtkIdType>(values.size()) / data->GetNumberOfPoints();
  double sum = 0.0;
  vtkIdType count = 0;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    vtkIdType size;
    const vtkIdType* corner;
    data->GetCellPoints(cell, size, corner);
    for (vtkIdType k = 0; k < size; ++k)
    {
      const vtkIdType a = corner[k];
      const vtkIdType b = corner[(k + 1) % size];
      for (vtkIdType c = 0; (scan[a] != scan[b]) == isSeam && c < components; ++c)
      {
        sum += std::pow(values[components * a + c] - values[components * b + c], 2);
        ++count;
      }
    }
  }
  return std::sqrt(sum / double(count));
}

std::vector<double> Minus(std::vector<double> a, const std::vector<double>& b)
{
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    a[k] -= b[k];
  }
  return a;
}

vtkSmartPointer<vtkStitchColors> Stitch(vtkPolyData* data, const char* colors, int depth)
{
  auto filter = vtkSmartPointer<vtkStitchColors>::New();
  filter->SetInputData(data);
  filter->SetInputArrayToProcess(0, 0, 0, Points, colors);
  filter->SetInputArrayToProcess(1, 0, 0, Points, "Scan");
  filter->SetDepth(depth);
  return filter;
}

void ExpectStitched(vtkPolyData* data, vtkPolyData* output)
{
  const auto truth = PointValues(data, "True");
  const auto seen = PointValues(data, "Seen");
  const auto stitched = PointValues(output, "StitchedColors");
  EXPECT_LT(EdgeDifference(data, Minus(stitched, truth), true),
    0.1 * EdgeDifference(data, Minus(seen, truth), true));
  EXPECT_LT(
    EdgeDifference(data, Minus(stitched, seen), false), 0.05 * EdgeDifference(data, seen, false));
}

class StitchColors : public ::testing::TestWithParam<int>
{
};

} // namespace

TEST_P(StitchColors, TakesOutJumpsAndKeepsGradientsOfASphereInFiveScans)
{
  const auto data = ToPolyData(Transform(GeodesicSphere(50), { 1, 2, 3 }, 0.3));
  AddScans(data);
  const auto filter = Stitch(data, "Seen", 5);
  filter->SetFunctionSpace(this->GetParam());
  filter->Update();
  ExpectStitched(data, filter->GetOutput());
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1);
  EXPECT_EQ(
    filter->GetOutput()->GetPointData()->GetScalars()->GetName(), std::string("StitchedColors"));
}

TEST_P(StitchColors, KeepsTheMeanOfOneScan)
{
  const auto data = ToPolyData(GeodesicSphere(20));
  AddScans(data, [](const Vec3&, int) { return 100.0; }); // constant in every scan
  const auto filter = Stitch(data, "Seen", 4);
  filter->SetFunctionSpace(this->GetParam());
  filter->SetReferenceLabel(10); // scan 3: 0.95 x 100 + 25
  filter->Update();
  const auto stitched = PointValues(filter->GetOutput(), "StitchedColors");
  ASSERT_FALSE(stitched.empty());
  for (std::size_t k = 0; k < stitched.size(); ++k)
  {
    ASSERT_NEAR(stitched[k], k % 3 == 1 ? 95.0 - 17.5 : 120.0, 0.05);
  }
}

INSTANTIATE_TEST_SUITE_P(BothSpaces, StitchColors,
  ::testing::Values(int(vtkSurfaceFEMAlgorithm::Grid), int(vtkSurfaceFEMAlgorithm::HatFunctions)));

TEST(StitchColorsFilter, TakesBytesAndLeavesThemInRange)
{
  const auto data = ToPolyData(GeodesicSphere(20));
  AddScans(data);
  const auto seen = PointValues(data, "Seen");
  vtkNew<vtkUnsignedCharArray> bytes;
  bytes->SetName("Bytes");
  bytes->SetNumberOfComponents(3);
  for (std::size_t k = 0; k < seen.size(); ++k)
  {
    bytes->InsertNextValue(static_cast<unsigned char>(std::clamp(1.6 * seen[k], 0.0, 255.0)));
  }
  data->GetPointData()->AddArray(bytes);
  const auto filter = Stitch(data, "Bytes", 4);
  filter->Update();
  auto* stitched = vtkUnsignedCharArray::SafeDownCast(
    filter->GetOutput()->GetPointData()->GetArray("StitchedColors"));
  ASSERT_TRUE(stitched);
  ASSERT_EQ(stitched->GetNumberOfComponents(), 3);
  double mean[2] = { 0.0, 0.0 };
  for (vtkIdType k = 0; k < bytes->GetNumberOfValues(); ++k)
  {
    mean[0] += bytes->GetValue(k) / double(bytes->GetNumberOfValues());
    mean[1] += stitched->GetValue(k) / double(bytes->GetNumberOfValues());
  }
  EXPECT_NEAR(mean[1], mean[0], 3.0); // clipping at 255 and unequal areas
}

namespace
{

/// Adds bytes "RGB" and a byte "Gray" of the scans, and an array that is no label: an id for each
/// point.
void AddBytes(vtkPolyData* data)
{
  vtkNew<vtkUnsignedCharArray> bytes;
  bytes->SetName("RGB");
  bytes->SetNumberOfComponents(3);
  vtkNew<vtkUnsignedCharArray> gray;
  gray->SetName("Gray");
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("Ids");
  for (vtkIdType k = 0; k < data->GetNumberOfPoints(); ++k)
  {
    const Vec3 p(data->GetPoint(k));
    for (int c = 0; c < 3; ++c)
    {
      bytes->InsertNextValue(static_cast<unsigned char>(Seen(ScanAt(p), ColorAt(p, c), c)));
    }
    gray->InsertNextValue(bytes->GetValue(3 * k));
    ids->InsertNextValue(k);
  }
  data->GetPointData()->AddArray(bytes);
  data->GetPointData()->AddArray(gray);
  data->GetPointData()->AddArray(ids);
}

/// The filter names what it needs, and passes its input on until then.
void ExpectToBeChosen(vtkStitchColors* filter, const char* property)
{
  Messages messages(filter);
  EXPECT_EQ(filter->GetExecutive()->Update(), 1);
  EXPECT_TRUE(messages.errors.empty());
  ExpectOne(messages.warnings, std::string("Choose a ") + property);
  EXPECT_TRUE(PassesOn(filter, "StitchedColors"));
}

} // namespace

/// The first Apply finds the arrays. If there are several candidates, one has to be chosen.
TEST(StitchColorsFilter, TakesTheOnlyColorsAndTheOnlyLabels)
{
  const auto sphere = ToPolyData(GeodesicSphere(8));
  AddScans(sphere);
  AddBytes(sphere);
  sphere->GetPointData()->RemoveArray("Gray");
  vtkNew<vtkPolyData> plain;
  plain->ShallowCopy(sphere);
  vtkNew<vtkConnectivityAwareBasis> basis;    // adds numbers and a color to each cell
  sphere->GetPointData()->RemoveArray("Ids"); // they no longer differ at each point
  basis->SetInputData(sphere);
  basis->SetDepth(4);
  basis->Update();
  for (vtkPolyData* data : { plain.Get(), basis->GetOutput() })
  {
    const auto chosen = Stitch(data, "RGB", 4);
    chosen->Update();
    const auto filter = Stitch(data, "None", 4);
    filter->SetInputArrayToProcess(1, 0, 0, Points, "None");
    filter->Update();
    EXPECT_EQ(PointValues(filter->GetOutput(), "StitchedColors"),
      PointValues(chosen->GetOutput(), "StitchedColors"));
  }
  vtkNew<vtkUnsignedCharArray> others;
  others->DeepCopy(plain->GetPointData()->GetArray("RGB"));
  others->SetName("Others");
  plain->GetPointData()->AddArray(others);
  const auto filter = Stitch(plain, "None", 4);
  ExpectToBeChosen(filter, "Color Array");
}

TEST(StitchColorsFilter, TakesNoColorsAndNoIdsForLabels)
{
  const auto data = ToPolyData(GeodesicSphere(8));
  AddScans(data);
  AddBytes(data);
  data->GetPointData()->RemoveArray("Scan");
  const auto filter = Stitch(data, "Gray", 4);
  filter->SetInputArrayToProcess(1, 0, 0, Points, "None");
  ExpectToBeChosen(filter, "Label Array");
}

/// Borders coincide without common points, or leave a gap that only a plain grid closes.
TEST(StitchColorsFilter, StitchesUnweldedBordersAndNarrowGaps)
{
  for (const double gap : { 0.0, 0.03 })
  {
    TriangleMesh left = FlatRectangle(30, 30);
    const TriangleMesh right = Transform(left, { 0, 0, 1 }, 0.0, 1.0, { 1.0 + gap, 0, 0 });
    const auto half = static_cast<vtkIdType>(left.points.size());
    const auto data = ToPolyData(Transform(Join(left, right), { 1, 2, 3 }, 0.2));
    vtkNew<vtkIdTypeArray> scan;
    scan->SetName("Scan");
    vtkNew<vtkFloatArray> color;
    color->SetName("Color");
    for (vtkIdType k = 0; k < data->GetNumberOfPoints(); ++k)
    {
      scan->InsertNextValue(k < half ? -7 : 1000000);
      color->InsertNextValue(k < half ? 0.2f : 0.6f);
    }
    data->GetPointData()->AddArray(scan);
    data->GetPointData()->AddArray(color);
    const auto filter = Stitch(data, "Color", 4); // cells of an eighth
    filter->SetConnectivityAware(gap == 0.0);
    filter->Update();
    auto* stitched =
      vtkFloatArray::SafeDownCast(filter->GetOutput()->GetPointData()->GetArray("StitchedColors"));
    ASSERT_TRUE(stitched);
    for (vtkIdType k = 0; k < stitched->GetNumberOfTuples(); ++k)
    {
      ASSERT_NEAR(stitched->GetValue(k), 0.4f, 2e-3) << gap;
    }
  }
}

TEST(StitchColorsFilter, TakesColorsAndLabelsOfCells)
{
  const auto data = ToPolyData(Transform(GeodesicSphere(30), { 1, 2, 3 }, 0.3));
  vtkNew<vtkFloatArray> color;
  vtkNew<vtkFloatArray> scan; // whole numbers are labels, whatever their type
  color->SetName("Color");
  scan->SetName("Scan");
  double jump = 0.0;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    double bounds[6];
    data->GetCellBounds(cell, bounds);
    const Vec3 middle(bounds[0] + bounds[1], bounds[2] + bounds[3], bounds[4] + bounds[5]);
    const Index own = ScanAt(middle);
    scan->InsertNextValue(float(own));
    color->InsertNextValue(float(0.5 + 0.1 * (own - 2) + 0.1 * middle[2]));
    jump = Larger(jump, 0.1 * own);
  }
  data->GetCellData()->AddArray(color);
  data->GetCellData()->AddArray(scan);
  vtkNew<vtkStitchColors> filter;
  filter->SetInputData(data);
  filter->SetInputArrayToProcess(0, 0, 0, Cells, "Color");
  filter->SetInputArrayToProcess(1, 0, 0, Cells, "Scan");
  filter->SetDepth(5);
  filter->Update();
  const auto stitched = Values(filter->GetOutput()->GetCellData()->GetArray("StitchedColors"));
  ASSERT_EQ(stitched.size(), std::size_t(data->GetNumberOfCells()));
  double error = 0.0;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    double bounds[6];
    data->GetCellBounds(cell, bounds);
    error = Larger(error, std::abs(stitched[cell] - 0.5 - 0.1 * (bounds[4] + bounds[5])));
  }
  EXPECT_LT(error, 0.1 * jump);
}

TEST(StitchColorsFilter, TakesASharedBasisAndRunsOnlyWhatHasChanged)
{
  const auto data = ToPolyData(GeodesicSphere(12));
  AddScans(data);
  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetInputData(data);
  basis->SetDepth(4);
  const auto shared = Stitch(data, "Seen", 7);
  shared->SetBasisConnection(basis->GetOutputPort());
  shared->Update();
  const auto alone = Stitch(data, "Seen", 4);
  alone->Update();
  EXPECT_LT(Difference(PointValues(shared->GetOutput(), "StitchedColors"),
              PointValues(alone->GetOutput(), "StitchedColors")),
    1e-6);
  alone->SetInputArrayToProcess(0, 0, 0, Points, "True");
  alone->Update();
  EXPECT_EQ(alone->GetNumberOfRuns("Space"), 1);
  EXPECT_EQ(alone->GetNumberOfRuns("Cut"), 1);
  EXPECT_EQ(alone->GetNumberOfRuns("Solve"), 2);
  const auto sharp = PointValues(alone->GetOutputDataObject(0), "StitchedColors");
  alone->SetBlendWidth(0.1);
  alone->Update();
  EXPECT_EQ(alone->GetNumberOfRuns("Cut"), 1);
  EXPECT_EQ(alone->GetNumberOfRuns("Solve"), 3);
  EXPECT_NE(PointValues(alone->GetOutputDataObject(0), "StitchedColors"), sharp);
}

TEST(StitchColorsFilter, RefusesWhatIsNoColorOrNoLabel)
{
  const auto data = ToPolyData(GeodesicSphere(4));
  AddScans(data);
  AddPointArray(data, "Five", 5, [](const Vec3&, int) { return 1.0; });
  AddPointArray(data, "Halves", 1, [](const Vec3& p, int) { return 0.5 * p[0]; });
  AddPointArray(data, "Hole", 1, [](const Vec3& p, int) { return p[0] > 0 ? NAN : 1.0; });
  const auto expectRefused = [&](const char* colors, const char* labels, const char* reason)
  {
    const auto filter = Stitch(data, colors, 3);
    filter->SetInputArrayToProcess(1, 0, 0, Points, labels);
    ExpectRefused(filter, reason);
  };
  vtkNew<vtkIntArray> other;
  other->DeepCopy(data->GetPointData()->GetArray("Scan"));
  other->SetName("Other");
  data->GetPointData()->AddArray(other);
  for (const auto& [colors, labels, property] :
    { std::array{ "None", "Scan", "Color Array" }, std::array{ "Seen", "None", "Label Array" } })
  {
    const auto filter = Stitch(data, colors, 3);
    filter->SetInputArrayToProcess(1, 0, 0, Points, labels);
    ExpectToBeChosen(filter, property);
  }
  expectRefused("Five", "Scan", "1 to 4");
  expectRefused("Seen", "Seen", "one component");
  expectRefused("Seen", "Halves", "integers");
  expectRefused("Hole", "Scan", "NaN");
  expectRefused("Seen", "Hole", "NaN");
  const auto filter = Stitch(data, "Seen", 3);
  filter->SetReferenceLabel(3);
  ExpectRefused(filter, "Reference Label 3");
}

/// A real scan with colors, cut into five scans with other gains and offsets.
TEST(StitchColorsFilter, StitchesARealScan)
{
  const std::string path = RealMesh("laurana_colour_50k.ply");
  if (path.empty())
  {
    GTEST_SKIP() << "no real meshes";
  }
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  vtkDataArray* colors = data->GetPointData()->GetScalars();
  ASSERT_TRUE(colors);
  Vec3 center(data->GetCenter());
  vtkNew<vtkDoubleArray> truth;
  vtkNew<vtkDoubleArray> seen;
  vtkNew<vtkIntArray> scan;
  truth->SetName("True");
  seen->SetName("Seen");
  scan->SetName("Scan");
  truth->SetNumberOfComponents(3);
  seen->SetNumberOfComponents(3);
  for (vtkIdType k = 0; k < data->GetNumberOfPoints(); ++k)
  {
    const Vec3 p = Vec3(data->GetPoint(k)) - center;
    const Index own = ScanAt({ p[0], p[2], p[1] }); // sectors around its height
    scan->InsertNextValue(own);
    for (int c = 0; c < 3; ++c)
    {
      truth->InsertNextValue(colors->GetComponent(k, c));
      seen->InsertNextValue(Seen(own, colors->GetComponent(k, c), c));
    }
  }
  for (vtkDataArray* array : { static_cast<vtkDataArray*>(truth.Get()),
         static_cast<vtkDataArray*>(seen.Get()), static_cast<vtkDataArray*>(scan.Get()) })
  {
    data->GetPointData()->AddArray(array);
  }
  const auto filter = Stitch(data, "Seen", 7);
  filter->Update();
  ExpectStitched(data, filter->GetOutput());
}
