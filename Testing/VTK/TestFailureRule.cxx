// The failure rule of DESIGN §4, for every filter: what is unusable is refused with one message and
// empty outputs, what is merely odd is computed.

#include "FilterSupport.h"

#include "vtkClipToOctree.h"
#include "vtkConnectivityAwareBasis.h"
#include "vtkGeodesicDistance.h"
#include "vtkHeatDiffusion.h"
#include "vtkLaplaceSpectrum.h"
#include "vtkMeanCurvatureFlow.h"
#include "vtkPrincipalCurvatures.h"
#include "vtkScreenedPoisson.h"
#include "vtkSpectralSignatures.h"
#include "vtkSurfaceDetail.h"
#include "vtkSurfaceGradient.h"

#include "vtkErrorCode.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkStringArray.h"
#include "vtkStringOutputWindow.h"
#include "vtkVersionMacros.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

using FilterMaker = vtkSmartPointer<vtkSurfaceFEMAlgorithm> (*)();

template<class Filter>
vtkSmartPointer<vtkSurfaceFEMAlgorithm> Make()
{
  return vtkSmartPointer<Filter>::New();
}

template<class Filter>
vtkSmartPointer<vtkSurfaceFEMAlgorithm> MakeOnHats()
{
  auto filter = Make<Filter>();
  filter->SetFunctionSpace(vtkSurfaceFEMAlgorithm::HatFunctions);
  return filter;
}

vtkSmartPointer<vtkSurfaceFEMAlgorithm> MakeClip()
{
  auto filter = vtkSmartPointer<vtkClipToOctree>::New();
  filter->GenerateQuadraturePointsOn(); // so that no output is empty
  return filter;
}

vtkSmartPointer<vtkSurfaceFEMAlgorithm> MakeCurvatures()
{
  auto filter = vtkSmartPointer<vtkPrincipalCurvatures>::New();
  filter->SetSmoothingScale(0.1); // else it takes no grid
  return filter;
}

struct FilterCase
{
  const char* name;
  FilterMaker make;
  const char* result; // point array of output 0 to compare, if any
};

void PrintTo(const FilterCase& filter, std::ostream* stream)
{
  *stream << filter.name;
}

class FailureRule : public ::testing::TestWithParam<FilterCase>
{
protected:
  FailureRule() : filter(GetParam().make()), messages(filter) { filter->SetDepth(4); }

  int Run(vtkPolyData* input)
  {
    filter->SetInputDataObject(0, input);
    return filter->GetExecutive()->Update();
  }

  void ExpectRefused(vtkPolyData* input, const std::string& reason)
  {
    EXPECT_EQ(this->Run(input), 0);
    ASSERT_EQ(messages.errors.size(), 1u);
    EXPECT_NE(messages.errors[0].find(reason), std::string::npos) << messages.errors[0];
    this->ExpectEmptyOutputs();
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
    if (GetParam().result)
    {
      const auto values = PointValues(filter->GetOutputDataObject(0), GetParam().result);
      EXPECT_FALSE(values.empty());
      EXPECT_TRUE(AllFinite(values));
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
  this->ExpectComputed(ToPolyData(GeodesicSphere(4)));
  vtkNew<vtkPolyData> empty;
  EXPECT_EQ(this->Run(empty), 1);
  this->ExpectEmptyOutputs();
}

TEST_P(FailureRule, PointsWithoutPolygonsAreRefused)
{
  auto data = ToPolyData(GeodesicSphere(2));
  data->SetPolys(vtkNew<vtkCellArray>());
  this->ExpectRefused(data, "no polygons");
}

TEST_P(FailureRule, OnlyLinesAreRefused)
{
  auto data = ToPolyData(GeodesicSphere(2));
  data->SetPolys(vtkNew<vtkCellArray>());
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1 });
  data->SetLines(lines);
  this->ExpectRefused(data, "no polygons");
}

