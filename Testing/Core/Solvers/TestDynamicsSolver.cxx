// Compares patterns, waves and transport with exact solutions, and measures order in time and
// conservation. Tests which steps of the solver a change repeats.
#include "AtDepth.h"
#include "EachOption.h"
#include "Equations/Reactions.h"
#include "ExpectOne.h"
#include "Largest.h"
#include "Meshes.h"
#include "Solvers/DynamicsSolver.h"
#include "Solvers/LocalSurface.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

using Mesh = std::shared_ptr<const TriangleMesh>;

Mesh Shared(TriangleMesh mesh)
{
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

SurfaceOptions InWorld(int depth, FunctionKind kind = FunctionKind::Grid)
{
  SurfaceOptions options = AtDepth<DynamicsSolver>(depth);
  options.choice.kind = kind;
  options.parameterUnits = ParameterUnits::World;
  return options;
}

DynamicsSolver::Options Of(DynamicsModel model, double timeStep, int steps, int substeps = 1)
{
  DynamicsSolver::Options options;
  options.equation.solve.tolerance = 1e-11;
  options.model = model;
  options.timeStep = timeStep / substeps;
  options.numberOfSteps = steps * substeps;
  return options;
}

/// Keeps the frames 0, n, 2n ...
DynamicsSolver::Result Every(std::size_t n, DynamicsSolver::Result result)
{
  for (std::size_t k = 0; k * n < result.frames.size(); ++k)
  {
    result.frames[k] = result.frames[k * n];
  }
  result.frames.resize((result.frames.size() + n - 1) / n);
  return result;
}

template<class Function>
DynamicsSolver::Input From(const Mesh& mesh, int components, Function&& function)
{
  MultiVector values(static_cast<Id>(mesh->points.size()), components);
  for (Id i = 0; i < values.rows(); ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      values(i, c) = function(mesh->points[i], c);
    }
  }
  DynamicsSolver::Input input;
  input.start = GivenField::Of("start", { FieldAssociation::Points, values });
  return input;
}

/// The factor of a mode: <now, start> / <start, start> at points of equal weight.
double Factor(const DynamicsSolver::Result& result, std::size_t frame, Id column = 0)
{
  const auto start = result.frames.front().atPoints.col(0);
  return result.frames.at(frame).atPoints.col(column).dot(start) / start.squaredNorm();
}

double LargestDifference(const MultiVector& a, const MultiVector& b)
{
  return (a - b).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

/// Reactions of one place as those that a user gives.
template<class React>
GivenReactions Given(int species, React react)
{
  GivenReactions reactions;
  reactions.species = species;
  reactions.rates = species == 1 ? AtEachPlace<1>(react) : AtEachPlace<2>(react);
  return reactions;
}

double Harmonic2(const Vec3& p)
{
  return p[0] * p[1];
}

double Harmonic3(const Vec3& p)
{
  return p[0] * p[1] * p[2];
}

} // namespace

class ModesOfTheSphere : public ::testing::TestWithParam<FunctionKind>
{
};

INSTANTIATE_TEST_SUITE_P(Functions, ModesOfTheSphere,
  ::testing::Values(FunctionKind::Grid, FunctionKind::Hats),
  [](const auto& tested) { return tested.param == FunctionKind::Grid ? "Grid" : "Hats"; });

TEST_P(ModesOfTheSphere, OscillateWithTheRootOfTheirEigenvalue)
{
  const Mesh mesh = Shared(GeodesicSphere(32));
  const double omega[2] = { std::sqrt(6.0), std::sqrt(12.0) };
  for (int l = 2; l <= 3; ++l)
  {
    const auto input =
      From(mesh, 1, [&](const Vec3& p, int) { return l == 2 ? Harmonic2(p) : Harmonic3(p); });
    const auto result = Every(16, DynamicsSolver::Solve(mesh, input,
                                    Of(DynamicsModel::Wave, 0.25, 4, 16), InWorld(5, GetParam())));
    ASSERT_EQ(result.frames.size(), 5u);
    for (std::size_t k = 0; k < result.frames.size(); ++k)
    {
      const double t = 0.25 * double(k);
      EXPECT_NEAR(Factor(result, k), std::cos(omega[l - 2] * t), 0.02) << l << " at " << t;
      EXPECT_NEAR(Factor(result, k, 1), -omega[l - 2] * std::sin(omega[l - 2] * t), 0.06)
        << l << " at " << t;
    }
  }
}

TEST_P(ModesOfTheSphere, FadeWithTheDamping)
{
  const Mesh mesh = Shared(GeodesicSphere(24));
  const auto input = From(mesh, 1, [](const Vec3& p, int) { return Harmonic2(p); });
  auto options = Of(DynamicsModel::Wave, 0.5, 4, 25);
  options.damping = 0.8;
  const auto result =
    Every(25, DynamicsSolver::Solve(mesh, input, options, InWorld(5, GetParam())));
  const double omega = std::sqrt(6.0 - 0.16);
  for (std::size_t k = 0; k < result.frames.size(); ++k)
  {
    const double t = 0.5 * double(k);
    EXPECT_NEAR(Factor(result, k),
      std::exp(-0.4 * t) * (std::cos(omega * t) + 0.4 / omega * std::sin(omega * t)), 0.01)
      << t;
  }
}

