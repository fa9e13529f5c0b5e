// Tests the failure rule of DESIGN §4 for every filter. Unusable input is refused with one message
// and empty outputs. Odd but usable input is computed.

#include "AllFilters.h"

#include "vtkErrorCode.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkStringOutputWindow.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVersionMacros.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

template<class Filter>
vtkSmartPointer<vtkSurfaceFEMAlgorithm> MakeOnHats()
{
  auto filter = Make<Filter>();
  filter->SetFunctionSpace(vtkSurfaceFEMAlgorithm::HatFunctions);
  return filter;
}

/// Makes a small filter whose outputs are never empty, with something to compute on the grid.
vtkSmartPointer<vtkSurfaceFEMAlgorithm> MakeFilter(const FilterCase& filterCase)
{
  auto filter = filterCase.make();
  filter->SetDepth(4);
  if (auto* clip = vtkClipToOctree::SafeDownCast(filter))
  {
    clip->GenerateQuadraturePointsOn();
  }
  if (auto* curvatures = vtkPrincipalCurvatures::SafeDownCast(filter))
  {
    curvatures->SetSmoothingScale(0.1);
  }
  return filter;
}

/// Chooses the array "f", unless the filter's case has chosen one.
void ChooseArray(vtkAlgorithm* filter)
{
  if (!filter->GetInputArrayInformation(0)->Has(vtkDataObject::FIELD_NAME()))
  {
    filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
  }
}

/// The power of the unit of length that a result array has. Modes have unit norm in world units:
/// the constant mode is 1 / sqrt(area).
int PowerOfLength(const std::string& array)
{
  static const std::map<std::string, int> powers = { { "AngleDistortion", 0 },
    { "AreaDistortion", 0 }, { "Bending", 0 }, { "ChartId", 0 }, { "Diffused", 0 },
    { "Displacement", 1 }, { "Distance", 1 }, { "ConformalFactor", 0 }, { "Filtered", 0 },
    { "GaussianCurvature", -2 }, { "Gradient", -1 }, { "HeatKernelSignature", 0 },
    { "Interpolated", 0 }, { "Laplacian", -2 }, { "LeaveOneOutError", 0 },
    { "MaximumCurvature", -1 }, { "MaximumCurvatureDirection", 0 }, { "MeanCurvature", -1 },
    { "MinimumCurvature", -1 }, { "MinimumCurvatureDirection", 0 }, { "Mismatch", 0 },
    { "Mode", -1 }, { "NearestPoint", 0 }, { "NormalDisplacement", 1 }, { "PathId", 0 },
    { "Prediction", 0 }, { "QuasiConformalError", 0 }, { "ReferencePlace", 0 }, { "Sample000", 0 },
    { "ShapeIndex", 0 }, { "Signature", 0 }, { "Solution", 0 }, { "StitchedColors", 0 },
    { "TCoords", 0 }, { "U", 0 }, { "V", 0 }, { "WaveKernelSignature", 0 } };
  const auto found = powers.find(array);
  EXPECT_TRUE(found != powers.end()) << array << " has no unit in this test";
  return found == powers.end() ? 0 : found->second;
}

bool IsClip(vtkAlgorithm* filter)
{
  return filter->IsA("vtkClipToOctree") || filter->IsA("vtkConnectivityAwareBasis");
}

/// Returns the arrays that the filter has added.
std::vector<vtkDataArray*> AddedArrays(vtkDataSetAttributes* output, vtkDataSetAttributes* input)
{
  std::vector<vtkDataArray*> added;
  for (int k = 0; k < output->GetNumberOfArrays(); ++k)
  {
    if (output->GetArray(k) && !input->HasArray(output->GetArrayName(k)))
    {
      added.push_back(output->GetArray(k));
    }
  }
  return added;
}

bool NeedsNoFunctions(vtkAlgorithm* filter)
{
  return filter->IsA("vtkGeodesicPaths") || filter->IsA("vtkParameterization");
}

/// The stage that reads the mesh.
const char* FirstStageOf(vtkAlgorithm* filter)
{
  return NeedsNoFunctions(filter) ? "Mesh" : "Space";
}

