// The failure rule of DESIGN §4, for every filter: what is unusable is refused with one message and
// empty outputs, what is merely odd is computed.

#include "FilterSupport.h"

#include "vtkClipToOctree.h"
#include "vtkConnectivityAwareBasis.h"
#include "vtkLaplaceSpectrum.h"
#include "vtkMeanCurvatureFlow.h"
#include "vtkScreenedPoisson.h"
#include "vtkSpectralSignatures.h"

#include "vtkDummyCommunicator.h"
#include "vtkDummyController.h"
#include "vtkFloatArray.h"
#include "vtkObjectFactory.h"
#include "vtkStringArray.h"

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

/// Two ranks without MPI.
class TwoRanks : public vtkDummyCommunicator
{
public:
  static TwoRanks* New();
  vtkTypeMacro(TwoRanks, vtkDummyCommunicator);

protected:
  TwoRanks() { this->NumberOfProcesses = this->MaximumNumberOfProcesses = 2; }
};
vtkStandardNewMacro(TwoRanks);

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
  // The cotangents of flatter ones span more than the digits of a number.
  const bool isOnHats = filter->GetFunctionSpace() == vtkSurfaceFEMAlgorithm::HatFunctions;
  this->ExpectComputed(sliver(isOnHats ? 1e-7 : 1e-9));
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
  this->ExpectRefused(ToPolyData(GeodesicSphere(8)), "Depth 14 (about");
  EXPECT_NE(messages.errors[0].find("GB"), std::string::npos);
}

TEST_P(FailureRule, AnUnknownQuadratureDegreeIsRefused)
{
  filter->SetQuadratureDegree(3);
  if (std::string(GetParam().name) == "ConnectivityAwareBasis")
  {
    this->ExpectComputed(ToPolyData(GeodesicSphere(4))); // it integrates nothing
    return;
  }
  this->ExpectRefused(ToPolyData(GeodesicSphere(4)), "3");
}

TEST_P(FailureRule, MoreThanOneRankIsRefused)
{
  vtkNew<vtkDummyController> controller;
  controller->SetCommunicator(vtkNew<TwoRanks>());
  vtkMultiProcessController* former = vtkMultiProcessController::GetGlobalController();
  vtkMultiProcessController::SetGlobalController(controller);
  this->ExpectRefused(ToPolyData(GeodesicSphere(4)), "2 MPI ranks");
  vtkMultiProcessController::SetGlobalController(former);
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

TEST_P(FailureRule, ProgressRisesFromZeroToOne)
{
  std::vector<double> progress;
  vtkNew<vtkCallbackCommand> record;
  record->SetClientData(&progress);
  record->SetCallback([](vtkObject*, unsigned long, void* list, void* fraction)
    { static_cast<std::vector<double>*>(list)->push_back(*static_cast<double*>(fraction)); });
  filter->AddObserver(vtkCommand::ProgressEvent, record);
  this->ExpectComputed(ToPolyData(GeodesicSphere(4)));
  ASSERT_FALSE(progress.empty());
  EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
  EXPECT_GE(progress.front(), 0.0);
  EXPECT_LE(progress.back(), 1.0);
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
    FilterCase{ "ScreenedPoissonOnHats", &MakeOnHats<vtkScreenedPoisson>, "Solution" },
    FilterCase{ "LaplaceSpectrumOnHats", &MakeOnHats<vtkLaplaceSpectrum>, "Mode" },
    FilterCase{ "MeanCurvatureFlowOnHats", &MakeOnHats<vtkMeanCurvatureFlow>, "ConformalFactor" },
    FilterCase{
      "SpectralSignaturesOnHats", &MakeOnHats<vtkSpectralSignatures>, "HeatKernelSignature" }),
  [](const auto& filter) { return std::string(filter.param.name); });

} // namespace
