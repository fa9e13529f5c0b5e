// Tests numbers that no panel would let through: NaN, infinity and numbers far out of range. Each
// is refused with one message that has the label of the property.

#include "FilterSupport.h"

#include "vtkGeodesicDistance.h"
#include "vtkHeatDiffusion.h"
#include "vtkLaplaceSpectrum.h"
#include "vtkMeanCurvatureFlow.h"
#include "vtkScreenedPoisson.h"
#include "vtkSpectralSignatures.h"

#include <gtest/gtest.h>

#include <limits>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

struct HostileCase
{
  const char* name; // the label of the property
  vtkSmartPointer<vtkSurfaceFEMAlgorithm> (*make)(double value);
};

template<class Filter, class Set>
vtkSmartPointer<vtkSurfaceFEMAlgorithm> With(Set&& set)
{
  auto filter = vtkSmartPointer<Filter>::New();
  set(filter.Get());
  return filter;
}

const HostileCase Cases[] = {
  { "Tolerance", [](double value)
    { return With<vtkScreenedPoisson>([=](auto* filter) { filter->SetTolerance(value); }); } },
  { "Tolerance", [](double value)
    { return With<vtkLaplaceSpectrum>([=](auto* filter) { filter->SetTolerance(value); }); } },
  { "Accuracy", [](double value)
    { return With<vtkScreenedPoisson>([=](auto* filter) { filter->SetAccuracy(value); }); } },
  { "Accuracy", [](double value)
    { return With<vtkHeatDiffusion>([=](auto* filter) { filter->SetAccuracy(value); }); } },
  { "Screening Weight",
    [](double value) {
      return With<vtkScreenedPoisson>([=](auto* filter) { filter->SetScreeningWeight(value); });
    } },
  { "Gradient Scale", [](double value)
    { return With<vtkScreenedPoisson>([=](auto* filter) { filter->SetGradientScale(value); }); } },
  { "Accuracy", [](double value)
    { return With<vtkLaplaceSpectrum>([=](auto* filter) { filter->SetAccuracy(value); }); } },
  { "Time Step", [](double value)
    { return With<vtkMeanCurvatureFlow>([=](auto* filter) { filter->SetTimeStep(value); }); } },
  { "Tolerance", [](double value)
    { return With<vtkMeanCurvatureFlow>([=](auto* filter) { filter->SetTolerance(value); }); } },
  { "Smoothing", [](double value)
    { return With<vtkGeodesicDistance>([=](auto* filter) { filter->SetSmoothing(value); }); } },
  { "Tolerance", [](double value)
    { return With<vtkGeodesicDistance>([=](auto* filter) { filter->SetTolerance(value); }); } },
  { "Diffusion Time", [](double value)
    { return With<vtkHeatDiffusion>([=](auto* filter) { filter->SetDiffusionTime(value); }); } },
  { "FWHM",
    [](double value)
    {
      return With<vtkHeatDiffusion>(
        [=](auto* filter)
        {
          filter->SetAmount(vtkHeatDiffusion::FullWidth);
          filter->SetFWHM(value);
        });
    } },
  { "Sigma",
    [](double value)
    {
      return With<vtkHeatDiffusion>(
        [=](auto* filter)
        {
          filter->SetAmount(vtkHeatDiffusion::StandardDeviation);
          filter->SetSigma(value);
        });
    } },
  { "Diffusion Time",
    [](double value)
    {
      return With<vtkSpectralSignatures>(
        [=](auto* filter)
        {
          filter->SetNumberOfModes(10);
          filter->AddSourcePointId(0);
          filter->SetDiffusionTime(value);
        });
    } },
};

class HostileProperties : public ::testing::TestWithParam<int>
{
};

TEST_P(HostileProperties, NaNIsRefusedByName)
{
  for (const HostileCase& hostile : Cases)
  {
    auto filter = hostile.make(NaN);
    filter->SetDepth(3);
    filter->SetFunctionSpace(this->GetParam());
    filter->SetInputDataObject(ToPolyData(GeodesicSphere(4)));
    ExpectRefused(filter, hostile.name);
  }
}