/// Expects numbers at the points that a polygon uses. The other points have none, or that of a
/// surface that has not moved.
void ExpectFiniteOnTheSurface(vtkPolyData* surface, vtkDataArray* array)
{
  std::vector<char> isUsed(static_cast<std::size_t>(surface->GetNumberOfPoints()), 0);
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> ids;
    surface->GetCellPoints(cell, ids);
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
    {
      isUsed[ids->GetId(k)] = 1;
    }
  }
  ASSERT_EQ(array->GetNumberOfTuples(), surface->GetNumberOfPoints());
  for (vtkIdType point = 0; point < array->GetNumberOfTuples(); ++point)
  {
    for (int c = 0; isUsed[point] && c < array->GetNumberOfComponents(); ++c)
    {
      ASSERT_TRUE(std::isfinite(array->GetComponent(point, c))) << array->GetName() << point;
    }
  }
}

/// A flag for each cell: it has an area, and no cell before it has the same corners. Other cells
/// need not have a result.
std::vector<char> CellsWithResult(vtkPolyData* surface)
{
  std::set<std::vector<vtkIdType>> seen;
  std::vector<char> has;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    surface->GetCellPoints(cell, ids);
    std::vector<vtkIdType> corners(ids->begin(), ids->end());
    std::sort(corners.begin(), corners.end());
    const bool isFirst = seen.insert(corners).second;
    double area = ids->GetNumberOfIds() > 3 ? 1.0 : 0.0;
    if (ids->GetNumberOfIds() == 3)
    {
      const auto at = [&](int k) { return Vec3(surface->GetPoint(ids->GetId(k))); };
      area = (at(1) - at(0)).cross(at(2) - at(0)).norm();
    }
    has.push_back(isFirst && area > 0.0);
  }
  return has;
}

/// Expects a result at every point and cell of the surface that the filter outputs.
void ExpectFiniteResults(vtkPolyData* input, vtkPolyData* output)
{
  ExpectFiniteOnTheSurface(output, output->GetPoints()->GetData());
  for (vtkDataArray* array : AddedArrays(output->GetPointData(), input->GetPointData()))
  {
    ExpectFiniteOnTheSurface(output, array);
  }
  const std::vector<char> hasResult = CellsWithResult(output);
  for (vtkDataArray* array : AddedArrays(output->GetCellData(), input->GetCellData()))
  {
    ASSERT_EQ(array->GetNumberOfTuples(), output->GetNumberOfCells());
    for (vtkIdType cell = 0; cell < array->GetNumberOfTuples(); ++cell)
    {
      for (int c = 0; hasResult[cell] && c < array->GetNumberOfComponents(); ++c)
      {
        ASSERT_TRUE(std::isfinite(array->GetComponent(cell, c))) << array->GetName() << cell;
      }
    }
  }
}

/// Returns the mesh with the arrays that the filters use.
vtkSmartPointer<vtkPolyData> Surface(const TriangleMesh& mesh)
{
  auto surface = ToPolyData(mesh);
  AddArraysOfAllFilters(surface);
  return surface;
}

/// Returns the bytes of arrays by type, without the time that a run took.
using Contents = std::map<std::string, std::string>;

void AddArray(Contents& contents, const std::string& name, vtkDataArray* array)
{
  if (array && std::string("Seconds") != (array->GetName() ? array->GetName() : ""))
  {
    const auto size = static_cast<std::size_t>(array->GetNumberOfValues()) *
                      static_cast<std::size_t>(array->GetDataTypeSize());
    contents[name] = { static_cast<const char*>(array->GetVoidPointer(0)), size };
  }
}

void AddCells(Contents& contents, const std::string& name, vtkCellArray* cells)
{
  AddArray(contents, name + " begin", cells->GetOffsetsArray());
  AddArray(contents, name + " points", cells->GetConnectivityArray());
}

Contents ContentsOf(vtkDataObject* data)
{
  Contents contents;
  for (int kind = 0; kind < vtkDataObject::NUMBER_OF_ATTRIBUTE_TYPES; ++kind)
  {
    vtkFieldData* arrays = data->GetAttributesAsFieldData(kind);
    for (int k = 0; arrays && k < arrays->GetNumberOfArrays(); ++k)
    {
      AddArray(contents, std::to_string(kind) + " " + arrays->GetArrayName(k), arrays->GetArray(k));
    }
  }
  auto* points = vtkPointSet::SafeDownCast(data);
  if (points && points->GetPoints())
  {
    AddArray(contents, "points", points->GetPoints()->GetData());
  }
  if (auto* surface = vtkPolyData::SafeDownCast(data))
  {
    AddCells(contents, "vertices", surface->GetVerts());
    AddCells(contents, "polygons", surface->GetPolys());
  }
  if (auto* grid = vtkUnstructuredGrid::SafeDownCast(data))
  {
    AddCells(contents, "cells", grid->GetCells());
  }
  return contents;
}

