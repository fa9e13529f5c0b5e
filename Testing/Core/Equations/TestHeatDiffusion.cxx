// Diffusion against exact decay on a sphere, and its invariants, on both kinds of space.
#include "Equations/HeatDiffusion.h"

#include "Base/Errors.h"
#include "EitherSpace.h"
#include "Grid/SurfaceEdges.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

std::shared_ptr<const FiniteElementSpace> Build(
  const TriangleMesh& mesh, bool isOnHats, int depth, int threads = 0)
{
  return BuildEither(mesh, isOnHats, depth, 1e-2, threads);
}

DiffusionOptions Options(double timeStep, TimeScheme scheme, int threads = 0)
{
  DiffusionOptions options;
  options.timeStep = timeStep;
  options.scheme = scheme;
  options.multigrid.threads = threads;
  options.solve.tolerance = 1e-10;
  return options;
}

std::shared_ptr<const HeatEquation> EquationOf(std::shared_ptr<const FiniteElementSpace> space,
  const DiffusionOptions& options, HeldRows held = {})
{
  return std::make_shared<const HeatEquation>(
    std::move(space), options, std::move(held), options.multigrid.threads);
}

Field OnPoints(MultiVector values)
{
  return { FieldAssociation::Points, std::move(values) };
}

/// The rest of f = x y on a sphere of radius 1 after a time, in this number of steps. The exact
/// rest is exp(-6 time).
double LeftOnSphere(bool isOnHats, TimeScheme scheme, double time, int steps)
{
  const TriangleMesh mesh = Transform(GeodesicSphere(40), { 1, 2, 3 }, 0.4);
  const auto space = Build(mesh, isOnHats, 5);
  const MultiVector points = PointCoordinates(mesh);
  const MultiVector f = points.col(0).cwiseProduct(points.col(1));
  const double step = time / steps / std::pow(space->UnitLength(), 2);
  HeatDiffusion diffusion(
    EquationOf(space, Options(step, scheme)), space->LoadOfValues(OnPoints(f)));
  for (int k = 0; k < steps; ++k)
  {
    EXPECT_TRUE(diffusion.Advance().converged);
  }
  const MultiVector values = space->ValuesAtPoints(diffusion.Coefficients());
  return values.col(0).dot(f.col(0)) / f.squaredNorm();
}

const double Gamma = 1.0 - std::sqrt(0.5);

/// The factors of a mode with eigenvalue times step z: of the first step and of later ones.
double FirstFactor(double z)
{
  return (1.0 - (1.0 - 3.0 * Gamma) * z) / std::pow(1.0 + Gamma * z, 3);
}

double LaterFactor(double z)
{
  return (1.0 - (1.0 - 2.0 * Gamma) * z) / std::pow(1.0 + Gamma * z, 2);
}

double Total(const FiniteElementSpace& space, const MultiVector& coefficients)
{
  double sum = 0.0;
  for (Id i = 0; i < coefficients.rows(); ++i)
  {
    sum += space.Integrals()[i] * coefficients(i, 0);
  }
  return sum;
}

} // namespace

TEST(HeatDiffusion, LetsHarmonicsOfASphereDecayAsTheyDo)
{
  const double exact = std::exp(-6.0 * 0.1);
  for (const bool isOnHats : { false, true })
  {
    EXPECT_NEAR(LeftOnSphere(isOnHats, TimeScheme::SecondOrder, 0.1, 8), exact, 0.005) << isOnHats;
  }
}

/// The first solve starts from rough values, so it needs more iterations than the later ones. If
/// the limit stops it alone, the report is still its own.
TEST(HeatDiffusion, TellsWhyASolveHasNotConverged)
{
  const TriangleMesh mesh = Transform(GeodesicSphere(10), { 1, 2, 3 }, 0.4);
  const auto space = Build(mesh, false, 4);
  const MultiVector start =
    space->LoadOfValues(OnPoints(RandomValues(static_cast<Id>(mesh.points.size()), 1)));
  int failures = 0;
  int successes = 0;
  for (const double timeStep : { 1.0, 10.0, 100.0 })
  {
    DiffusionOptions options = Options(timeStep, TimeScheme::SecondOrder);
    for (int most = 1; most <= 12; ++most)
    {
      options.solve.maximumIterations = most;
      HeatDiffusion diffusion(EquationOf(space, options), start);
      for (int step = 0; step < 2; ++step)
      {
        const SolveReport report = diffusion.Advance();
        EXPECT_EQ(report.converged, report.end == SolveEnd::Converged) << timeStep << " " << most;
        (report.converged ? successes : failures) += 1;
      }
    }
  }
  EXPECT_GT(failures, 0);
  EXPECT_GT(successes, 0);
}