TEST_P(FailureRule, ACellWithAWrongPointIsRefused)
{
  auto data = ToPolyData(GeodesicSphere(2));
  data->GetPolys()->InsertNextCell({ 0, 1, 100000 });
  this->ExpectRefused(data, "uses point 100000");
}

TEST_P(FailureRule, OneTriangleIsComputed)
{
  this->ExpectComputed(ToPolyData({ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 } } }));
}

TEST_P(FailureRule, OnlyTrianglesWithoutAreaAreRefused)
{
  this->ExpectRefused(
    ToPolyData({ { { 0, 0, 0 }, { 1, 1, 1 }, { 3, 3, 3 } }, { { 0, 1, 2 } } }), "no area");
}

TEST_P(FailureRule, ASliverIsComputedUntilItIsRounding)
{
  const auto sliver = [](double height)
  {
    return ToPolyData(
      { { { 0, 0, 0 }, { 1, 1, 1 }, { 0.5, 0.5, 0.5 + height } }, { { 0, 1, 2 } } });
  };
  // On hats the long side is what entries leave that are larger by the squared inverse of the
  // height.
  const bool isOnHats = filter->GetFunctionSpace() == vtkSurfaceFEMAlgorithm::HatFunctions;
  this->ExpectComputed(sliver(isOnHats ? 1e-6 : 1e-9));
  this->ExpectRefused(sliver(1e-12), "no area");
}

TEST_P(FailureRule, CoordinatesOutsideTheRangeOfNumbersAreRefused)
{
  for (const double scale : { 1e300, 1e-300 })
  {
    messages.errors.clear();
    this->ExpectRefused(
      ToPolyData({ { { 0, 0, 0 }, { scale, 0, 0 }, { 0, scale, 0 } }, { { 0, 1, 2 } } }),
      "Scale it first");
  }
}

TEST_P(FailureRule, TrianglesWithoutAreaAmongOthersAreComputed)
{
  TriangleMesh mesh = GeodesicSphere(4);
  mesh.triangles.push_back({ 0, 0, 1 });
  mesh.triangles.push_back({ 2, 2, 2 });
  this->ExpectComputed(ToPolyData(mesh));
}

TEST_P(FailureRule, NaNCoordinatesAreRefused)
{
  TriangleMesh mesh = GeodesicSphere(3);
  mesh.points[5][1] = std::nan("");
  this->ExpectRefused(ToPolyData(mesh), "5");
}

TEST_P(FailureRule, InfiniteCoordinatesAreRefused)
{
  TriangleMesh mesh = GeodesicSphere(3);
  mesh.points[5][1] = INFINITY;
  this->ExpectRefused(ToPolyData(mesh), "5");
}

TEST_P(FailureRule, AnUnreferencedPointMayBeNaN)
{
  TriangleMesh mesh = GeodesicSphere(4);
  mesh.points.push_back({ std::nan(""), 0, 0 });
  auto data = ToPolyData(mesh);
  AddPointArray(data, "f", 1, [](const Vec3& p, int) { return std::isnan(p[0]) ? 7.0 : p[0]; });
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "f");
  this->ExpectComputed(data);
}

TEST_P(FailureRule, DuplicatePointsAreComputed)
{
  this->ExpectComputed(ToPolyData(Unweld(GeodesicSphere(4))));
}

TEST_P(FailureRule, NonManifoldAndBadlyOrientedMeshesAreComputed)
{
  TriangleMesh mesh = GeodesicSphere(4);
  mesh.points.push_back({ 2, 2, 2 });
  const auto triangle = mesh.triangles[0]; // a copy: the list grows below
  mesh.triangles.push_back({ triangle[0], triangle[1], Id(mesh.points.size()) - 1 });
  mesh.triangles.push_back(triangle);
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  this->ExpectComputed(ToPolyData(mesh));
}