/// Near u = v = 0 Gray-Scott is linear: v falls by F + k + D l (l + 1).
TEST_P(ModesOfTheSphere, DecayInAReactionWithTheirEigenvalue)
{
  const Mesh mesh = Shared(GeodesicSphere(24));
  const auto input =
    From(mesh, 2, [](const Vec3& p, int c) { return c == 0 ? 1.0 : 1e-6 * Harmonic3(p); });
  auto options = Of(DynamicsModel::GrayScott, 5.0, 4, 40);
  options.patternLength = 31.0 * 0.1; // so that D = 0.01 and 0.005
  const auto result =
    Every(40, DynamicsSolver::Solve(mesh, input, options, InWorld(5, GetParam())));
  const auto start = result.frames.front().atPoints.col(1);
  for (std::size_t k = 0; k < result.frames.size(); ++k)
  {
    const double factor = result.frames[k].atPoints.col(1).dot(start) / start.squaredNorm();
    const double rate = options.feed + options.kill + 0.005 * 12.0;
    EXPECT_NEAR(factor, std::exp(-rate * 5.0 * double(k)), 0.005) << k;
  }
}

TEST(DynamicsSolver, KeepsTheEnergyOfWavesAndTheirMean)
{
  for (const FunctionKind kind : { FunctionKind::Grid, FunctionKind::Hats })
  {
    const Mesh mesh = Shared(Torus(60, 24, 1.0, 0.4));
    auto options = Of(DynamicsModel::Wave, 0.3, 6, 7);
    options.patternLength = 0.9; // so that these coarse steps are not divided
    const auto result = Every(7, DynamicsSolver::Solve(mesh, {}, options, InWorld(5, kind)));
    const double energy = result.frames.front().energy;
    EXPECT_GT(energy, 0.0);
    for (const DynamicsSolver::Frame& frame : result.frames)
    {
      EXPECT_NEAR(frame.energy, energy, 1e-8 * energy);
      EXPECT_NEAR(frame.integral[0], result.frames.front().integral[0], 1e-9);
    }
    EXPECT_GT(LargestDifference(result.frames[6].atPoints, result.frames[0].atPoints), 0.3);
  }
}

/// Halving the step divides the difference from a much finer run by four.
TEST(DynamicsSolver, IsOfSecondOrderInTime)
{
  const Mesh mesh = Shared(GeodesicSphere(16));
  struct Case
  {
    DynamicsModel model;
    double time;
    int substeps;
  };
  for (const Case& c : { Case{ DynamicsModel::TuringSpots, 2.0, 20 },
         Case{ DynamicsModel::GrayScott, 40.0, 20 }, Case{ DynamicsModel::FitzHughNagumo, 4.0, 32 },
         Case{ DynamicsModel::AllenCahn, 2.0, 16 }, Case{ DynamicsModel::Wave, 1.0, 16 } })
  {
    const auto run = [&](int substeps)
    {
      auto options = Of(c.model, c.time, 1, substeps);
      options.patternLength = 2.0;
      const auto result = DynamicsSolver::Solve(mesh, {}, options, InWorld(4));
      // Nothing damps the shortest waves, which no step resolves. The part along the start is
      // smooth.
      return c.model == DynamicsModel::Wave
               ? MultiVector::Constant(1, 1, Factor(result, result.frames.size() - 1))
               : result.frames.back().atPoints;
    };
    const MultiVector exact = run(8 * c.substeps);
    const double coarse = LargestDifference(run(c.substeps), exact);
    const double fine = LargestDifference(run(2 * c.substeps), exact);
    EXPECT_GT(coarse, 1e-7) << int(c.model);
    const double rate = std::log2(coarse / fine);
    EXPECT_GT(rate, 1.75) << int(c.model) << ": " << coarse << " " << fine;
    EXPECT_LT(rate, 2.35) << int(c.model) << ": " << coarse << " " << fine;
  }
}

TEST(DynamicsSolver, KeepsAFrontOfAllenCahn)
{
  const Mesh mesh = Shared(Transform(FlatRectangle(80, 16, 4.0, 0.8), { 1, 2, 3 }, 0.5));
  const Mesh flat = Shared(FlatRectangle(80, 16, 4.0, 0.8));
  const double length = 0.15 * 2.0 * std::acos(-1.0); // D = 0.15²
  const auto front = [](const Vec3& p, int)
  { return std::tanh((p[0] - 2.0) / (std::sqrt(2.0) * 0.15)); };
  for (const FunctionKind kind : { FunctionKind::Grid, FunctionKind::Hats })
  {
    auto options = Of(DynamicsModel::AllenCahn, 5.0, 2);
    options.patternLength = length;
    const auto result =
      DynamicsSolver::Solve(mesh, From(flat, 1, front), options, InWorld(7, kind));
    EXPECT_LT(LargestDifference(
                result.frames[2].atPoints, From(flat, 1, front).start.read(NaNs::Refused).values),
      0.02);
  }
}