void ExpectSame(const Contents& contents, const Contents& expected)
{
  EXPECT_EQ(contents.size(), expected.size());
  for (const auto& [name, bytes] : expected)
  {
    const auto found = contents.find(name);
    EXPECT_TRUE(found != contents.end() && found->second == bytes) << name;
  }
}

class FailureRule : public ::testing::TestWithParam<FilterCase>
{
protected:
  FailureRule() : filter(MakeFilter(GetParam())), messages(filter) {}

  int Run(vtkPolyData* input)
  {
    filter->SetInputDataObject(0, input);
    return filter->GetExecutive()->Update();
  }

  template<class... Parts>
  void ExpectRefused(vtkPolyData* input, const Parts&... reason)
  {
    filter->SetInputDataObject(0, input);
    gridfem::testing::ExpectRefused(filter, reason...);
  }

  void ExpectEmptyOutputs()
  {
    for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
    {
      EXPECT_TRUE(IsEmptyData(filter->GetOutputDataObject(port))) << "port " << port;
    }
  }

  void ExpectComputed(vtkPolyData* input)
  {
    EXPECT_EQ(this->Run(input), 1);
    EXPECT_TRUE(messages.errors.empty()) << messages.errors[0];
    for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
    {
      EXPECT_FALSE(IsEmptyData(filter->GetOutputDataObject(port))) << "port " << port;
    }
    ExpectFiniteResults(input, vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0)));
  }

  void ExpectAborted(vtkPolyData* input)
  {
    EXPECT_EQ(this->Run(input), 1);
    EXPECT_TRUE(messages.errors.empty());
    this->ExpectEmptyOutputs();
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20230111)
    EXPECT_EQ(filter->GetOutputInformation(0)->Get(vtkAlgorithm::ABORTED()), 1);
#endif
  }

  /// The arrays of all outputs.
  std::vector<Contents> OutputContents()
  {
    std::vector<Contents> contents;
    for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
    {
      contents.push_back(ContentsOf(filter->GetOutputDataObject(port)));
    }
    return contents;
  }

  void ExpectOutputs(const std::vector<Contents>& expected)
  {
    for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
    {
      SCOPED_TRACE("port " + std::to_string(port));
      ExpectSame(ContentsOf(filter->GetOutputDataObject(port)), expected[port]);
    }
  }

  vtkSmartPointer<vtkSurfaceFEMAlgorithm> filter;
  Messages messages;
};

TEST_P(FailureRule, EmptyInputGivesEmptyOutputSilently)
{
  vtkNew<vtkPolyData> empty;
  EXPECT_EQ(this->Run(empty), 1);
  EXPECT_TRUE(messages.errors.empty() && messages.warnings.empty());
  this->ExpectEmptyOutputs();
}

TEST_P(FailureRule, OutputsAreEmptiedAfterASuccess)
{
  this->ExpectComputed(Surface(GeodesicSphere(4)));
  vtkNew<vtkPolyData> empty;
  EXPECT_EQ(this->Run(empty), 1);
  this->ExpectEmptyOutputs();
}

TEST_P(FailureRule, PointsWithoutPolygonsAreRefused)
{
  auto data = Surface(GeodesicSphere(2));
  data->SetPolys(vtkNew<vtkCellArray>());
  this->ExpectRefused(data, "no polygons");
}

TEST_P(FailureRule, OnlyLinesAreRefused)
{
  auto data = Surface(GeodesicSphere(2));
  data->SetPolys(vtkNew<vtkCellArray>());
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1 });
  data->SetLines(lines);
  this->ExpectRefused(data, "no polygons");
}

TEST_P(FailureRule, ACellWithAWrongPointIsRefused)
{
  auto data = Surface(GeodesicSphere(2));
  data->GetPolys()->InsertNextCell({ 0, 1, 100000 });
  this->ExpectRefused(data, "uses point 100000");
}