TEST_P(FailureRule, ADepthBeyondMemoryIsRefusedWithTheEstimate)
{
  filter->SetDepth(14); // about 1.6e9 cells: more than a terabyte
  const bool isOnHats = filter->GetFunctionSpace() == vtkSurfaceFEMAlgorithm::HatFunctions;
  if (isOnHats && !filter->IsA("vtkGeodesicDistance")) // whose heat flows on the grid
  {
    this->ExpectComputed(ToPolyData(GeodesicSphere(8))); // over a grid that is as coarse
    return;
  }
  this->ExpectRefused(ToPolyData(GeodesicSphere(8)), "Depth 14 (about");
  EXPECT_NE(messages.errors[0].find("GB"), std::string::npos);
}

TEST_P(FailureRule, AnUnknownQuadratureDegreeIsRefused)
{
  filter->SetQuadratureDegree(3);
  if (filter->IsA("vtkConnectivityAwareBasis"))
  {
    this->ExpectComputed(ToPolyData(GeodesicSphere(4))); // it integrates nothing
    return;
  }
  this->ExpectRefused(ToPolyData(GeodesicSphere(4)), "3");
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
  auto data = ToPolyData(GeodesicSphere(4));
  EXPECT_EQ(this->Run(data), 1);
  EXPECT_TRUE(messages.errors.empty());
  this->ExpectEmptyOutputs();
  filter->Modified();
  this->ExpectComputed(data); // nothing half done is left
}

/// Records the progress of a filter, and aborts it at a progress.
struct ProgressRecord
{
  std::vector<double> progress;
  double abortAt = 2.0;
  double abortedAt = -1.0;

  static void Add(vtkObject* caller, unsigned long, void* self, void* fraction)
  {
    auto* record = static_cast<ProgressRecord*>(self);
    record->progress.push_back(*static_cast<double*>(fraction));
    if (record->progress.back() >= record->abortAt && record->abortedAt < 0.0)
    {
      record->abortedAt = record->progress.back();
      vtkAlgorithm::SafeDownCast(caller)->AbortExecuteOn();
    }
  }
};

TEST_P(FailureRule, ProgressRisesStrictlyFromZeroToOne)
{
  ProgressRecord record;
  vtkNew<vtkCallbackCommand> add;
  add->SetClientData(&record);
  add->SetCallback(&ProgressRecord::Add);
  filter->AddObserver(vtkCommand::ProgressEvent, add);
  for (int run = 0; run < 2; ++run)
  {
    record.progress.clear();
    filter->Modified();
    this->ExpectComputed(ToPolyData(GeodesicSphere(4)));
    ASSERT_GE(record.progress.size(), 2u);
    EXPECT_GE(record.progress.front(), 0.0);
    for (std::size_t k = 1; k < record.progress.size(); ++k)
    {
      EXPECT_GT(record.progress[k], record.progress[k - 1])
        << k << " of " << record.progress.size();
    }
    EXPECT_EQ(record.progress.back(), 1.0);
    EXPECT_TRUE(run > 0 || record.progress.size() >= 5) << "a course, not only the two ends";
  }
}

TEST_P(FailureRule, AnAbortAtAnyProgressGivesEmptyOutputs)
{
  ProgressRecord record;
  vtkNew<vtkCallbackCommand> add;
  add->SetClientData(&record);
  add->SetCallback(&ProgressRecord::Add);
  filter->AddObserver(vtkCommand::ProgressEvent, add);
  filter->KeepStagesOff(); // so that every run is the same
  auto data = ToPolyData(GeodesicSphere(4));
  this->ExpectComputed(data);
  const std::vector<double> course = record.progress; // the last is the pipeline's own
  ASSERT_GE(course.size(), 3u);
  // A slower run may tell of a little less instead, and pass over what comes within this of it.
  constexpr double leastStep = 0.02;
  for (const double point :
    { course.front(), course[course.size() / 2], course[course.size() - 2] })
  {
    const double at = std::max(course.front(), point - leastStep);
    record = {};
    record.abortAt = at;
    filter->Modified();
    EXPECT_EQ(this->Run(data), 1);
    EXPECT_GE(record.abortedAt, at);
    EXPECT_LT(record.abortedAt, 1.0) << at; // what the pipeline reports when all is done
    EXPECT_TRUE(messages.errors.empty());
    this->ExpectEmptyOutputs();
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20230111)
    EXPECT_EQ(filter->GetOutputInformation(0)->Get(vtkAlgorithm::ABORTED()), 1);
#endif
    filter->Modified();
    this->ExpectComputed(data); // nothing half done is left
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20230111)
    EXPECT_EQ(filter->GetOutputInformation(0)->Get(vtkAlgorithm::ABORTED()), 0);