/// Each step multiplies by a known rational function of z = 6 δ. The rest of the error comes from
/// the space.
TEST(HeatDiffusion, HasTheOrdersOfItsSchemes)
{
  const auto error = [](TimeScheme scheme, int steps)
  { return std::abs(LeftOnSphere(true, scheme, 0.2, steps) - std::exp(-6.0 * 0.2)); };
  const double first[] = { error(TimeScheme::BackwardEuler, 2),
    error(TimeScheme::BackwardEuler, 4) };
  EXPECT_NEAR(first[0] / first[1], 2.0, 0.3);
  EXPECT_NEAR(
    LeftOnSphere(true, TimeScheme::BackwardEuler, 0.2, 2), std::pow(1.0 + 0.6, -2), 0.005);
  EXPECT_NEAR(LeftOnSphere(true, TimeScheme::SecondOrder, 0.2, 2),
    FirstFactor(0.6) * LaterFactor(0.6), 0.005);
  EXPECT_LT(std::abs(FirstFactor(0.6) * LaterFactor(0.6) - std::exp(-1.2)), 0.2 * first[0]);
  // Many steps have the error of the space alone.
  const double limit = LeftOnSphere(true, TimeScheme::SecondOrder, 0.2, 64);
  const auto ofTime = [&](int steps)
  { return std::abs(LeftOnSphere(true, TimeScheme::SecondOrder, 0.2, steps) - limit); };
  EXPECT_GT(ofTime(2) / ofTime(4), 3.5);
  EXPECT_GT(ofTime(4) / ofTime(8), 3.5);
}

/// A single step damps modes of any size, and leaves at most 0.0053 of one with the wrong sign.
TEST(HeatDiffusion, AStepFromTheStartNeverTurnsAMode)
{
  for (const double z : { 0.5, 1.0, 2.4, 5.0, 8.2, 16.0, 60.0, 1e3, 1e6 })
  {
    const double left = LeftOnSphere(true, TimeScheme::SecondOrder, z / 6.0, 1);
    EXPECT_NEAR(left, FirstFactor(z), 0.003) << z;
    EXPECT_NEAR(left, std::exp(-z), 0.058) << z; // 0.055 of time, the rest of the space
    EXPECT_GT(left, -0.006) << z;
  }
}

/// The heat kernel is positive and large at its source. The space cannot follow it at first, and
/// leaves the same error after many short steps of Backward Euler.
TEST(HeatDiffusion, OfAPointIsNeverNegativeBeyondTheErrorOfTheSpace)
{
  const TriangleMesh sphere = Transform(GeodesicSphere(12), { 1, 2, 3 }, 0.4);
  const TriangleMesh torus = Torus(40, 16, 1.0, 0.4);
  constexpr int Short = 10; // steps of Backward Euler for one step
  for (const TriangleMesh* mesh : { &sphere, &torus })
  {
    const auto source = static_cast<Id>(mesh->points.size() / 3);
    MultiVector f = MultiVector::Zero(static_cast<Id>(mesh->points.size()), 1);
    f(source, 0) = 1.0;
    for (const bool isOnHats : { false, true })
    {
      const auto space = Build(*mesh, isOnHats, 4);
      const MultiVector load = space->LoadOfValues(OnPoints(f));
      for (const double step : { 1e-3, 0.1, 1.0, 5.0, 30.0, 1e4 })
      {
        HeatDiffusion heat(EquationOf(space, Options(step, TimeScheme::SecondOrder)), load);
        HeatDiffusion euler(
          EquationOf(space, Options(step / Short, TimeScheme::BackwardEuler)), load);
        for (int k = 0; k < 3; ++k)
        {
          heat.Advance();
          for (int part = 0; part < Short; ++part)
          {
            euler.Advance();
          }
          const MultiVector u = space->ValuesAtPoints(heat.Coefficients());
          const double below = std::min(
            0.0, space->ValuesAtPoints(euler.Coefficients()).minCoeff<Eigen::PropagateNaN>());
          const double most = u.maxCoeff<Eigen::PropagateNaN>();
          EXPECT_GT(u.minCoeff<Eigen::PropagateNaN>(), 1.2 * below - 1e-4 * most)
            << step << " " << k << isOnHats << below;
          // A single step leaves a ring around the source that is hotter by an eighth. On the torus
          // the heat of a long time gathers elsewhere.
          const double least = k == 0 ? 0.87 : 0.98;
          EXPECT_TRUE((mesh == &torus && step > 1.0) || u(source, 0) > least * most)
            << step << " " << k << isOnHats;
        }
      }
    }
  }
}

