// The property Device of every filter, with the twin of the GPU for the threads of the host.
#include "AllFilters.h"
#include "Multigrid/Device.h"

#include "vtkAbstractArray.h"
#include "vtkFieldData.h"
#include "vtkStringArray.h"

#include <set>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// They need no cycles, or none by default, or report none.
const std::set<std::string> WithoutReport = { "ClipToOctree", "ConnectivityAwareBasis",
  "GeodesicPaths", "Parameterization", "PrincipalCurvatures" };

std::string DeviceOf(vtkAlgorithm* filter)
{
  vtkAbstractArray* const array =
    filter->GetOutputDataObject(0)->GetFieldData()->GetAbstractArray("Device");
  return array ? vtkStringArray::SafeDownCast(array)->GetValue(0) : "";
}

TriangleMesh BentTorus()
{
  return Mapped(Torus(40, 20, 1.0, 0.4), Bend);
}

vtkSmartPointer<vtkPolyData> Surface()
{
  const auto surface = ToPolyData(BentTorus());
  AddArraysOfAllFilters(surface);
  return surface;
}

vtkSmartPointer<vtkSurfaceFEMAlgorithm> RunOn(
  const FilterCase& given, vtkPolyData* surface, int device)
{
  const auto filter = given.make();
  SetLikeReference(filter, BentTorus());
  filter->SetInputDataObject(surface);
  filter->SetDepth(4);
  filter->SetTolerance(1e-9);
  filter->SetDevice(device);
  filter->Update();
  return filter;
}

} // namespace

class DeviceOfFilters : public ::testing::TestWithParam<FilterCase>
{
protected:
  void SetUp() override
  {
    std::string whyNot;
    UseDevice(OpenDevice(GRIDFEM_HOST_DEVICE, whyNot));
    ASSERT_EQ(whyNot, "");
  }
};

TEST_P(DeviceOfFilters, TheResultIsThatOfTheCpu)
{
  const bool hasReport = WithoutReport.count(GetParam().name) == 0;
  const auto surface = Surface();
  const auto onCpu = RunOn(GetParam(), surface, vtkSurfaceFEMAlgorithm::CPU);
  const auto onGpu = RunOn(GetParam(), surface, vtkSurfaceFEMAlgorithm::GPU);
  EXPECT_EQ(DeviceOf(onCpu), hasReport ? "CPU: Device is CPU" : "");
  EXPECT_EQ(DeviceOf(onGpu), hasReport ? "GPU: host" : "");
  vtkPointData* const expected =
    vtkPolyData::SafeDownCast(onCpu->GetOutputDataObject(0))->GetPointData();
  for (int k = 0; k < expected->GetNumberOfArrays(); ++k)
  {
    const std::string name = expected->GetArrayName(k);
    const std::vector<double> values = Values(expected->GetArray(k));
    const std::vector<double> others = PointValues(onGpu->GetOutputDataObject(0), name.c_str());
    ASSERT_EQ(values.size(), others.size()) << name;
    EXPECT_TRUE(IsOneOfSeveral(name) || Difference(values, others) < 1e-4) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, DeviceOfFilters, AllFilters(), NameOf);

TEST(Device, AutomaticLeavesSmallSurfacesToTheCpu)
{
  const auto surface = Surface();
  const FilterCase poisson{ "ScreenedPoisson", &Make<vtkScreenedPoisson> };
  const auto filter = RunOn(poisson, surface, vtkSurfaceFEMAlgorithm::AutomaticDevice);
  EXPECT_EQ(filter->GetDevice(), 0);
  EXPECT_EQ(DeviceOf(filter), "CPU: there are few functions");
  UseDevice(nullptr);
  filter->SetDevice(vtkSurfaceFEMAlgorithm::GPU);
  filter->Update();
  EXPECT_EQ(DeviceOf(filter), "CPU: no device is in use");
}