/// The circle between two phases shrinks as R² = R0² - 2 D t.
TEST(DynamicsSolver, ShrinksACircleOfAllenCahn)
{
  const Mesh mesh = Shared(FlatRectangle(64, 64, 2.0, 2.0));
  constexpr double Width = 0.06;
  const auto disk = [](const Vec3& p, int)
  {
    const double r = std::hypot(p[0] - 1.0, p[1] - 1.0);
    return std::tanh((0.7 - r) / (std::sqrt(2.0) * Width));
  };
  auto options = Of(DynamicsModel::AllenCahn, 10.0, 2);
  options.patternLength = Width * 2.0 * std::acos(-1.0);
  const auto result = DynamicsSolver::Solve(mesh, From(mesh, 1, disk), options, InWorld(7));
  for (std::size_t k = 0; k < result.frames.size(); ++k)
  {
    // ∫ u = A (inside) - A (outside)
    const double inside = 0.5 * (result.frames[k].integral[0] + 4.0);
    const double wanted = std::acos(-1.0) * (0.49 - 2.0 * Width * Width * 10.0 * double(k));
    EXPECT_NEAR(inside, wanted, 0.03) << k;
  }
}

/// An explicit run of fine steps of Euler's method with lumped hats on the same small mesh, written
/// here from the equations.
TEST(DynamicsSolver, AgreesWithExplicitStepsOfGrayScott)
{
  constexpr int N = 40;
  const Mesh mesh = Shared(FlatRectangle(N, N, 1.0, 1.0));
  const auto begin = [](const Vec3& p, int c)
  {
    const double w = std::exp(-20.0 * (std::pow(p[0] - 0.4, 2) + std::pow(p[1] - 0.55, 2)));
    return c == 0 ? 1.0 - 0.5 * w : 0.3 * w;
  };
  auto options = Of(DynamicsModel::GrayScott, 200.0, 1, 400);
  options.patternLength = 1.0;
  const auto input = From(mesh, 2, begin);
  const auto result = DynamicsSolver::Solve(mesh, input, options, InWorld(4, FunctionKind::Hats));

  // On squares cut in two, lumped hats are the five-point formula.
  const double h = 1.0 / N;
  const double diffusion[2] = { std::pow(1.0 / 31.0, 2), 0.5 * std::pow(1.0 / 31.0, 2) };
  MultiVector u = result.frames.front().atPoints;
  constexpr int Steps = 4000;
  const double dt = 200.0 / Steps;
  const auto at = [](int i, int j)
  {
    const auto mirrored = [](int k) { return k < 0 ? -k : k > N ? 2 * N - k : k; };
    return mirrored(j) * (N + 1) + mirrored(i);
  };
  for (int step = 0; step < Steps; ++step)
  {
    MultiVector next = u;
    for (int j = 0; j <= N; ++j)
    {
      for (int i = 0; i <= N; ++i)
      {
        const Id k = at(i, j);
        const double made = u(k, 0) * u(k, 1) * u(k, 1);
        const double rate[2] = { 0.037 * (1.0 - u(k, 0)) - made, made - 0.097 * u(k, 1) };
        for (int c = 0; c < 2; ++c)
        {
          const double laplacian = (u(at(i - 1, j), c) + u(at(i + 1, j), c) + u(at(i, j - 1), c) +
                                     u(at(i, j + 1), c) - 4.0 * u(k, c)) /
                                   (h * h);
          next(k, c) += dt * (diffusion[c] * laplacian + rate[c]);
        }
      }
    }
    u = next;
  }
  const double moved = LargestDifference(u, result.frames.front().atPoints);
  EXPECT_GT(moved, 0.3);
  EXPECT_LT(LargestDifference(result.frames.back().atPoints, u), 0.05 * moved);
}

/// The wind of a rigid rotation turns a harmonic, and the diffusion fades it.
TEST(DynamicsSolver, CarriesAHarmonicAndKeepsItsIntegral)
{
  const Mesh mesh = Shared(GeodesicSphere(24));
  for (const FunctionKind kind : { FunctionKind::Grid, FunctionKind::Hats })
  {
    DynamicsSolver::Input input = From(mesh, 1, [](const Vec3& p, int) { return 1.0 + p[0]; });
    input.velocity = From(mesh, 3,
      [](const Vec3& p, int c) {
        return c == 0 ? -p[1] : c == 1 ? p[0] : 0.0;
      }).start;
    auto options = Of(DynamicsModel::Transport, 0.5, 3);
    options.diffusivity = 0.01;
    const auto result = DynamicsSolver::Solve(mesh, input, options, InWorld(5, kind));
    for (std::size_t k = 0; k < result.frames.size(); ++k)
    {
      const double t = 0.5 * double(k);
      const auto exact = From(mesh, 1,
        [t](const Vec3& p, int)
        { return 1.0 + std::exp(-0.02 * t) * (p[0] * std::cos(t) + p[1] * std::sin(t)); });
      EXPECT_LT(
        LargestDifference(result.frames[k].atPoints, exact.start.read(NaNs::Refused).values), 0.02)
        << k;
      EXPECT_NEAR(result.frames[k].integral[0] / result.frames[0].integral[0], 1.0, 1e-9);
    }
  }
}