TEST_P(FailureRule, CellsThatDoNotFitTheirCornersAreRefused)
{
  const auto set = [](vtkCellArray* cells, std::initializer_list<vtkTypeInt64> offsets)
  {
    vtkNew<vtkTypeInt64Array> begin;
    vtkNew<vtkTypeInt64Array> corners;
    for (const vtkTypeInt64 offset : offsets)
    {
      begin->InsertNextValue(offset);
    }
    for (const vtkTypeInt64 corner : { 0, 1, 2, 0, 2, 3 })
    {
      corners->InsertNextValue(corner);
    }
    cells->SetData(begin, corners);
  };
  auto data = Surface(GeodesicSphere(2));
  const std::initializer_list<vtkTypeInt64> wrong[] = { { 0, 3, 9 }, { 0, 3 }, { 3, 6 },
    { 0, 6, 3 }, { 0, -3, 6 } };
  for (const auto& offsets : wrong)
  {
    vtkNew<vtkCellArray> cells;
    set(cells, offsets);
    for (const bool areStrips : { false, true })
    {
      vtkNew<vtkPolyData> damaged;
      damaged->ShallowCopy(data);
      areStrips ? damaged->SetStrips(cells) : damaged->SetPolys(cells);
      this->ExpectRefused(
        damaged, areStrips ? "triangle strips of the input" : "polygons of the input");
    }
  }
}

TEST_P(FailureRule, OneTriangleIsComputed)
{
  this->ExpectComputed(Surface({ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 } } }));
}

TEST_P(FailureRule, OnlyTrianglesWithoutAreaAreRefused)
{
  this->ExpectRefused(
    Surface({ { { 0, 0, 0 }, { 1, 1, 1 }, { 3, 3, 3 } }, { { 0, 1, 2 } } }), "no area");
}

TEST_P(FailureRule, ASliverIsComputedUntilItIsRounding)
{
  const auto sliver = [](double height) {
    return Surface({ { { 0, 0, 0 }, { 1, 1, 1 }, { 0.5, 0.5, 0.5 + height } }, { { 0, 1, 2 } } });
  };
  // With hats, the limit on the long side allows for entries that are larger by the squared inverse
  // of the height.
  const bool isOnHats = filter->GetFunctionSpace() == vtkSurfaceFEMAlgorithm::HatFunctions;
  this->ExpectComputed(sliver(isOnHats ? 1e-6 : 1e-9));
  this->ExpectRefused(sliver(1e-12), "no area");
}

TEST_P(FailureRule, CoordinatesOutsideTheRangeOfNumbersAreRefused)
{
  for (const double scale : { 1e300, 1e-300 })
  {
    this->ExpectRefused(
      Surface({ { { 0, 0, 0 }, { scale, 0, 0 }, { 0, scale, 0 } }, { { 0, 1, 2 } } }),
      "Scale it first");
  }
}

TEST_P(FailureRule, TrianglesWithoutAreaAmongOthersAreComputed)
{
  TriangleMesh mesh = GeodesicSphere(4);
  mesh.triangles.push_back({ 0, 0, 1 });
  mesh.triangles.push_back({ 2, 2, 2 });
  this->ExpectComputed(Surface(mesh));
}

TEST_P(FailureRule, NaNCoordinatesAreRefused)
{
  TriangleMesh mesh = GeodesicSphere(3);
  mesh.points[5][1] = std::nan("");
  this->ExpectRefused(Surface(mesh), "oint 5 ");
}

TEST_P(FailureRule, InfiniteCoordinatesAreRefused)
{
  TriangleMesh mesh = GeodesicSphere(3);
  mesh.points[5][1] = INFINITY;
  this->ExpectRefused(Surface(mesh), "oint 5 ");
}

TEST_P(FailureRule, AnUnreferencedPointMayBeNaN)
{
  TriangleMesh mesh = GeodesicSphere(4);
  mesh.points.push_back({ std::nan(""), 0, 0 });
  auto data = Surface(mesh);
  AddPointArray(data, "f", 1, [](const Vec3& p, int) { return std::isnan(p[0]) ? 7.0 : p[0]; });
  ChooseArray(filter);
  if (!filter->IsA("vtkHarmonicInterpolation"))
  {
    this->ExpectComputed(data);
    return;
  }
  EXPECT_EQ(this->Run(data), 1);
  auto values = PointValues(filter->GetOutputDataObject(0), "Interpolated");
  ASSERT_FALSE(values.empty());
  EXPECT_TRUE(std::isnan(values.back())); // no triangle reaches the point
  values.pop_back();
  EXPECT_TRUE(AllFinite(values));
}

TEST_P(FailureRule, DuplicatePointsAreComputed)
{
  this->ExpectComputed(Surface(Unweld(GeodesicSphere(4))));
}

