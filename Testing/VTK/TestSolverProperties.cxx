// Tests that the properties of the solver change how the result is computed, but not the result.
// Each repeats only the stages that it belongs to.

#include "FilterSupport.h"

#include "vtkConnectivityAwareBasis.h"
#include "vtkScreenedPoisson.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

using Poisson = vtkScreenedPoisson;
using Counts = std::map<std::string, vtkIdType>; // per stage

Counts Runs(vtkSurfaceFEMAlgorithm* filter)
{
  Counts counts;
  for (const char* stage : Stages)
  {
    counts[stage] = filter->GetNumberOfRuns(stage);
  }
  return counts;
}

vtkSmartPointer<vtkPolyData> Surface()
{
  auto surface = ToPolyData(Transform(GeodesicSphere(20), { 1, 2, 0 }, 0.5));
  AddPointArray(surface, "f", 1, Wave);
  return surface;
}

class SolverProperties : public ::testing::TestWithParam<int>
{
protected:
  SolverProperties()
  {
    filter->SetFunctionSpace(this->GetParam());
    filter->SetDepth(4);
    filter->SetTolerance(1e-9);
    filter->SetMaximumIterations(2000);
    filter->SetInputData(Surface());
    filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
  }

  /// Runs the filter and returns its iterations; the solution must be `solution`.
  double Iterations()
  {
    filter->Update();
    EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1);
    const auto found = PointValues(filter->GetOutput(), "Solution");
    solution = solution.empty() ? found : solution;
    EXPECT_LT(Difference(found, solution), 1e-6);
    return FieldValue(filter->GetOutput(), "Iterations");
  }

  vtkNew<Poisson> filter;
  std::vector<double> solution;
};

TEST_P(SolverProperties, NormalStabilizationChangesTheSystemOfTheGrid)
{
  this->Iterations();
  Counts expected = Runs(filter);
  const std::vector<double> without = PointValues(filter->GetOutput(), "Solution");
  filter->SetNormalStabilization(1e-2);
  filter->Update();
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1);
  for (const char* stage : { "System", "Hierarchy", "RightHandSide", "Solve" })
  {
    ++expected[stage];
  }
  EXPECT_EQ(Runs(filter), expected);
  // The grid's solution changes by about its error, the hats' solution not at all.
  const double change = Difference(PointValues(filter->GetOutput(), "Solution"), without);
  const bool isGrid = this->GetParam() == Poisson::Grid;
  EXPECT_GT(change, isGrid ? 1e-5 : -1.0);
  EXPECT_LT(change, isGrid ? 0.1 : 1e-5);
}

INSTANTIATE_TEST_SUITE_P(BothSpaces, SolverProperties,
  ::testing::Values(int(Poisson::Grid), int(Poisson::HatFunctions)),
  [](const auto& space)
  { return std::string(space.param == Poisson::Grid ? "Grid" : "HatFunctions"); });

TEST_P(SolverProperties, AnAutomaticDepthIsThatOfTheMesh)
{
  filter->SetTolerance(1e-4);
  const auto run = [&](int depth, const TriangleMesh& mesh)
  {
    auto surface = ToPolyData(mesh);
    AddPointArray(surface, "f", 1, Wave);
    filter->SetDepth(depth);
    filter->SetInputData(surface);
    filter->Update();
    EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1);
    return PointValues(filter->GetOutput(), "Solution");
  };
  const TriangleMesh coarse = Transform(GeodesicSphere(10), { 1, 2, 0 }, 0.5);
  const TriangleMesh fine = Transform(GeodesicSphere(210), { 1, 2, 0 }, 0.5);
  const auto automatic = run(0, fine);
  EXPECT_EQ(FieldValue(filter->GetOutput(), "UsedDepth"), 7);
  const Counts runs = Runs(filter);
  filter->Modified();
  filter->Update();
  EXPECT_EQ(Runs(filter), runs) << "chosen once";
  EXPECT_EQ(run(7, fine), automatic);
  run(0, coarse);
  const double used = FieldValue(filter->GetOutput(), "UsedDepth");
  if (this->GetParam() == Poisson::Grid)
  {
    EXPECT_EQ(used, 6);
  }
  else
  {
    EXPECT_LT(used, 4); // 402 points
  }
}

/// The slider of the panel passes 1 on its way from 0, automatic, to 2.
TEST(SolverProperty, DepthOneCountsAsTwo)
{
  vtkNew<Poisson> filter;
  Messages messages(filter);
  filter->SetInputData(Surface());
  filter->SetDepth(1);
  filter->Update();
  EXPECT_TRUE(messages.errors.empty());
  EXPECT_EQ(FieldValue(filter->GetOutput(), "UsedDepth"), 2);
}

TEST(SolverProperty, FiltersOnOneBasisMayDifferInTheirSystems)
{
  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetDepth(4);
  basis->SetInputData(Surface());
  const auto solution = [&](vtkAlgorithmOutput* shared, double weight)
  {
    vtkNew<Poisson> filter;
    filter->SetInputData(basis->GetInput());
    filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
    filter->SetDepth(4);
    filter->SetTolerance(1e-4); // far from the solution, so that a difference shows
    filter->SetNormalStabilization(weight);
    filter->SetBasisConnection(shared);
    filter->Update();
    return PointValues(filter->GetOutput(), "Solution");
  };
  for (const double weight : { 1e-12, 1e-2 })
  {
    EXPECT_EQ(solution(basis->GetOutputPort(), weight), solution(nullptr, weight)) << weight;
  }
  EXPECT_NE(solution(nullptr, 1e-2), solution(nullptr, 1e-12));
}

TEST(SolverProperty, ValuesOutOfRangeBecomeTheNearestAndAreRefused)
{
  vtkNew<Poisson> filter;
  filter->SetMaximumIterations(0);
  EXPECT_EQ(filter->GetMaximumIterations(), 1);
  filter->SetNumberOfThreads(-1);
  EXPECT_EQ(filter->GetNumberOfThreads(), 0);
  filter->SetNormalStabilization(0.0);
  EXPECT_EQ(filter->GetNormalStabilization(), 1e-14);
  filter->SetWantedError(-1.0);
  EXPECT_EQ(filter->GetWantedError(), 0.0);
  filter->SetWantedError(1.0);
  EXPECT_EQ(filter->GetWantedError(), 0.5);
  filter->SetFunctionSpace(3);
  EXPECT_EQ(filter->GetFunctionSpace(), int(Poisson::SmoothGrid));
  filter->SetInputDataObject(ToPolyData(GeodesicSphere(4)));
  ExpectRefused(filter);
}

} // namespace
