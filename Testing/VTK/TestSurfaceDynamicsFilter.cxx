// Surface Dynamics as a user of VTK sees it.
#include "FilterSupport.h"
#include "Selections.h"

#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkSurfaceDynamics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr double Radius = 2.0;

vtkSmartPointer<vtkSurfaceDynamics> MakeFilter(int model, int steps)
{
  auto data = ToPolyData(GeodesicSphere(16, Radius));
  AddPointArray(data, "xy", 1, [](const Vec3& p, int) { return p[0] * p[1]; });
  AddPointArray(data, "two", 2, [](const Vec3& p, int c) { return 0.5 + 0.1 * p[c]; });
  AddPointArray(
    data, "w", 3, [](const Vec3& p, int c) { return c == 0   ? -p[1]
                                                    : c == 1 ? p[0]
                                                             : 0.0; });
  auto filter = vtkSmartPointer<vtkSurfaceDynamics>::New();
  filter->SetDepth(5);
  filter->SetInputDataObject(data);
  filter->SetParameterUnits(vtkSurfaceFEMAlgorithm::World);
  filter->SetPatternLength(1.0);
  filter->SetModel(model);
  filter->SetNumberOfSteps(steps);
  return filter;
}

std::vector<double> StateAt(vtkSurfaceDynamics* filter, double step, const char* name)
{
  EXPECT_EQ(filter->UpdateTimeStep(step), 1);
  EXPECT_EQ(FieldValue(filter->GetOutputDataObject(0), "Step"), step);
  return PointValues(filter->GetOutputDataObject(0), name);
}

} // namespace

TEST(SurfaceDynamicsFilter, StandingWavesTurnAsTheSphereSays)
{
  auto filter = MakeFilter(vtkSurfaceDynamics::Wave, 4);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "xy");
  filter->SetTimeStep(0.5);
  const double omega = std::sqrt(6.0) / Radius;
  const std::vector<double> start = PointValues(filter->GetInputDataObject(0, 0), "xy");
  for (const int step : { 3, 1, 4 })
  {
    const std::vector<double> u = StateAt(filter, step, "U");
    const std::vector<double> v = StateAt(filter, step, "V");
    ASSERT_EQ(u.size(), start.size());
    for (std::size_t i = 0; i < u.size(); ++i)
    {
      ASSERT_NEAR(u[i], std::cos(omega * 0.5 * step) * start[i], 0.04 * Radius);
      ASSERT_NEAR(v[i], -omega * std::sin(omega * 0.5 * step) * start[i], 0.06 * Radius);
    }
    EXPECT_DOUBLE_EQ(FieldValue(filter->GetOutputDataObject(0), "Time"), 0.5 * step);
    EXPECT_GT(FieldValue(filter->GetOutputDataObject(0), "Energy"), 0.0);
  }
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 4);
  EXPECT_EQ(filter->GetNumberOfRuns("Hierarchy"), 1);
}

TEST(SurfaceDynamicsFilter, ComputesOnlyTheStepsThatAreShown)
{
  auto filter = MakeFilter(vtkSurfaceDynamics::TuringSpots, 30);
  StateAt(filter, 2, "U");
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 2);
  StateAt(filter, 5, "V");
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 5);
  StateAt(filter, 0, "U");
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 5);
  EXPECT_STREQ(filter->GetOutput()->GetPointData()->GetScalars()->GetName(), "U");
}

TEST(SurfaceDynamicsFilter, WithoutATimeItShowsTheLastStep)
{
  auto filter = MakeFilter(vtkSurfaceDynamics::AllenCahn, 3);
  filter->Update();
  EXPECT_EQ(FieldValue(filter->GetOutputDataObject(0), "Step"), 3);
  EXPECT_FALSE(filter->GetOutput()->GetPointData()->HasArray("V"));
  EXPECT_FALSE(filter->GetOutput()->GetFieldData()->HasArray("Energy"));
}