/// On a plane the first step has the exact heat at its source, 1 / (4 π t) of the whole.
TEST(HeatDiffusion, HasTheHeatOfTheKernelAtItsSource)
{
  const TriangleMesh mesh = GeodesicSphere(60);
  MultiVector f = MultiVector::Zero(static_cast<Id>(mesh.points.size()), 1);
  const Id source = 77;
  f(source, 0) = 1.0;
  const auto space = Build(mesh, true, 5);
  const MultiVector load = space->LoadOfValues(OnPoints(f));
  const double total = load.sum() * std::pow(space->UnitLength(), 2);
  const double time = 0.04; // the root is eight edges long; the sphere is flat enough
  const double step = time / std::pow(space->UnitLength(), 2);
  HeatDiffusion heat(EquationOf(space, Options(step, TimeScheme::SecondOrder)), load);
  heat.Advance();
  const double found = space->ValuesAtPoints(heat.Coefficients())(source, 0);
  // The kernel of the unit sphere is larger by 1 + t / 3 there.
  const double exact = total * (1.0 + time / 3.0) / (4.0 * std::acos(-1.0) * time);
  EXPECT_NEAR(found / exact, 1.0, 0.05);
}

TEST(HeatDiffusion, KeepsTheIntegralOnEveryComponentAndAddsThatOfSources)
{
  const TriangleMesh mesh = Transform(TwoSheets(12, 0.02), { 1, 2, 3 }, 0.5);
  const auto points = static_cast<Id>(mesh.points.size());
  MultiVector f = RandomValues(points, 1);
  f.bottomRows(points / 2).setConstant(3.0); // the second sheet
  for (const bool isOnHats : { false, true })
  {
    for (const TimeScheme scheme : { TimeScheme::BackwardEuler, TimeScheme::SecondOrder })
    {
      const auto space = Build(mesh, isOnHats, 4);
      const MultiVector load = space->LoadOfValues(OnPoints(f));
      HeatDiffusion diffusion(EquationOf(space, Options(7.0, scheme)), load);
      HeatDiffusion heated(EquationOf(space, Options(7.0, scheme)), load, load);
      for (int k = 0; k < 3; ++k)
      {
        diffusion.Advance();
        heated.Advance();
      }
      EXPECT_NEAR(Total(*space, diffusion.Coefficients()), load.sum(), 1e-9 * load.sum());
      EXPECT_NEAR(
        Total(*space, heated.Coefficients()), (1.0 + 21.0) * load.sum(), 1e-8 * load.sum());
      const MultiVector values = space->ValuesAtPoints(diffusion.Coefficients());
      for (Id i = points / 2; i < points; ++i)
      {
        ASSERT_NEAR(values(i, 0), 3.0, 1e-6); // constant, and nothing comes from the other sheet
      }
    }
  }
}

/// A square whose rim is held at 0: sin(πx) sin(πy) decays like exp(-2π² t).
TEST(HeatDiffusion, LetsHeatGoWhereValuesAreHeld)
{
  const double pi = std::acos(-1.0);
  const TriangleMesh flat = FlatRectangle(40, 40);
  const TriangleMesh mesh = Transform(flat, { 1, 2, 3 }, 0.3);
  MultiVector f(static_cast<Id>(mesh.points.size()), 1);
  for (Id i = 0; i < f.rows(); ++i)
  {
    f(i, 0) = std::sin(pi * flat.points[i][0]) * std::sin(pi * flat.points[i][1]);
  }
  const std::vector<TriangleEdge> rim = FindSurfaceEdges(mesh, true).boundary;
  ASSERT_EQ(rim.size(), 160u);
  for (const bool isOnHats : { false, true })
  {
    for (const TimeScheme scheme : { TimeScheme::BackwardEuler, TimeScheme::SecondOrder })
    {
      const auto space = Build(mesh, isOnHats, 5);
      const double time = 0.05;
      const int steps = 8;
      const DiffusionOptions options =
        Options(time / steps / std::pow(space->UnitLength(), 2), scheme);
      const HeldValues held = HoldEdges(*space, mesh, rim, MultiVector::Zero(f.rows(), 1));
      HeatDiffusion diffusion(
        EquationOf(space, options, held.rows), space->LoadOfValues(OnPoints(f)), {}, held.values);
      for (int k = 0; k < steps; ++k)
      {
        EXPECT_TRUE(diffusion.Advance().converged);
        EXPECT_LT(diffusion.Held().misfit, 1e-6);
      }
      const MultiVector values = space->ValuesAtPoints(diffusion.Coefficients());
      const double left = values.col(0).dot(f.col(0)) / f.squaredNorm();
      const double z = 2.0 * pi * pi * time / steps;
      const double exact =
        scheme == TimeScheme::BackwardEuler ? std::pow(1.0 + z, -steps) : std::exp(-steps * z);
      EXPECT_NEAR(left, exact, 0.01) << isOnHats << " " << int(scheme);
    }
  }
}