/// Two triangles that are larger than the front, and the same square in small triangles.
TEST(DynamicsSolver, ReactsInsideOfLargeTriangles)
{
  const auto integrals = [](int n)
  {
    const Mesh mesh = Shared(Transform(FlatRectangle(n, n, 1.0, 1.0), { 1, 2, 3 }, 0.3));
    const Mesh flat = Shared(FlatRectangle(n, n, 1.0, 1.0));
    auto options = Of(DynamicsModel::AllenCahn, 1.0, 3);
    options.patternLength = 0.5;
    const auto input = From(flat, 1, [](const Vec3& p, int) { return p[0] - 0.4 * p[1]; });
    const auto result = DynamicsSolver::Solve(mesh, input, options, InWorld(5));
    EXPECT_EQ(result.warnings.empty(), n > 1);
    std::vector<double> sums;
    for (const DynamicsSolver::Frame& frame : result.frames)
    {
      sums.push_back(frame.integral[0]);
    }
    return sums;
  };
  const std::vector<double> coarse = integrals(1);
  const std::vector<double> fine = integrals(40);
  EXPECT_NEAR(fine[0], 0.3, 1e-9);
  EXPECT_GT(fine[3], 0.6); // the larger phase wins
  for (std::size_t k = 0; k < fine.size(); ++k)
  {
    EXPECT_NEAR(coarse[k], fine[k], 0.003) << k;
  }
}

TEST(DynamicsSolver, GrowsSpotsOfThePatternLengthFromAnySeed)
{
  const Mesh mesh = Shared(GeodesicSphere(24));
  DynamicsSolver::Options options;
  options.patternLength = 0.2;
  options.numberOfSteps = 35;
  for (const int seed : { 1, 2 })
  {
    options.seed = seed;
    SurfaceOptions surface = AtDepth<DynamicsSolver>(5);
    const auto result = DynamicsSolver::Solve(mesh, {}, options, surface);
    const auto u = result.frames.back().atPoints.col(0);
    EXPECT_LT(u.minCoeff<Eigen::PropagateNaN>(), 0.4);
    EXPECT_GT(u.maxCoeff<Eigen::PropagateNaN>(), 3.0);
    EXPECT_TRUE(result.warnings.empty());
    // Spots in a hexagonal order at this distance have the area 0.866 · 0.2² each.
    Id spots = 0;
    for (Id point = 0; point < u.size(); ++point)
    {
      bool isTop = u[point] > 2.0;
      for (Id other = 0; isTop && other < u.size(); ++other)
      {
        const double distance = (mesh->points[point] - mesh->points[other]).norm();
        isTop = distance > 0.2 || u[other] <= u[point];
      }
      spots += isTop ? 1 : 0;
    }
    const double expected = 1.0 / (0.866 * 0.04);
    EXPECT_GT(double(spots), 0.6 * expected) << seed;
    EXPECT_LT(double(spots), 1.6 * expected) << seed;
  }
}

TEST(DynamicsSolver, HasTheSameBitsOnAnyNumberOfThreads)
{
  const Mesh mesh = Shared(Torus(60, 24, 1.0, 0.4));
  for (const DynamicsModel model : { DynamicsModel::TuringSpots, DynamicsModel::FitzHughNagumo,
         DynamicsModel::Wave, DynamicsModel::Transport })
  {
    DynamicsSolver::Input input;
    input.velocity = From(mesh, 3, [](const Vec3& p, int c) { return p[(c + 1) % 3]; }).start;
    const auto run = [&](int threads)
    {
      DynamicsSolver::Options options;
      options.model = model;
      options.numberOfSteps = 3;
      SurfaceOptions surface = InWorld(5);
      surface.space.threads = threads;
      return DynamicsSolver::Solve(mesh, input, options, surface).frames.back().atPoints;
    };
    EXPECT_EQ(run(1), run(3)) << int(model);
  }
}

TEST(DynamicsSolver, ContinuesInsteadOfBeginningAgain)
{
  const Mesh mesh = Shared(GeodesicSphere(12));
  Stages stages;
  LocalSurface surface(stages, mesh, InWorld(4));
  DynamicsSolver solver;
  DynamicsSolver::Options options;
  options.patternLength = 1.0;
  options.numberOfSteps = 2;
  solver.Update(surface, {}, options);
  EXPECT_EQ(stages.Runs(SolveStage), 2);
  options.numberOfSteps = 5;
  const MultiVector continued = solver.Update(surface, {}, options).frames.at(5).atPoints;
  EXPECT_EQ(stages.Runs(SolveStage), 5);
  EXPECT_EQ(DynamicsSolver::Solve(mesh, {}, options, InWorld(4)).frames.at(5).atPoints, continued);
  options.numberOfSteps = 1;
  solver.Update(surface, {}, options);
  EXPECT_EQ(stages.Runs(SolveStage), 5);
  options.seed = 2; // repeats the steps alone
  solver.Update(surface, {}, options);
  EXPECT_EQ(stages.Runs(HierarchyStage), 1);
  EXPECT_EQ(stages.Runs(SolveStage), 6);
  options.timeStep = 0.7;
  solver.Update(surface, {}, options);
  EXPECT_EQ(stages.Runs(HierarchyStage), 2);
}

