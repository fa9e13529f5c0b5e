// The properties of the solver change the way to the result, not the result, and each repeats only
// the stages that it belongs to.

#include "FilterSupport.h"

#include "vtkConnectivityAwareBasis.h"
#include "vtkLaplaceSpectrum.h"
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

TEST_P(SolverProperties, MoreSweepsNeedFewerIterations)
{
  for (const int smoother : { Poisson::PatchSmoother, Poisson::GaussSeidelSmoother })
  {
    filter->SetSmoother(smoother);
    filter->SetNumberOfSweeps(1);
    const double one = this->Iterations();
    filter->SetNumberOfSweeps(5);
    EXPECT_LT(this->Iterations(), one) << smoother;
  }
}

TEST_P(SolverProperties, SweepsBetweenSynchronisationsCountAsSweeps)
{
  filter->SetSmoother(Poisson::SliceGaussSeidelSmoother);
  const double one = this->Iterations();
  filter->SetSweepsPerSynchronisation(3);
  const double three = this->Iterations();
  EXPECT_LE(three, one);
  EXPECT_EQ(three < one, this->GetParam() == Poisson::Grid); // those of the hats are others
  // More sweeps than there are slices: the slabs become one.
  filter->SetSweepsPerSynchronisation(100);
  EXPECT_LE(this->Iterations(), three);
}

TEST_P(SolverProperties, CyclesAloneConvergeMoreSlowly)
{
  const double conjugateGradients = this->Iterations();
  const Counts before = Runs(filter);
  filter->SetIteration(Poisson::Cycles);
  EXPECT_GT(this->Iterations(), conjugateGradients);
  Counts expected = before;
  ++expected["Solve"];
  EXPECT_EQ(Runs(filter), expected);
}

TEST_P(SolverProperties, AnyCoarsestSizeSolves)
{
  this->Iterations();
  Counts expected = Runs(filter);
  filter->SetCoarsestSize(1);
  this->Iterations();
  for (const char* stage : { "System", "Hierarchy", "RightHandSide", "Solve" })
  {
    ++expected[stage];
  }
  EXPECT_EQ(Runs(filter), expected);
  // Hats stay above the grid, which is then solved directly.
  filter->SetCoarsestSize(4096);
  const double direct = this->Iterations();
  EXPECT_EQ(direct <= 2, this->GetParam() == Poisson::Grid);
}

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
  // The grid's solution changes by about its error, that of the hats by none.
  const double change = Difference(PointValues(filter->GetOutput(), "Solution"), without);
  const bool isGrid = this->GetParam() == Poisson::Grid;
  EXPECT_GT(change, isGrid ? 1e-5 : -1.0);
  EXPECT_LT(change, isGrid ? 0.1 : 1e-5);
}

TEST_P(SolverProperties, ASweepCountRebuildsTheHierarchyAlone)
{
  this->Iterations();
  Counts expected = Runs(filter);
  filter->SetNumberOfSweeps(2);
  this->Iterations();
  ++expected["Hierarchy"];
  ++expected["Solve"];
  EXPECT_EQ(Runs(filter), expected);
}

TEST_P(SolverProperties, NoneChangesTheSpectrum)
{
  vtkNew<vtkLaplaceSpectrum> spectrum;
  spectrum->SetFunctionSpace(this->GetParam());
  spectrum->SetInputData(Surface());
  spectrum->SetDepth(5);
  spectrum->SetNumberOfModes(9);
  spectrum->SetTolerance(1e-9);
  spectrum->SetMaximumIterations(500);
  const auto eigenvalues = [&]
  {
    spectrum->Update();
    EXPECT_EQ(FieldValue(spectrum->GetOutput(), "Converged"), 1);
    return Values(spectrum->GetOutput()->GetFieldData()->GetArray("Eigenvalues"));
  };
  const auto expected = eigenvalues();
  const double accuracy = 1e-8 * expected.back();
  vtkIdType runs = spectrum->GetNumberOfRuns("Solve");
  const auto expectSame = [&](const char* what)
  {
    EXPECT_LT(Difference(eigenvalues(), expected), accuracy) << what;
    EXPECT_EQ(spectrum->GetNumberOfRuns("Solve"), ++runs) << what;
  };
  spectrum->SetNumberOfSweeps(3);
  expectSame("sweeps");
  spectrum->SetSmoother(Poisson::SliceGaussSeidelSmoother);
  spectrum->SetSweepsPerSynchronisation(2);
  expectSame("slices");
  spectrum->SetCoarsestSize(16);
  expectSame("small coarsest level");
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

TEST(SolverProperty, DepthOneIsRefused)
{
  vtkNew<Poisson> filter;
  Messages messages(filter);
  filter->SetInputData(Surface());
  filter->SetDepth(1);
  filter->Update();
  ASSERT_EQ(messages.errors.size(), 1u);
  EXPECT_NE(messages.errors[0].find("between 2 and 14"), std::string::npos);
}

TEST(SolverProperty, FiltersOnOneBasisMayDifferInTheirSystems)
{
  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetDepth(4);
  basis->SetInputData(Surface());
  const auto solution = [&](int coarsestSize, vtkAlgorithmOutput* shared, double weight = 1e-12)
  {
    vtkNew<Poisson> filter;
    filter->SetInputData(basis->GetInput());
    filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
    filter->SetDepth(4);
    filter->SetTolerance(1e-4); // far from the solution, so that a difference shows
    filter->SetCoarsestSize(coarsestSize);
    filter->SetNormalStabilization(weight);
    filter->SetBasisConnection(shared);
    filter->Update();
    return PointValues(filter->GetOutput(), "Solution");
  };
  for (const int size : { 256, 16 })
  {
    EXPECT_EQ(solution(size, basis->GetOutputPort()), solution(size, nullptr)) << size;
  }
  EXPECT_NE(solution(256, nullptr), solution(16, nullptr));
  EXPECT_EQ(solution(256, basis->GetOutputPort(), 1e-2), solution(256, nullptr, 1e-2));
  EXPECT_NE(solution(256, nullptr, 1e-2), solution(256, nullptr));
}

TEST(SolverProperty, ValuesOutOfRangeAreClamped)
{
  vtkNew<Poisson> filter;
  filter->SetNumberOfSweeps(0);
  EXPECT_EQ(filter->GetNumberOfSweeps(), 1);
  filter->SetSweepsPerSynchronisation(-1);
  EXPECT_EQ(filter->GetSweepsPerSynchronisation(), 1);
  filter->SetCoarsestSize(1 << 30);
  EXPECT_EQ(filter->GetCoarsestSize(), 4096);
  filter->SetSmoother(3);
  EXPECT_EQ(filter->GetSmoother(), int(Poisson::SliceGaussSeidelSmoother));
  filter->SetIteration(2);
  EXPECT_EQ(filter->GetIteration(), int(Poisson::Cycles));
  filter->SetFunctionSpace(2);
  EXPECT_EQ(filter->GetFunctionSpace(), int(Poisson::HatFunctions));
}

} // namespace