TEST_P(FailureRule, NonManifoldAndBadlyOrientedMeshesAreComputed)
{
  TriangleMesh mesh = GeodesicSphere(4);
  mesh.points.push_back({ 2, 2, 2 });
  const auto triangle = mesh.triangles[0]; // a copy: the list grows below
  mesh.triangles.push_back({ triangle[0], triangle[1], Id(mesh.points.size()) - 1 });
  mesh.triangles.push_back(triangle);
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  this->ExpectComputed(Surface(mesh));
}

TEST_P(FailureRule, ADepthBeyondMemoryIsRefusedWithTheEstimate)
{
  filter->SetDepth(14); // about 1.6e9 cells: more than a terabyte
  const bool isOnHats = filter->GetFunctionSpace() == vtkSurfaceFEMAlgorithm::HatFunctions;
  const bool needsNoGrid = NeedsNoFunctions(filter);
  if (needsNoGrid || (isOnHats && !filter->IsA("vtkGeodesicDistance"))) // whose heat flows on it
  {
    this->ExpectComputed(Surface(GeodesicSphere(8))); // hats are over a grid that is as coarse
    return;
  }
  this->ExpectRefused(Surface(GeodesicSphere(8)), "Depth 14 (about", "GB");
}

TEST_P(FailureRule, AnUnknownQuadratureDegreeIsRefused)
{
  filter->SetQuadratureDegree(3);
  if (filter->IsA("vtkConnectivityAwareBasis") || NeedsNoFunctions(filter))
  {
    this->ExpectComputed(Surface(GeodesicSphere(4))); // they integrate nothing
    return;
  }
  this->ExpectRefused(Surface(GeodesicSphere(4)), "quadrature rule of degree 3");
}

TEST_P(FailureRule, AnAbortGivesEmptyOutputs)
{
  vtkNew<vtkCallbackCommand> abortOnce;
  abortOnce->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      vtkAlgorithm::SafeDownCast(caller)->AbortExecuteOn();
      caller->RemoveObservers(vtkCommand::ProgressEvent);
    });
  filter->AddObserver(vtkCommand::ProgressEvent, abortOnce);
  auto data = Surface(GeodesicSphere(4));
  EXPECT_EQ(this->Run(data), 1);
  EXPECT_TRUE(messages.errors.empty());
  this->ExpectEmptyOutputs();
  filter->Modified();
  this->ExpectComputed(data); // nothing half done is left
}

/// The stages of all filters.
constexpr const char* StagesOfAllFilters[] = { "Space", "System", "Hierarchy", "RightHandSide",
  "Solve", "Step", "HodgeDecomposition", "Metric", "Weights", "Signal", "Curve", "Cut" };

std::int64_t RunsOfStages(vtkSurfaceFEMAlgorithm* filter)
{
  std::int64_t runs = 0;
  for (const char* stage : StagesOfAllFilters)
  {
    runs += filter->GetNumberOfRuns(stage);
  }
  return runs;
}

/// A report of progress, with the number of stages done by then.
struct Report
{
  double progress;
  std::int64_t stages;
};

/// A filter reports this much progress at once.
constexpr double LeastStep = 0.02;

/// Records the reports of a filter, and aborts it at one of them.
class Course
{
public:
  explicit Course(vtkSurfaceFEMAlgorithm* filter) : filter_(filter)
  {
    vtkNew<vtkCallbackCommand> hear;
    hear->SetClientData(this);
    hear->SetCallback([](vtkObject*, unsigned long, void* self, void* progress)
      { static_cast<Course*>(self)->Hear(*static_cast<double*>(progress)); });
    observer_ = filter->AddObserver(vtkCommand::ProgressEvent, hear);
    this->Restart();
  }
  Course(const Course&) = delete;
  ~Course() { filter_->RemoveObserver(observer_); }

  /// Begins a new run, which is aborted at a report of the last one.
  void Restart(const Report& abortAt = { 2.0, 0 })
  {
    reports.clear();
    abortAt_ = abortAt;
    abortedAt = -1.0;
    stagesBefore_ = RunsOfStages(filter_);
  }

  std::vector<Report> reports;
  double abortedAt = -1.0; ///< the progress; negative: never

private:
  void Hear(double progress)
  {
    reports.push_back({ progress, RunsOfStages(filter_) - stagesBefore_ });
    // A slower run may report a little less instead, and skip the reports soon after it.
    if (abortedAt < 0.0 && progress > abortAt_.progress - LeastStep &&
        reports.back().stages >= abortAt_.stages)
    {
      abortedAt = progress;
      filter_->AbortExecuteOn();
    }
  }