TEST(DynamicsSolver, GoesOnAfterAnAbort)
{
  const Mesh mesh = Shared(GeodesicSphere(12));
  Stages stages;
  LocalSurface surface(stages, mesh, InWorld(4));
  DynamicsSolver solver;
  DynamicsSolver::Options options;
  options.patternLength = 1.0;
  options.numberOfSteps = 3;
  const MultiVector whole =
    DynamicsSolver::Solve(mesh, {}, options, InWorld(4)).frames.back().atPoints;
  for (const double end : { 0.5, 0.7 })
  {
    EXPECT_THROW(solver.Update(surface, {}, options,
                   { 0, Progress([end](double done) { return done < end; }) }),
      Aborted);
  }
  EXPECT_EQ(solver.Update(surface, {}, options).frames.back().atPoints, whole);
}

TEST(DynamicsSolver, DisturbsSelectedPointsAlone)
{
  const Mesh mesh = Shared(GeodesicSphere(16));
  Id top = 0;
  for (Id i = 0; i < static_cast<Id>(mesh->points.size()); ++i)
  {
    top = mesh->points[i][2] > mesh->points[top][2] ? i : top;
  }
  DynamicsSolver::Input input;
  input.disturbed.property = "Selection";
  input.disturbed.find = [top] { return PointValues{ { top }, MultiVector::Ones(1, 1) }; };
  for (const DynamicsModel model : { DynamicsModel::Wave, DynamicsModel::FitzHughNagumo })
  {
    DynamicsSolver::Options options;
    options.model = model;
    options.numberOfSteps = 1;
    options.patternLength = 0.5;
    const auto result = DynamicsSolver::Solve(mesh, input, options, InWorld(5));
    const auto u = result.frames.front().atPoints.col(0);
    const double rest = model == DynamicsModel::Wave ? 0.0 : FitzHughNagumo().rest[0];
    const double height = model == DynamicsModel::Wave ? 1.0 : 2.5;
    EXPECT_NEAR(u[top], rest + height, 0.35 * height);
    for (Id i = 0; i < u.size(); ++i)
    {
      if (mesh->points[i][2] < 0.0)
      {
        EXPECT_NEAR(u[i], rest, 0.02 * height);
      }
    }
  }
  input.disturbed.find = [] { return PointValues{ {}, MultiVector(0, 1) }; };
  EXPECT_THROW(
    DynamicsSolver::Solve(mesh, input, DynamicsSolver::Options(), InWorld(4)), InvalidInput);
}

TEST(DynamicsSolver, TellsWhatIsWrong)
{
  const Mesh mesh = Shared(GeodesicSphere(8));
  const auto message = [&](const DynamicsSolver::Input& input, DynamicsModel model, double length)
  {
    DynamicsSolver::Options options;
    options.model = model;
    options.patternLength = length;
    options.numberOfSteps = 1;
    try
    {
      const auto result = DynamicsSolver::Solve(mesh, input, options, InWorld(4));
      return result.warnings.empty() ? std::string() : result.warnings.front();
    }
    catch (const InvalidInput& error)
    {
      return std::string(error.what());
    }
  };
  const auto three = From(mesh, 3, [](const Vec3& p, int c) { return p[c]; });
  EXPECT_EQ(message({}, DynamicsModel::AllenCahn, 2.0), "");
  EXPECT_EQ(message({}, DynamicsModel::AllenCahn, 0.0), "Pattern Length is 0. It must be above 0.");
  EXPECT_EQ(message(three, DynamicsModel::Wave, 1.0),
    "Start Array 'start' has 3 components for 2 unknowns of this Model.");
  EXPECT_EQ(message({}, DynamicsModel::Transport, 1.0),
    "Transport needs a Velocity Array with 3 components.");
  EXPECT_EQ(message({}, DynamicsModel::TuringSpots, 0.1).find("The Pattern Length is only "), 0u);
}

TEST(DynamicsSolver, GivenReactionsAreAsGoodAsNamedOnes)
{
  const Mesh mesh = Shared(GeodesicSphere(12));
  auto options = Of(DynamicsModel::TuringSpots, 0.02, 30);
  options.patternLength = 12.1 * 0.05;
  auto input = From(mesh, 2, [](const Vec3& p, int c) { return c == 0 ? 1.0 + 0.3 * p[0] : 0.9; });
  const auto named = DynamicsSolver::Solve(mesh, input, options, InWorld(5));
  options.model = DynamicsModel::Custom;
  options.diffusivity = 0.05 * 0.05;
  options.diffusivityV = 40.0 * options.diffusivity;
  input.reactions = Given(2,
    [](const double* u, double* rates)
    {
      rates[0] = 0.1 - u[0] + u[0] * u[0] * u[1];
      rates[1] = 0.9 - u[0] * u[0] * u[1];
    });
  const auto given = DynamicsSolver::Solve(mesh, input, options, InWorld(5));
  ASSERT_EQ(given.frames.size(), named.frames.size());
  EXPECT_GT(LargestDifference(named.frames[30].atPoints, named.frames[0].atPoints), 0.05);
  EXPECT_LT(LargestDifference(given.frames[30].atPoints, named.frames[30].atPoints), 1e-9);
}