TEST(SurfaceDynamicsFilter, CarriesAlongItsVelocityAndKeepsTheIntegral)
{
  auto filter = MakeFilter(vtkSurfaceDynamics::Transport, 2);
  ExpectRefused(filter, "Transport needs a Velocity Array");
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "w");
  const std::vector<double> start = StateAt(filter, 0, "U");
  const double integral = FieldValue(filter->GetOutputDataObject(0), "Integral");
  EXPECT_GT(integral, 0.0);
  EXPECT_NE(StateAt(filter, 2, "U"), start);
  EXPECT_NEAR(FieldValue(filter->GetOutputDataObject(0), "Integral"), integral, 1e-6 * integral);
}

TEST(SurfaceDynamicsFilter, FormulasAreAsGoodAsNamedReactions)
{
  const auto state = [](int model, const char* name)
  {
    auto filter = MakeFilter(model, 2);
    filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "two");
    filter->SetTolerance(1e-10);
    filter->SetTimeStep(0.01);
    filter->SetPatternLength(31.0 * 0.05);
    filter->SetReactionU("0.037*(1 - u) - u*v^2");
    filter->SetReactionV("u*v^2 - (0.037 + 0.06)*v");
    filter->SetDiffusivity(0.0025);
    filter->SetDiffusivityV(0.00125);
    return StateAt(filter, 2, name);
  };
  for (const char* name : { "U", "V" })
  {
    const std::vector<double> named = state(vtkSurfaceDynamics::GrayScott, name);
    const std::vector<double> formulas = state(vtkSurfaceDynamics::Custom, name);
    ASSERT_EQ(formulas.size(), named.size());
    for (std::size_t i = 0; i < named.size(); ++i)
    {
      ASSERT_NEAR(formulas[i], named[i], 1e-7) << name << i;
    }
  }
}

/// The default formulas are those of TuringSpots.
TEST(SurfaceDynamicsFilter, TheDefaultFormulasGrowSpots)
{
  auto filter = MakeFilter(vtkSurfaceDynamics::Custom, 30);
  filter->SetDepth(4);
  filter->SetDiffusivity(0.02);
  filter->SetDiffusivityV(0.8);
  const std::vector<double> u = StateAt(filter, 30, "U");
  EXPECT_GT(*std::max_element(u.begin(), u.end()), 2.0);
  EXPECT_LT(*std::min_element(u.begin(), u.end()), 0.6);
}

TEST(SurfaceDynamicsFilter, OneFormulaIsOneUnknown)
{
  auto filter = MakeFilter(vtkSurfaceDynamics::Custom, 1);
  filter->SetReactionU("if(u > 2, 1, -u)");
  filter->SetReactionV(" ");
  filter->Update();
  EXPECT_FALSE(filter->GetOutput()->GetPointData()->HasArray("V"));
  EXPECT_EQ(filter->GetOutput()->GetFieldData()->GetArray("Integral")->GetNumberOfComponents(), 1);
}

TEST(SurfaceDynamicsFilter, TellsWhichFormulaCannotBeRead)
{
  auto filter = MakeFilter(vtkSurfaceDynamics::Custom, 1);
  const Messages messages(filter);
  const auto refuses = [&](const char* ofU, const char* ofV, const char* reason)
  {
    filter->SetReactionU(ofU);
    filter->SetReactionV(ofV);
    ExpectRefused(filter, reason);
  };
  refuses("u + w", "v",
    "Reaction U 'u + w' cannot be read: Undefined symbol: 'w'. It is a formula of u and v");
  refuses("u", "u ** v", "Reaction V 'u ** v' cannot be read");
  refuses("u*v", "", "Undefined symbol: 'v'. It is a formula of u, such as u*(1-u).");
  for (const char* blank : { "", " ", "\n" })
  {
    refuses(blank, "v", "): The Model Custom needs a formula for Reaction U.");
  }
  for (const char* other : { "/**/u", "u := 3", "u; v", "u // half", "[u]", "'u'" })
  {
    SCOPED_TRACE(other);
    refuses(other, "", "cannot be read");
  }
  refuses("u*iHat", "", "Reaction U 'u*iHat' cannot be read");
  filter->SetReactionU("log(u - 100)"); // not a number anywhere
  filter->Update();
  ExpectOne(messages.warnings, "have left the range of numbers");
}