TEST_P(HostileProperties, InfinityIsRefusedByName)
{
  for (const HostileCase& hostile : Cases)
  {
    for (const double value : { Infinity, -Infinity })
    {
      auto filter = hostile.make(value);
      filter->SetDepth(3);
      filter->SetFunctionSpace(this->GetParam());
      filter->SetInputDataObject(ToPolyData(GeodesicSphere(4)));
      ExpectRefused(filter, hostile.name);
    }
  }
}

TEST_P(HostileProperties, WhatIsBelowTheLeastIsRefusedAndNotClamped)
{
  vtkNew<vtkScreenedPoisson> poisson;
  poisson->SetScreeningWeight(-1.0);
  vtkNew<vtkLaplaceSpectrum> spectrum;
  spectrum->SetMode(-2);
  vtkNew<vtkSpectralSignatures> signatures;
  signatures->SetNumberOfModes(10);
  signatures->SetDiffusionTime(-0.1);
  const std::pair<vtkSurfaceFEMAlgorithm*, const char*> cases[] = { { poisson,
                                                                      "Screening Weight is -1" },
    { spectrum, "Mode is -2" }, { signatures, "Diffusion Time is -0.1" } };
  for (const auto& [filter, message] : cases)
  {
    filter->SetDepth(3);
    filter->SetFunctionSpace(this->GetParam());
    filter->SetInputDataObject(ToPolyData(GeodesicSphere(4)));
    ExpectRefused(filter, message);
  }
}

TEST(HostileProperties, AValueInRangeIsUsableAgain)
{
  vtkNew<vtkHeatDiffusion> filter;
  filter->SetInputDataObject(ToPolyData(GeodesicSphere(4)));
  filter->SetDepth(4);
  filter->SetNumberOfSteps(2);
  filter->Update();
  const std::vector<double> expected = PointValues(filter->GetOutput(), "Diffused");
  ASSERT_FALSE(expected.empty());
  for (const auto& [depth, nearest] : { std::pair(15, 14), { -1, 0 }, { VTK_INT_MAX, 14 } })
  {
    filter->SetDepth(depth);
    EXPECT_EQ(filter->GetDepth(), nearest);
    ExpectRefused(filter, "Depth is ", "from 0 to 14");
    const Messages messages(filter);
    filter->SetDepth(nearest); // only asks for another run
    filter->SetDepth(4);
    filter->Update();
    EXPECT_EQ(PointValues(filter->GetOutput(), "Diffused"), expected);
    EXPECT_TRUE(messages.errors.empty());
  }
}

// Solvers that can end by their accuracy take a tolerance of 0, the others do not.
TEST(HostileProperties, ToleranceHasTheRangeOfItsFilter)
{
  const auto errorsOf = [](vtkSurfaceFEMAlgorithm* filter, double tolerance)
  {
    filter->SetInputDataObject(ToPolyData(GeodesicSphere(4)));
    filter->SetDepth(3);
    filter->SetTolerance(tolerance);
    const Messages messages(filter);
    filter->Update();
    return messages.errors;
  };
  for (const double tolerance : { 0.0, -1e-3, 1.0 })
  {
    const bool isZero = tolerance == 0.0;
    EXPECT_EQ(errorsOf(vtkNew<vtkScreenedPoisson>(), tolerance).size(), isZero ? 0u : 1u);
    EXPECT_EQ(errorsOf(vtkNew<vtkHeatDiffusion>(), tolerance).size(), isZero ? 0u : 1u);
    EXPECT_EQ(errorsOf(vtkNew<vtkLaplaceSpectrum>(), tolerance).size(), 1u);
    EXPECT_EQ(errorsOf(vtkNew<vtkGeodesicDistance>(), tolerance).size(), 1u);
  }
}

INSTANTIATE_TEST_SUITE_P(BothSpaces, HostileProperties,
  ::testing::Values(int(vtkSurfaceFEMAlgorithm::Grid), int(vtkSurfaceFEMAlgorithm::HatFunctions)),
  [](const auto& space) { return std::string(space.param == 0 ? "Grid" : "HatFunctions"); });

} // namespace