/// A wave of Fisher's equation u' = u'' + u (1 - u) that Ablowitz and Zeppetella know exactly. It
/// runs at the speed 5/√6.
TEST(DynamicsSolver, AnInvasionRunsAtItsSpeed)
{
  const Mesh mesh = Shared(FlatRectangle(96, 8, 48.0, 4.0));
  const auto wave = [](double t)
  {
    return [t](const Vec3& p, int)
    {
      return std::pow(
        1.0 + std::exp((p[0] - 12.0 - 5.0 / std::sqrt(6.0) * t) / std::sqrt(6.0)), -2.0);
    };
  };
  for (const FunctionKind kind : { FunctionKind::Grid, FunctionKind::Hats })
  {
    auto options = Of(DynamicsModel::Custom, 1.0, 6);
    options.patternLength = 10.0;
    options.diffusivity = 1.0;
    auto input = From(mesh, 1, wave(0.0));
    input.reactions =
      Given(1, [](const double* u, double* rates) { rates[0] = u[0] * (1.0 - u[0]); });
    const auto result = DynamicsSolver::Solve(mesh, input, options, InWorld(7, kind));
    for (std::size_t k = 0; k < result.frames.size(); ++k)
    {
      const auto exact = From(mesh, 1, wave(double(k))).start.read(NaNs::Refused).values;
      EXPECT_LT(LargestDifference(result.frames[k].atPoints, exact), 0.02) << k;
    }
  }
}

/// Without an edge in the start everything grows as u' = r u (1 - u) does. A rate of a thousand
/// takes steps of less than a thousandth.
TEST(DynamicsSolver, ResolvesGivenReactionsByItself)
{
  const Mesh mesh = Shared(GeodesicSphere(6));
  for (const double r : { 0.5, 1000.0 })
  {
    auto options = Of(DynamicsModel::Custom, 3.0 / r, 2);
    options.patternLength = 2.0;
    auto input = From(mesh, 1, [](const Vec3&, int) { return 0.2; });
    input.reactions =
      Given(1, [r](const double* u, double* rates) { rates[0] = r * u[0] * (1.0 - u[0]); });
    const auto result = DynamicsSolver::Solve(mesh, input, options, InWorld(3));
    EXPECT_TRUE(result.warnings.empty());
    for (int k = 0; k <= 2; ++k)
    {
      const double exact = 1.0 / (1.0 + 4.0 * std::exp(-3.0 * k));
      const MultiVector& u = result.frames[static_cast<std::size_t>(k)].atPoints;
      EXPECT_NEAR(u.minCoeff<Eigen::PropagateNaN>(), exact, 0.02) << r << " " << k;
      EXPECT_NEAR(u.maxCoeff<Eigen::PropagateNaN>(), exact, 0.02) << r << " " << k;
    }
  }
}

TEST(DynamicsSolver, RunsAgainWhenGivenReactionsChange)
{
  const Mesh mesh = Shared(GeodesicSphere(6));
  Stages stages;
  LocalSurface surface(stages, mesh, InWorld(3));
  DynamicsSolver solver;
  auto options = Of(DynamicsModel::Custom, 1.0, 1);
  options.patternLength = 2.0;
  DynamicsSolver::Input input;
  const auto decay = [&](double rate)
  {
    input.reactions = Given(1, [rate](const double* u, double* rates) { rates[0] = -rate * u[0]; });
    input.reactions.version.Add(rate);
    return MultiVector(solver.Update(surface, input, options).frames[1].atPoints);
  };
  const MultiVector slow = decay(0.1);
  const MultiVector fast = decay(1.0);
  EXPECT_NEAR(fast.sum() / slow.sum(), std::exp(-0.9), 0.02);
  EXPECT_EQ(decay(0.1), slow);
  input.reactions = {};
  EXPECT_THROW(solver.Update(surface, input, options), InvalidInput);
}

/// In units of the largest values, so that the units of the species do not matter.
TEST(Reactions, ThoseOfALinearSystemRespondByItsRows)
{
  const auto linear = Given(2,
    [](const double* u, double* rates)
    {
      rates[0] = 3.0 * u[0] - 2.0 * u[1];
      rates[1] = u[1];
    });
  EXPECT_NEAR(FastestResponse(linear.rates, { 0.0, 0.0 }, { 1.0, 1.0 }), 5.0, 1e-9);
  EXPECT_NEAR(FastestResponse(linear.rates, { 0.0, 0.0 }, { 2.0, 5.0 }), 8.0, 1e-9);
  EXPECT_NEAR(FastestResponse(linear.rates, { 2.0, 5.0 }, { 2.0, 5.0 }), 8.0, 1e-6);
  EXPECT_NEAR(FastestResponse(linear.rates, { 0.0, 0.0 }, { 1e-9, 1e-9 }), 5.0, 1e-6);
  EXPECT_NEAR(FastestResponse(linear.rates, { 0.0, 0.0 }, { 0.0, 0.0 }), 5.0, 1e-6);
  const auto pole = Given(1, [](const double* u, double* rates) { rates[0] = 1.0 / u[0]; });
  const double response = FastestResponse(pole.rates, { 0.0 }, { 1.0 }); // infinite at 0
  EXPECT_NEAR(response, 16.0 * 16.0 / 2.0, 1e-9);
  const auto constant = Given(1, [](const double*, double* rates) { rates[0] = 7.0; });
  EXPECT_EQ(FastestResponse(constant.rates, { -1.0 }, { 1.0 }), 0.0);
}