  vtkSurfaceFEMAlgorithm* filter_;
  unsigned long observer_ = 0;
  Report abortAt_{};
  std::int64_t stagesBefore_ = 0;
};

/// Returns the first, a middle and the last report in each stage, and in the work after the last
/// stage.
std::vector<Report> ReportsOfStages(const std::vector<Report>& course)
{
  std::vector<Report> chosen;
  for (auto first = course.begin(); first != course.end();)
  {
    const auto end = std::find_if(
      first, course.end(), [first](const Report& other) { return other.stages != first->stages; });
    const auto size = end - first;
    chosen.push_back(*first);
    if (size > 2)
    {
      chosen.push_back(first[size / 2]);
    }
    if (size > 1)
    {
      chosen.push_back(first[size - 1]);
    }
    first = end;
  }
  return chosen;
}

TEST_P(FailureRule, ProgressRisesStrictlyFromZeroToOne)
{
  Course course(filter);
  for (int run = 0; run < 2; ++run)
  {
    course.Restart();
    filter->Modified();
    this->ExpectComputed(Surface(GeodesicSphere(4)));
    const std::vector<Report>& reports = course.reports;
    ASSERT_GE(reports.size(), 2u);
    EXPECT_GE(reports.front().progress, 0.0);
    for (std::size_t k = 1; k < reports.size(); ++k)
    {
      EXPECT_GT(reports[k].progress, reports[k - 1].progress) << k << " of " << reports.size();
    }
    EXPECT_EQ(reports.back().progress, 1.0);
    EXPECT_TRUE(run > 0 || reports.size() >= 5) << "a course, not only the two ends";
  }
}

/// Covers as many kinds of stages in less time.
void Shorten(vtkSurfaceFEMAlgorithm* filter)
{
  if (auto* flow = vtkMeanCurvatureFlow::SafeDownCast(filter))
  {
    flow->SetNumberOfSteps(3);
  }
  if (auto* spectrum = vtkSpectralSignatures::SafeDownCast(filter))
  {
    spectrum->SetNumberOfModes(20);
  }
}

TEST_P(FailureRule, AnAbortInAnyStageGivesEmptyOutputsAndLeavesNothingHalfDone)
{
  Shorten(filter);
  Course course(filter);
  auto data = Surface(GeodesicSphere(4));
  this->ExpectComputed(data);
  const std::vector<Contents> whole = this->OutputContents();
  course.reports.pop_back(); // the pipeline's own
  for (const Report& report : ReportsOfStages(course.reports))
  {
    SCOPED_TRACE(
      std::to_string(report.progress) + " after stages: " + std::to_string(report.stages));
    vtkNew<vtkPolyData> empty;
    this->Run(empty); // frees all stages
    course.Restart(report);
    this->ExpectAborted(data);
    EXPECT_GE(course.abortedAt, 0.0);
    EXPECT_LT(course.abortedAt, 1.0); // the pipeline's report at the end
    course.Restart();
    filter->Modified();
    this->ExpectComputed(data); // goes on from the stages that were done
    this->ExpectOutputs(whole);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20230111)
    EXPECT_EQ(filter->GetOutputInformation(0)->Get(vtkAlgorithm::ABORTED()), 0);
#endif
  }
}

TEST_P(FailureRule, AFailurePrintsOneMessageAndSetsTheErrorCode)
{
  vtkSmartPointer<vtkOutputWindow> former = vtkOutputWindow::GetInstance();
  auto filterThatPrints = MakeFilter(GetParam());
  auto data = Surface(GeodesicSphere(2));
  data->SetPolys(vtkNew<vtkCellArray>());
  filterThatPrints->SetInputDataObject(0, data);
  for (int run = 0; run < 2; ++run)
  {
    vtkNew<vtkStringOutputWindow> window;
    vtkOutputWindow::SetInstance(window);
    filterThatPrints->Modified();
    EXPECT_EQ(filterThatPrints->GetExecutive()->Update(), 0);
    const std::string text = window->GetOutput();
    EXPECT_NE(text.find("no polygons"), std::string::npos) << text;
    EXPECT_EQ(text.find("returned failure"), std::string::npos) << text;
    EXPECT_NE(filterThatPrints->GetErrorCode(), vtkErrorCode::NoError);
  }
  EXPECT_FALSE(filterThatPrints->GetExecutive()->HasObserver(vtkCommand::ErrorEvent));
  filterThatPrints->SetInputDataObject(0, Surface(GeodesicSphere(4)));
  EXPECT_EQ(filterThatPrints->GetExecutive()->Update(), 1);
  EXPECT_EQ(filterThatPrints->GetErrorCode(), vtkErrorCode::NoError);
  vtkOutputWindow::SetInstance(former);
}