#endif
  }
}

TEST_P(FailureRule, AFailurePrintsOneMessageAndSetsTheErrorCode)
{
  vtkSmartPointer<vtkOutputWindow> former = vtkOutputWindow::GetInstance();
  auto filterThatPrints = GetParam().make();
  filterThatPrints->SetDepth(4);
  auto data = ToPolyData(GeodesicSphere(2));
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
  filterThatPrints->SetInputDataObject(0, ToPolyData(GeodesicSphere(4)));
  EXPECT_EQ(filterThatPrints->GetExecutive()->Update(), 1);
  EXPECT_EQ(filterThatPrints->GetErrorCode(), vtkErrorCode::NoError);
  vtkOutputWindow::SetInstance(former);
}

TEST_P(FailureRule, MemoryIsFreedOnAnEmptyInput)
{
  auto data = ToPolyData(GeodesicSphere(4));
  this->ExpectComputed(data);
  vtkNew<vtkPolyData> empty;
  this->Run(empty);
  this->ExpectComputed(data);
  EXPECT_EQ(filter->GetNumberOfRuns("Space"), 2);
}

TEST_P(FailureRule, WithoutKeptStagesEveryRunIsAFirstOne)
{
  auto data = ToPolyData(GeodesicSphere(4));
  this->ExpectComputed(data);
  const auto kept = GetParam().result
                      ? PointValues(filter->GetOutputDataObject(0), GetParam().result)
                      : std::vector<double>{};
  filter->KeepStagesOff();
  for (int run = 1; run < 3; ++run)
  {
    filter->Modified();
    this->ExpectComputed(data);
    if (GetParam().result)
    {
      EXPECT_EQ(PointValues(filter->GetOutputDataObject(0), GetParam().result), kept);
    }
  }
  EXPECT_GE(filter->GetNumberOfRuns("Space"), 2);
}

TEST_P(FailureRule, AReleasedOutputLeavesNothingToGoOnFrom)
{
  auto data = ToPolyData(GeodesicSphere(4));
  filter->ReleaseDataFlagOn();
  for (int run = 1; run < 3; ++run)
  {
    filter->Modified();
    this->ExpectComputed(data);
    EXPECT_EQ(filter->GetNumberOfRuns("Space"), run);
  }
  filter->ReleaseDataFlagOff();
  filter->Modified();
  this->ExpectComputed(data);
  filter->Modified();
  this->ExpectComputed(data);
  EXPECT_EQ(filter->GetNumberOfRuns("Space"), 3);
}

TEST_P(FailureRule, ThreadsRepeatNoStage)
{
  auto data = ToPolyData(GeodesicSphere(4));
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
  auto data = ToPolyData(GeodesicSphere(4));
  this->ExpectComputed(data);
  EXPECT_EQ(data->GetPointData()->GetNumberOfArrays(), 0);
  EXPECT_EQ(data->GetCellData()->GetNumberOfArrays(), 0);
  EXPECT_EQ(data->GetFieldData()->GetNumberOfArrays(), 0);
}