/// u' = u - u³ from 3 falls to 1 within the first step. A step of Euler's method would jump to the
/// other phase.
TEST(DynamicsSolver, ShortensTheFirstStep)
{
  const Mesh mesh = Shared(GeodesicSphere(6));
  auto options = Of(DynamicsModel::AllenCahn, 0.2, 2);
  options.patternLength = 2.0;
  const auto input = From(mesh, 1, [](const Vec3&, int) { return 3.0; });
  const auto result = DynamicsSolver::Solve(mesh, input, options, InWorld(3));
  for (int k = 1; k <= 2; ++k)
  {
    const double exact = 1.0 / std::sqrt(1.0 - 8.0 / 9.0 * std::exp(-0.4 * k));
    EXPECT_NEAR(result.frames[static_cast<std::size_t>(k)].atPoints.mean(), exact, 0.05) << k;
  }
}

/// v is 0 until u has fallen to a half, and a value that passes 0 has no small steps there.
TEST(DynamicsSolver, DoesNotShortenStepsForSmallValues)
{
  const Mesh mesh = Shared(GeodesicSphere(6));
  auto options = Of(DynamicsModel::Custom, 0.2, 10);
  options.patternLength = 2.0;
  auto input = From(mesh, 2, [](const Vec3&, int c) { return c == 0 ? 1.0 : 0.0; });
  input.reactions = Given(2,
    [](const double* u, double* rates)
    {
      rates[0] = -u[0];
      rates[1] = u[0] < 0.5 ? 1.0 : 0.0;
    });
  const auto delayed = DynamicsSolver::Solve(mesh, input, options, InWorld(3));
  EXPECT_TRUE(delayed.warnings.empty());
  EXPECT_NEAR(delayed.frames[10].atPoints.col(1).mean(), 2.0 - std::log(2.0), 0.02);

  input.reactions = Given(2,
    [](const double* u, double* rates)
    {
      rates[0] = u[1];
      rates[1] = -u[0];
    });
  const auto turned = DynamicsSolver::Solve(mesh, input, options, InWorld(3));
  EXPECT_TRUE(turned.warnings.empty());
  EXPECT_NEAR(turned.frames[10].atPoints.col(0).mean(), std::cos(2.0), 0.02);
  EXPECT_LT(turned.frames[10].extrapolationError, 0.02);
}

TEST(DynamicsSolver, TellsOfReactionsThatAreUndefined)
{
  const Mesh mesh = Shared(GeodesicSphere(6));
  auto options = Of(DynamicsModel::Custom, 0.05, 12);
  options.patternLength = 2.0;
  auto input = From(mesh, 1, [](const Vec3&, int) { return 1.0; });
  input.reactions =
    Given(1, [](const double* u, double* rates) { rates[0] = -5.0 * std::sqrt(u[0]); });
  for (const int iterations : { 200, 1 })
  {
    options.equation.solve.maximumIterations = iterations;
    const auto result = DynamicsSolver::Solve(mesh, input, options, InWorld(3));
    EXPECT_TRUE(result.frames[12].atPoints.hasNaN());
    ExpectOne(result.warnings, "undefined for some values");
  }
}

/// Another solve that has ended early does not hide that values are lost.
TEST(SolveReport, ALostSolveIsTheWorst)
{
  SolveReport lost;
  lost.end = SolveEnd::NotFinite;
  SolveReport early;
  early.end = SolveEnd::IterationLimit;
  early.iterations = 9;
  SolveReport kept = early;
  KeepWorse(lost, kept);
  EXPECT_EQ(kept.end, SolveEnd::NotFinite);
  KeepWorse(early, kept);
  EXPECT_EQ(kept.end, SolveEnd::NotFinite);
}

/// So far from its usual values, Gray-Scott is faster than its usual step.
TEST(DynamicsSolver, ShortensStepsThatAreTooLong)
{
  const Mesh mesh = Shared(GeodesicSphere(8));
  auto options = Of(DynamicsModel::GrayScott, 8.0, 3);
  options.patternLength = 2.0;
  auto fine = Of(DynamicsModel::GrayScott, 8.0, 3, 64);
  fine.patternLength = 2.0;
  const auto input = From(mesh, 2, [](const Vec3&, int c) { return c == 0 ? 1.0 : 0.9; });
  Stages stages;
  LocalSurface surface(stages, mesh, InWorld(4));
  DynamicsSolver solver;
  const DynamicsSolver::Result first = solver.Update(surface, input, options);
  EXPECT_TRUE(solver.Warnings(3).empty());
  const auto exact = Every(64, DynamicsSolver::Solve(mesh, input, fine, InWorld(4)));
  for (std::size_t k = 0; k <= 3; ++k)
  {
    EXPECT_LT(LargestDifference(first.frames[k].atPoints, exact.frames[k].atPoints), 0.03) << k;
  }
  // Another start begins with the usual steps, as that of a new solver does.
  auto calm = From(mesh, 2, [](const Vec3&, int c) { return c == 0 ? 1.0 : 0.1; });
  calm.start.version.Add(1);
  EXPECT_EQ(solver.Update(surface, calm, options).frames[3].atPoints,
    DynamicsSolver::Solve(mesh, calm, options, InWorld(4)).frames[3].atPoints);
  EXPECT_EQ(solver.Update(surface, input, options).frames[3].atPoints, first.frames[3].atPoints);
}

