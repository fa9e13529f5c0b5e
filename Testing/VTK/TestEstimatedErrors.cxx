// Compares the estimated errors of solver filters with a grid two levels finer.

#include "FilterSupport.h"
#include "Largest.h"

#include "vtkHarmonicInterpolation.h"
#include "vtkHeatDiffusion.h"
#include "vtkMeanCurvatureFlow.h"
#include "vtkScreenedPoisson.h"
#include "vtkStitchColors.h"
#include "vtkSurfaceDetail.h"

#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <string>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

using Solver = vtkSurfaceFEMAlgorithm;

struct Case
{
  std::string name;
  std::function<vtkSmartPointer<Solver>()> make;
  std::string result; // a point array
  double factor;      // allowed between estimate and error

  friend std::ostream& operator<<(std::ostream& os, const Case& test) { return os << test.name; }
};

double Waves(const Vec3& p, int)
{
  return std::sin(5.0 * p[0] + 2.0 * p[1]) + p[2];
}

/// Makes a filter of the array.
template<class Filter>
vtkSmartPointer<Filter> OfWaves()
{
  auto filter = vtkSmartPointer<Filter>::New();
  filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
  return filter;
}

const Case Cases[] = {
  { "ScreenedPoisson", OfWaves<vtkScreenedPoisson>, "Solution", 2.0 },
  { "HeldValues",
    []
    {
      auto filter = OfWaves<vtkScreenedPoisson>();
      filter->SetInputArrayToProcess(4, 0, 0, Points, "known");
      return filter;
    },
    "Solution", 4.0 },
  { "UnknownValues",
    []
    {
      auto filter = OfWaves<vtkScreenedPoisson>();
      filter->SetInputArrayToProcess(0, 0, 0, Points, "holes");
      filter->FillUnknownOn();
      return filter;
    },
    "Solution", 4.0 },
  { "HarmonicInterpolation",
    []
    {
      auto filter = OfWaves<vtkHarmonicInterpolation>();
      filter->SetInputArrayToProcess(1, 0, 0, Points, "known");
      return filter;
    },
    // Coarser levels feel the pull along edges between known points more: it is too large.
    "Interpolated", 8.0 },
  { "Biharmonic",
    []
    {
      auto filter = OfWaves<vtkHarmonicInterpolation>();
      filter->SetInputArrayToProcess(1, 0, 0, Points, "few");
      filter->SetSmoothness(vtkHarmonicInterpolation::Biharmonic);
      return filter;
    },
    "Interpolated", 4.0 },
  { "HeatDiffusion", OfWaves<vtkHeatDiffusion>, "Diffused", 3.0 },
  { "SeveralStepsOfHeat",
    []
    {
      auto filter = OfWaves<vtkHeatDiffusion>();
      filter->SetNumberOfSteps(3);
      return filter;
    },
    "Diffused", 6.0 }, // includes the errors of earlier steps
  { "HeldHeat",
    []
    {
      auto filter = OfWaves<vtkHeatDiffusion>();
      filter->SetInputArrayToProcess(2, 0, 0, Points, "known");
      return filter;
    },
    "Diffused", 4.0 },
  { "DetailOfTheShape", [] { return vtkSmartPointer<vtkSurfaceDetail>::New(); }, "Displacement",
    3.0 },
  { "MeanCurvatureFlow",
    []
    {
      auto filter = vtkSmartPointer<vtkMeanCurvatureFlow>::New();
      filter->SetNumberOfSteps(1);
      filter->SetTimeStep(1e-3);
      return filter;
    },
    "Displacement", 4.0 },
};

class EstimatedErrors : public ::testing::TestWithParam<Case>
{
protected:
  EstimatedErrors() : solver(this->GetParam().make())
  {
    // Edges and faces of a cube, whose points have nearly the same area each.
    const TriangleMesh mesh = Transform(Box(20), { 1, 2, 1 }, 0.4);
    auto input = ToPolyData(mesh);
    AddPointArray(input, "f", 1, Waves);
    AddPointArray(input, "known", 1,
      [](const Vec3& p, int) { return std::abs(p[0] - 0.4) < 0.05 ? 1.0 : 0.0; });
    AddPointArray(input, "few", 1,
      [](const Vec3& p, int)
      { return std::abs(p[0] - 0.4) < 0.05 && std::abs(p[1] - p[2]) < 0.1 ? 1.0 : 0.0; });
    AddPointArray(input, "holes", 1,
      [](const Vec3& p, int c) { return p[1] > 0.6 ? std::nan("") : Waves(p, c); });
    solver->SetInputData(input);
  }

  std::vector<double> ResultAt(int depth)
  {
    solver->SetDepth(depth);
    solver->Update();
    EXPECT_EQ(this->Said("Converged"), 1);
    return PointValues(solver->GetOutput(), this->GetParam().result.c_str());
  }

  double Said(const char* name) { return FieldValue(solver->GetOutput(), name); }

  vtkSmartPointer<Solver> solver;
};

TEST_P(EstimatedErrors, AreNearTheTrueOnes)
{
  const std::vector<double> found = this->ResultAt(5);
  const double said = this->Said("DiscretizationError");
  const double largestSaid = this->Said("LargestDiscretizationError");
  const std::vector<double> truth = this->ResultAt(7);
  double error = 0.0;
  double largest = 0.0;
  double sum = 0.0;
  double square = 0.0;
  for (std::size_t k = 0; k < truth.size(); ++k)
  {
    error += std::pow(found[k] - truth[k], 2);
    largest = Larger(largest, std::abs(found[k] - truth[k]));
    sum += truth[k];
    square += truth[k] * truth[k];
  }
  const double relative = std::sqrt(error / (square - sum * sum / double(truth.size())));
  const double factor = this->GetParam().factor;
  EXPECT_GT(said, relative / factor);
  EXPECT_LT(said, relative * factor);
  EXPECT_GT(largestSaid, largest / 5.0);
  // The largest estimate, at the held points, is on the safe side.
  EXPECT_LT(largestSaid, largest * 10.0);
}

INSTANTIATE_TEST_SUITE_P(All, EstimatedErrors, ::testing::ValuesIn(Cases),
  [](const auto& test) { return test.param.name; });

} // namespace