/// An ellipsoid, whose modes are no multiplets, with an array of it before it was moved, run in its
/// own place; the values of the result array.
std::vector<double> RunMoved(const FilterCase& filterCase, double scale, const Vec3& shift)
{
  TriangleMesh ellipsoid = GeodesicSphere(6);
  for (Vec3& point : ellipsoid.points)
  {
    point = point.cwiseProduct(Vec3(1.0, 0.8, 0.6));
  }
  auto data = ToPolyData(Transform(ellipsoid, { 0, 0, 1 }, 0.0, scale, shift));
  auto* f = AddPointArray(data, "f", 1, [](const Vec3&, int) { return 0.0; });
  for (std::size_t k = 0; k < ellipsoid.points.size(); ++k)
  {
    f->SetValue(k, ellipsoid.points[k][2] + 0.3 * ellipsoid.points[k][0]);
  }
  auto filter = filterCase.make();
  filter->SetDepth(4);
  filter->SetTolerance(1e-10); // what is left of the iteration is not compared
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "f");
  filter->SetInputDataObject(0, data);
  filter->Update();
  if (!filterCase.result)
  {
    return { double(
      vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0))->GetNumberOfPolys()) };
  }
  return PointValues(filter->GetOutputDataObject(0), filterCase.result);
}

TEST_P(FailureRule, FarTinyAndHugeMeshesGiveTheSameResult)
{
  const auto plain = RunMoved(GetParam(), 1.0, { 0, 0, 0 });
  // The coordinates at 5e6 have ten digits left below 1; the solution may be off by as much, times
  // the condition of slivers and the solver's tolerance. Powers of two would be exact; 1e9 is not.
  EXPECT_LT(Difference(RunMoved(GetParam(), 1.0, { 5e6, -5e6, 5e6 }), plain), 1e-6);
  // Modes have unit norm in world units: the constant one is 1 / sqrt(area).
  const bool isMode = GetParam().result && std::string(GetParam().result) == "Mode";
  for (const double scale : { 1e-9, 1e9 })
  {
    auto scaled = RunMoved(GetParam(), scale, { 0, 0, 0 });
    for (double& value : scaled)
    {
      value *= isMode ? scale : 1.0;
    }
    EXPECT_LT(Difference(scaled, plain), 1e-7) << scale;
  }
}

INSTANTIATE_TEST_SUITE_P(AllFilters, FailureRule,
  ::testing::Values(FilterCase{ "ClipToOctree", &MakeClip, nullptr },
    FilterCase{ "ConnectivityAwareBasis", &Make<vtkConnectivityAwareBasis>, nullptr },
    FilterCase{ "ScreenedPoisson", &Make<vtkScreenedPoisson>, "Solution" },
    FilterCase{ "LaplaceSpectrum", &Make<vtkLaplaceSpectrum>, "Mode" },
    FilterCase{ "MeanCurvatureFlow", &Make<vtkMeanCurvatureFlow>, "ConformalFactor" },
    FilterCase{ "SpectralSignatures", &Make<vtkSpectralSignatures>, "HeatKernelSignature" },
    FilterCase{ "PrincipalCurvatures", &MakeCurvatures, nullptr },
    FilterCase{ "SurfaceDetail", &Make<vtkSurfaceDetail>, nullptr },
    FilterCase{ "SurfaceGradient", &Make<vtkSurfaceGradient>, nullptr },
    FilterCase{ "GeodesicDistance", &Make<vtkGeodesicDistance>, nullptr },
    FilterCase{ "GeodesicDistanceOnHats", &MakeOnHats<vtkGeodesicDistance>, nullptr },
    FilterCase{ "HeatDiffusion", &Make<vtkHeatDiffusion>, "Diffused" },
    FilterCase{ "HeatDiffusionOnHats", &MakeOnHats<vtkHeatDiffusion>, "Diffused" },
    FilterCase{ "ScreenedPoissonOnHats", &MakeOnHats<vtkScreenedPoisson>, "Solution" },
    FilterCase{ "LaplaceSpectrumOnHats", &MakeOnHats<vtkLaplaceSpectrum>, "Mode" },
    FilterCase{ "MeanCurvatureFlowOnHats", &MakeOnHats<vtkMeanCurvatureFlow>, "ConformalFactor" },
    FilterCase{
      "SpectralSignaturesOnHats", &MakeOnHats<vtkSpectralSignatures>, "HeatKernelSignature" }),
  [](const auto& filter) { return std::string(filter.param.name); });

} // namespace
