// Tests filters that solve to the accuracy of their space: the error they leave, the error they
// report, and the use of a tolerance.

#include "FilterSupport.h"

#include "vtkHeatDiffusion.h"
#include "vtkStitchColors.h"
#include "vtkSurfaceGradient.h"

#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <string>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

using Solver = vtkPoissonAlgorithm;

struct Case
{
  std::string name;
  std::function<vtkSmartPointer<Solver>()> make;
  std::string result; // a point array

  friend std::ostream& operator<<(std::ostream& os, const Case& test) { return os << test.name; }
};

template<class Filter>
vtkSmartPointer<Solver> Make()
{
  return vtkSmartPointer<Filter>::New();
}

const Case Cases[] = {
  { "HeatDiffusion", Make<vtkHeatDiffusion>, "Diffused" },
  { "StitchColors", Make<vtkStitchColors>, "StitchedColors" },
  { "SurfaceGradient", Make<vtkSurfaceGradient>, "Laplacian" },
};

double Stripes(const Vec3& p, int)
{
  return std::sin(9.0 * p[0] + 4.0 * p[1]) + (p[2] > 0.3 ? 0.5 : 0.0);
}

class PoissonAlgorithm : public ::testing::TestWithParam<std::tuple<Case, int>>
{
protected:
  PoissonAlgorithm() : solver(std::get<0>(this->GetParam()).make())
  {
    auto input = ToPolyData(GeodesicSphere(24));
    AddPointArray(input, "f", 1, Stripes);
    AddPointArray(input, "scan", 1, [](const Vec3& p, int) { return p[1] > 0.0 ? 1.0 : 0.0; });
    solver->SetFunctionSpace(std::get<1>(this->GetParam()));
    solver->SetDepth(5);
    solver->SetInputData(input);
    solver->SetInputArrayToProcess(0, 0, 0, Points, "f");
    if (std::get<0>(this->GetParam()).name == "StitchColors")
    {
      solver->SetInputArrayToProcess(1, 0, 0, Points, "scan");
    }
  }

  std::vector<double> Result()
  {
    solver->Update();
    EXPECT_EQ(this->Said("Converged"), 1);
    return PointValues(solver->GetOutput(), std::get<0>(this->GetParam()).result.c_str());
  }

  double Said(const char* name) { return FieldValue(solver->GetOutput(), name); }

  vtkSmartPointer<Solver> solver;
};

/// |a - b| / |b|
double RelativeDifference(const std::vector<double>& a, const std::vector<double>& b)
{
  double difference = 0.0;
  double size = 0.0;
  for (std::size_t k = 0; k < b.size(); ++k)
  {
    difference += std::pow(a[k] - b[k], 2);
    size += b[k] * b[k];
  }
  return std::sqrt(difference / size);
}

TEST_P(PoissonAlgorithm, LeavesATenthOfTheErrorOfTheSpace)
{
  EXPECT_EQ(solver->GetTolerance(), 0.0);
  EXPECT_EQ(solver->GetAccuracy(), 0.1);
  const std::vector<double> found = this->Result();
  const double ofSpace = this->Said("DiscretizationError");
  const double iterations = this->Said("Iterations");
  EXPECT_GT(ofSpace, 1e-4);
  EXPECT_GT(this->Said("LargestDiscretizationError"), 0.0);
  EXPECT_LE(this->Said("AlgebraicError"), 0.1 * ofSpace);

  solver->SetTolerance(1e-11);
  const std::vector<double> discrete = this->Result();
  EXPECT_GE(this->Said("Iterations"), iterations);
  EXPECT_LT(RelativeDifference(found, discrete), 0.1 * ofSpace);
  EXPECT_NEAR(this->Said("DiscretizationError"), ofSpace, 0.2 * ofSpace);

  solver->SetTolerance(0.0);
  solver->SetAccuracy(1e-4);
  EXPECT_LT(RelativeDifference(this->Result(), discrete), 2e-4 * ofSpace);
  if (solver->GetFunctionSpace() == Solver::Grid) // on hats two iterations may leave nothing
  {
    EXPECT_GT(this->Said("Iterations"), iterations);
  }
}

TEST_P(PoissonAlgorithm, WithoutEnoughIterationsItSaysHowFarItCame)
{
  Messages messages(solver);
  solver->SetAccuracy(1e-6);
  solver->SetMaximumIterations(1);
  solver->Update();
  EXPECT_EQ(this->Said("Converged"), 0);
  ExpectOne(messages.warnings, "error of the function space");
}

INSTANTIATE_TEST_SUITE_P(All, PoissonAlgorithm,
  ::testing::Combine(
    ::testing::ValuesIn(Cases), ::testing::Values(int(Solver::Grid), int(Solver::HatFunctions))),
  [](const auto& test)
  {
    return std::get<0>(test.param).name +
           (std::get<1>(test.param) == Solver::HatFunctions ? "OnHats" : "");
  });

TEST(ManySteps, DoNotAddUpWhatTheyLeave)
{
  auto input = ToPolyData(GeodesicSphere(24));
  AddPointArray(input, "f", 1, Stripes);
  vtkNew<vtkHeatDiffusion> heat;
  heat->SetDepth(5);
  heat->SetNumberOfSteps(12);
  heat->SetDiffusionTime(1e-4);
  heat->SetInputData(input);
  heat->SetInputArrayToProcess(0, 0, 0, Points, "f");
  heat->Update();
  const std::vector<double> found = PointValues(heat->GetOutput(), "Diffused");
  EXPECT_GT(FieldValue(heat->GetOutput(), "DiscretizationError"), 0.0);
  heat->SetTolerance(1e-11);
  heat->Update();
  EXPECT_LT(RelativeDifference(found, PointValues(heat->GetOutput(), "Diffused")), 2e-4);
}

} // namespace