/// If the ends of a strip are held at 0 and 1, heat comes to rest on the line between them.
TEST(HeatDiffusion, ComesToRestOnTheHarmonicFunctionOfWhatIsHeld)
{
  const TriangleMesh mesh = Transform(FlatRectangle(30, 10, 3.0, 1.0), { 1, 2, 3 }, 0.3);
  const MultiVector along = PointCoordinates(FlatRectangle(30, 10, 3.0, 1.0)).col(0);
  std::vector<Id> ends;
  for (Id i = 0; i < along.rows(); ++i)
  {
    if (along(i, 0) == 0.0 || along(i, 0) == 3.0)
    {
      ends.push_back(i);
    }
  }
  MultiVector wanted(static_cast<Id>(ends.size()), 1);
  for (Id k = 0; k < wanted.rows(); ++k)
  {
    wanted(k, 0) = along(ends[k], 0);
  }
  for (const bool isOnHats : { false, true })
  {
    const auto space = Build(mesh, isOnHats, 5);
    const HeldValues held = HoldPoints(*space, ends, wanted);
    HeatDiffusion diffusion(EquationOf(space, Options(1e4, TimeScheme::SecondOrder), held.rows),
      MultiVector::Zero(space->NumberOfFunctions(0), 1), {}, held.values);
    for (int k = 0; k < 6; ++k)
    {
      diffusion.Advance();
    }
    EXPECT_LT(RelativeDifference(space->ValuesAtPoints(diffusion.Coefficients()), along), 0.01)
      << isOnHats;
  }
}

TEST(HeatDiffusion, DampsRoughDataAtOnceHoweverLongTheStep)
{
  const TriangleMesh mesh = GeodesicSphere(20);
  const auto space = Build(mesh, true, 4);
  const MultiVector f = RandomValues(static_cast<Id>(mesh.points.size()), 1);
  const MultiVector load = space->LoadOfValues(OnPoints(f));
  const double mean = load.sum() / Total(*space, MultiVector::Ones(load.rows(), 1));
  HeatDiffusion diffusion(EquationOf(space, Options(1e8, TimeScheme::SecondOrder)), load);
  diffusion.Advance();
  EXPECT_LT((diffusion.Coefficients().array() - mean).abs().maxCoeff<Eigen::PropagateNaN>(), 1e-5);
}

TEST(HeatDiffusion, DoesNotDependOnThreadsAndStopsWhenAsked)
{
  const TriangleMesh mesh = GeodesicSphere(20);
  const MultiVector f = RandomValues(static_cast<Id>(mesh.points.size()), 2);
  MultiVector results[2];
  for (const int k : { 0, 1 })
  {
    const int threads = 1 + 2 * k;
    const auto space = Build(mesh, false, 5, threads);
    HeatDiffusion diffusion(EquationOf(space, Options(2.0, TimeScheme::SecondOrder, threads)),
      space->LoadOfValues(OnPoints(f), threads));
    diffusion.Advance(threads);
    results[k] = diffusion.Coefficients();
    const Job stop(threads, Progress([](double done) { return done < 0.5; }));
    EXPECT_THROW(diffusion.Advance(stop), Aborted);
    EXPECT_EQ(diffusion.Coefficients(), results[k]);
  }
  EXPECT_EQ(results[0], results[1]);
}

TEST(HeatDiffusion, RefusesWhatDoesNotFit)
{
  const auto space = Build(GeodesicSphere(4), false, 3);
  const MultiVector load = MultiVector::Ones(space->NumberOfFunctions(0), 2);
  for (const double step : { 0.0, -1.0, std::nan(""), double(INFINITY) })
  {
    EXPECT_THROW(EquationOf(space, Options(step, TimeScheme::SecondOrder)), InvalidInput);
  }
  const DiffusionOptions options = Options(1.0, TimeScheme::SecondOrder);
  const auto equation = EquationOf(space, options);
  EXPECT_THROW(HeatDiffusion(equation, MultiVector::Ones(3, 1)), InvalidInput);
  EXPECT_THROW(HeatDiffusion(equation, load, load.leftCols(1)), InvalidInput);
  const HeldValues held = HoldPoints(*space, { 0, 1 }, MultiVector::Ones(2, 1));
  EXPECT_THROW(HeatDiffusion(equation, load, {}, held.values), InvalidInput); // nothing is held
  const auto holding = EquationOf(space, options, held.rows);
  EXPECT_THROW(HeatDiffusion(holding, load, {}, held.values), InvalidInput); // one column for two
  EXPECT_THROW(HeatDiffusion(holding, load), InvalidInput);
}