TEST(SurfaceDynamicsFilter, WarnsOfASelectionBesideAStart)
{
  auto filter = MakeFilter(vtkSurfaceDynamics::Wave, 1);
  filter->SetInputDataObject(filter->GetNumberOfInputPorts() - 1, SelectPoints({ 3, 4 }));
  const Messages messages(filter);
  filter->Update();
  EXPECT_TRUE(messages.warnings.empty());
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "xy");
  filter->Update();
  ExpectOne(messages.warnings, "The Selection has no effect");
}

/// After each change the output is the output of a new filter with the same properties.
TEST(SurfaceDynamicsFilter, NeverShowsAnOldResult)
{
  using Change = std::function<void(vtkSurfaceDynamics*)>;
  const std::vector<Change> changes = { [](vtkSurfaceDynamics* f)
    { f->SetParameterUnits(vtkSurfaceFEMAlgorithm::UnitCube); },
    [](vtkSurfaceDynamics* f) { f->SetPatternLength(0.5); },
    [](vtkSurfaceDynamics* f) { f->SetModel(vtkSurfaceDynamics::GrayScott); },
    [](vtkSurfaceDynamics* f) { f->SetFeed(0.03); },
    [](vtkSurfaceDynamics* f) { f->SetKill(0.05); }, [](vtkSurfaceDynamics* f) { f->SetSeed(5); },
    [](vtkSurfaceDynamics* f) { f->SetTimeStep(3.0); },
    [](vtkSurfaceDynamics* f) { f->SetModel(vtkSurfaceDynamics::Wave); },
    [](vtkSurfaceDynamics* f) { f->SetDamping(2.0); },
    [](vtkSurfaceDynamics* f)
    { f->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "xy"); },
    [](vtkSurfaceDynamics* f)
    { f->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "w"); },
    [](vtkSurfaceDynamics* f) { f->SetModel(vtkSurfaceDynamics::Transport); },
    [](vtkSurfaceDynamics* f) { f->SetDiffusivity(0.01); },
    [](vtkSurfaceDynamics* f) { f->SetModel(vtkSurfaceDynamics::Custom); },
    [](vtkSurfaceDynamics* f) { f->SetDiffusivity(0.02); },
    [](vtkSurfaceDynamics* f) { f->SetReactionU("0.2 - u*v"); },
    [](vtkSurfaceDynamics* f) { f->SetReactionV("u - v"); },
    [](vtkSurfaceDynamics* f) { f->SetDiffusivityV(0.5); },
    [](vtkSurfaceDynamics* f)
    {
      f->SetReactionV("");
      f->SetReactionU("1 - u");
    },
    [](vtkSurfaceDynamics* f) { f->SetDepth(3); },
    [](vtkSurfaceDynamics* f) { f->SetNumberOfSteps(2); } };
  const auto make = []
  {
    auto filter = MakeFilter(vtkSurfaceDynamics::TuringSpots, 1);
    filter->SetDepth(4);
    return filter;
  };
  auto filter = make();
  for (std::size_t last = 0; last < changes.size(); ++last)
  {
    changes[last](filter);
    filter->Update();
    auto fresh = make();
    for (std::size_t k = 0; k <= last; ++k)
    {
      changes[k](fresh);
    }
    fresh->Update();
    EXPECT_EQ(PointValues(filter->GetOutputDataObject(0), "U"),
      PointValues(fresh->GetOutputDataObject(0), "U"))
      << last;
    EXPECT_EQ(FieldValue(filter->GetOutputDataObject(0), "Time"),
      FieldValue(fresh->GetOutputDataObject(0), "Time"))
      << last;
  }
}