TEST_P(FailureRule, MemoryIsFreedOnAnEmptyInput)
{
  auto data = Surface(GeodesicSphere(4));
  this->ExpectComputed(data);
  vtkNew<vtkPolyData> empty;
  this->Run(empty);
  this->ExpectComputed(data);
  EXPECT_EQ(filter->GetNumberOfRuns(FirstStageOf(filter)), 2);
}

TEST_P(FailureRule, AReleasedOutputLeavesNothingToGoOnFrom)
{
  auto data = Surface(GeodesicSphere(4));
  filter->ReleaseDataFlagOn();
  this->ExpectComputed(data);
  const std::vector<Contents> first = this->OutputContents();
  filter->Modified();
  this->ExpectComputed(data);
  this->ExpectOutputs(first);
  EXPECT_EQ(filter->GetNumberOfRuns(FirstStageOf(filter)), 2);
  filter->ReleaseDataFlagOff();
  for (int run = 0; run < 2; ++run)
  {
    filter->Modified();
    this->ExpectComputed(data);
    this->ExpectOutputs(first);
  }
  EXPECT_EQ(filter->GetNumberOfRuns(FirstStageOf(filter)), 3);
}

TEST_P(FailureRule, ThreadsRepeatNoStage)
{
  auto data = Surface(GeodesicSphere(4));
  filter->SetNumberOfThreads(1);
  this->ExpectComputed(data);
  filter->SetNumberOfThreads(2);
  this->ExpectComputed(data);
  for (const char* stage : Stages)
  {
    EXPECT_LE(filter->GetNumberOfRuns(stage), 1) << stage;
  }
}

TEST_P(FailureRule, TheInputIsNotChanged)
{
  auto data = Surface(GeodesicSphere(4));
  const Contents before = ContentsOf(data);
  this->ExpectComputed(data);
  ExpectSame(ContentsOf(data), before);
}

/// A surface without symmetry, and thus without multiplets and without points that are equally far
/// from others.
TriangleMesh Potato()
{
  return Mapped(GeodesicSphere(6),
    [](const Vec3& p)
    {
      return Vec3(
        p[0] + 0.1 * p[1] * p[2], 0.8 * p[1] + 0.07 * p[0] * p[0], 0.6 * p[2] - 0.05 * p[1]);
    });
}

/// The results of a run, in a unit of length in which the surface has not moved.
using Results = std::map<std::string, std::vector<double>>;

void Scale(std::vector<double>& values, double factor)
{
  for (double& value : values)
  {
    value *= factor;
  }
}

/// Returns all result arrays, and the points.
Results ResultsOf(vtkPolyData* output, vtkPolyData* input, double scale, const Vec3& shift)
{
  Results results;
  for (vtkDataArray* array : AddedArrays(output->GetPointData(), input->GetPointData()))
  {
    if (IsOneOfSeveral(array->GetName()))
    {
      continue;
    }
    std::vector<double>& values = results[std::string("point ") + array->GetName()];
    values = Values(array);
    Scale(values, std::pow(scale, -PowerOfLength(array->GetName())));
  }
  for (vtkDataArray* array : AddedArrays(output->GetCellData(), input->GetCellData()))
  {
    std::vector<double>& values = results[std::string("cell ") + array->GetName()];
    values = Values(array);
    Scale(values, std::pow(scale, -PowerOfLength(array->GetName())));
  }
  std::vector<double>& places = results["points"];
  places = Values(output->GetPoints()->GetData());
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    places[k] = (places[k] - shift[static_cast<Id>(k % 3)]) / scale;
  }
  return results;
}

/// Returns the properties of a clip that do not depend on its cut points.
Results FactsOf(vtkPolyData* clipped, double scale)
{
  double area = 0.0;
  for (vtkIdType cell = 0; cell < clipped->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> ids;
    clipped->GetCellPoints(cell, ids);
    const Vec3 a(clipped->GetPoint(ids->GetId(0)));
    const Vec3 b(clipped->GetPoint(ids->GetId(1)));
    const Vec3 c(clipped->GetPoint(ids->GetId(2)));
    area += 0.5 * ((b - a) / scale).cross((c - a) / scale).norm();
  }
  return { { "polygons", { double(clipped->GetNumberOfPolys()) } }, { "area", { area } } };
}