/// Models have different numbers of unknowns.
TEST(DynamicsSolver, AnotherModelKeepsNothing)
{
  const Mesh mesh = Shared(GeodesicSphere(8));
  auto input = From(mesh, 1, [](const Vec3& p, int) { return std::sin(3.0 * p[0]) + p[2]; });
  input.velocity = From(mesh, 3, [](const Vec3& p, int c) { return p[(c + 1) % 3]; }).start;
  input.reactions = Given(1, [](const double* u, double* rates) { rates[0] = 1.0 - u[0]; });
  Stages stages;
  LocalSurface surface(stages, mesh, InWorld(4));
  DynamicsSolver solver;
  for (const int model : { 5, 1, 3, 2, 6, 0, 4, 1, 5 })
  {
    auto options = Of(DynamicsModel(model), 0.0, 1);
    options.patternLength = 1.0;
    const DynamicsSolver::Result fresh = DynamicsSolver::Solve(mesh, input, options, InWorld(4));
    const DynamicsSolver::Result& kept = solver.Update(surface, input, options);
    EXPECT_EQ(kept.frames[1].atPoints, fresh.frames[1].atPoints) << model;
    EXPECT_EQ(kept.frames[1].extrapolationError, fresh.frames[1].extrapolationError) << model;
  }
}

/// At any moment, also while steps become shorter.
TEST(DynamicsSolver, GoesOnAfterAnAbortWhileStepsBecomeShorter)
{
  const Mesh mesh = Shared(GeodesicSphere(6));
  auto options = Of(DynamicsModel::GrayScott, 8.0, 2);
  options.patternLength = 2.0;
  const auto input = From(mesh, 2, [](const Vec3&, int c) { return c == 0 ? 1.0 : 0.9; });
  const MultiVector whole =
    DynamicsSolver::Solve(mesh, input, options, InWorld(3)).frames.back().atPoints;
  Stages stages;
  LocalSurface surface(stages, mesh, InWorld(3));
  DynamicsSolver solver;
  int aborts = 0;
  for (int allowed = 3; allowed < 4000; allowed += 7)
  {
    int calls = 0;
    const Progress progress([&](double) { return ++calls < allowed; });
    try
    {
      EXPECT_EQ(
        solver.Update(surface, input, options, { 0, progress }).frames.back().atPoints, whole);
      break;
    }
    catch (const Aborted&)
    {
      ++aborts;
    }
  }
  EXPECT_GT(aborts, 5);
  EXPECT_EQ(solver.Update(surface, input, options).frames.back().atPoints, whole);
}

/// u' = u² is u = 1 / (1 - t), which ends at the time 1.
TEST(DynamicsSolver, TellsOfReactionsWithoutEnd)
{
  const Mesh mesh = Shared(GeodesicSphere(6));
  auto options = Of(DynamicsModel::Custom, 0.4, 4);
  options.patternLength = 2.0;
  auto input = From(mesh, 1, [](const Vec3&, int) { return 1.0; });
  input.reactions = Given(1, [](const double* u, double* rates) { rates[0] = u[0] * u[0]; });
  Stages stages;
  LocalSurface surface(stages, mesh, InWorld(3));
  DynamicsSolver solver;
  const auto& result = solver.Update(surface, input, options);
  EXPECT_NEAR(1.0 - 1.0 / result.frames[1].atPoints.maxCoeff<Eigen::PropagateNaN>(), 0.4, 0.02);
  EXPECT_NEAR(1.0 - 1.0 / result.frames[2].atPoints.maxCoeff<Eigen::PropagateNaN>(), 0.8, 0.04);
  EXPECT_TRUE(solver.Warnings(2).empty());
  ASSERT_EQ(solver.Warnings(4).size(), 1u);
}

TEST(DynamicsSolver, TellsOfValuesOutOfTheRangeOfNumbers)
{
  const Mesh mesh = Shared(GeodesicSphere(8));
  Stages stages;
  LocalSurface surface(stages, mesh, InWorld(4));
  DynamicsSolver solver;
  DynamicsSolver::Options options;
  options.model = DynamicsModel::AllenCahn;
  options.patternLength = 2.0;
  options.numberOfSteps = 2;
  options.timeStep = 40.0;
  const auto input = From(mesh, 1, [](const Vec3&, int) { return 1e8; });
  solver.Update(surface, input, options);
  const std::vector<std::string> warnings = solver.Warnings(2);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].find("The values have left the range of numbers."), 0u);
  EXPECT_TRUE(solver.Warnings(0).empty());
}