/// Runs a filter on a surface that a map has moved. The surface has arrays from before the motion.
Results RunMoved(const FilterCase& filterCase, double scale, const Vec3& shift)
{
  const TriangleMesh potato = Potato();
  auto data = Surface(potato);
  AddPointArray(data, "f", 1, [](const Vec3& p, int) { return p[2] + 0.3 * p[0]; });
  data->SetPoints(ToPolyData(Transform(potato, { 0, 0, 1 }, 0.0, scale, shift))->GetPoints());
  auto filter = MakeFilter(filterCase);
  filter->SetTolerance(1e-10); // the iteration's error is not compared
  ChooseArray(filter);
  SetLikeReference(filter, potato);
  filter->SetInputDataObject(0, data);
  EXPECT_EQ(filter->GetExecutive()->Update(), 1);
  auto* output = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
  EXPECT_NE(FieldValue(output, "Converged"), 0.0); // NaN if the filter has no such array
  return IsClip(filter) ? FactsOf(output, scale) : ResultsOf(output, data, scale, shift);
}

/// Turns vectors that have no sense of direction, so that they point as the expected ones.
void Turn(std::vector<double>& vectors, const std::vector<double>& expected)
{
  for (std::size_t k = 0; k + 2 < std::min(vectors.size(), expected.size()); k += 3)
  {
    const Vec3 a(vectors[k], vectors[k + 1], vectors[k + 2]);
    const double sign =
      a.dot(Vec3(expected[k], expected[k + 1], expected[k + 2])) < 0.0 ? -1.0 : 1.0;
    for (std::size_t c = 0; c < 3; ++c)
    {
      vectors[k + c] *= sign;
    }
  }
}

/// Whether an array has numbers of parts, which are all 0 if there is one part.
bool HasNumbersOfParts(const std::string& name)
{
  return name == "cell ChartId";
}

/// Compares arrays, relative to their largest values.
void ExpectEqual(Results results, const Results& expected, double tolerance)
{
  ASSERT_FALSE(expected.empty());
  EXPECT_EQ(results.size(), expected.size());
  for (const auto& [name, values] : expected)
  {
    ASSERT_FALSE(values.empty()) << name;
    EXPECT_TRUE(AllFinite(values)) << name;
    std::vector<double>& found = results[name];
    if (name.find("Direction") != std::string::npos)
    {
      Turn(found, values);
    }
    const double largest = Difference(values, std::vector<double>(values.size(), 0.0));
    EXPECT_TRUE(largest > 0.0 || HasNumbersOfParts(name)) << name;
    EXPECT_LE(Difference(found, values), tolerance * largest) << name;
  }
}

TEST_P(FailureRule, FarTinyAndHugeMeshesGiveTheSameResult)
{
  const Results plain = RunMoved(GetParam(), 1.0, { 0, 0, 0 });
  // The coordinates at 5e6 have ten digits left below 1; the solution may be off by as much, times
  // the condition of slivers and the solver's tolerance. Powers of two would be exact; 1e9 is not.
  ExpectEqual(RunMoved(GetParam(), 1.0, { 5e6, -5e6, 5e6 }), plain, 1e-6);
  // Rounding decides which pivots of an element below 1e-12 count in a random field. A field is
  // their root.
  const double tolerance = std::string(GetParam().name) == "GaussianField" ? 1e-6 : 1e-7;
  for (const double scale : { 1e-9, 1e9 })
  {
    SCOPED_TRACE(scale);
    ExpectEqual(RunMoved(GetParam(), scale, { 0, 0, 0 }), plain, tolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(AllFilters, FailureRule, AllFilters(), NameOf);

// Poisson is among all filters.
INSTANTIATE_TEST_SUITE_P(HatFunctions, FailureRule,
  ::testing::Values(FilterCase{ "GeodesicDistance", &MakeOnHats<vtkGeodesicDistance> },
    FilterCase{ "HeatDiffusion", &MakeOnHats<vtkHeatDiffusion> },
    FilterCase{ "LaplaceSpectrum", &MakeOnHats<vtkLaplaceSpectrum> },
    FilterCase{ "MeanCurvatureFlow", &MakeOnHats<vtkMeanCurvatureFlow> },
    FilterCase{ "SpectralSignatures", &MakeOnHats<vtkSpectralSignatures> }),
  NameOf);

} // namespace
