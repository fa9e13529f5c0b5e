// Compares the solver with exact decay and the exact kernel. Tests which of its steps a change
// repeats.
#include "AtDepth.h"
#include "EachOption.h"
#include "Meshes.h"
#include "Solvers/DiffusionSolver.h"
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

DiffusionSolver::Input HeightOn(const TriangleMesh& mesh)
{
  DiffusionSolver::Input input;
  input.values = GivenField::Of("z", { FieldAssociation::Points, PointCoordinates(mesh).col(2) });
  return input;
}

SurfaceOptions InWorldUnits(int depth)
{
  SurfaceOptions options = AtDepth<DiffusionSolver>(depth);
  options.parameterUnits = ParameterUnits::World;
  return options;
}

DiffusionSolver::Options For(double time, int steps)
{
  DiffusionSolver::Options options;
  options.equation.solve.tolerance = 1e-10;
  options.equation.accuracy = 0.0;
  options.diffusionTime = time;
  options.numberOfSteps = steps;
  return options;
}

GivenField Series(const TriangleMesh& mesh, Id columns, std::int64_t number)
{
  MultiVector values(static_cast<Id>(mesh.points.size()), columns);
  for (Id i = 0; i < values.rows(); ++i)
  {
    for (Id c = 0; c < columns; ++c)
    {
      values(i, c) = std::sin((1.0 + 0.3 * double(c)) * mesh.points[i][2] + double(number));
    }
  }
  return GivenField::Of("series", { FieldAssociation::Points, values }, number);
}

DiffusionSolver::Options OfWidth(DiffusionAmount amount, double width, int steps)
{
  DiffusionSolver::Options options;
  // Moments count what the solver leaves far from the source.
  options.equation.solve.tolerance = 1e-7;
  options.equation.accuracy = 0.0;
  options.amount = amount;
  options.fullWidth = width;
  options.sigma = width;
  options.numberOfSteps = steps;
  return options;
}

SurfaceOptions OnFunctions(FunctionKind kind)
{
  SurfaceOptions options = DiffusionSolver::SurfaceDefaults();
  options.choice.kind = kind;
  return options;
}

const double FourLn2 = 4.0 * std::log(2.0);

MultiVector Smoothed(const std::shared_ptr<const TriangleMesh>& mesh, const MultiVector& values,
  const DiffusionSolver::Options& options, FunctionKind kind)
{
  DiffusionSolver::Input input;
  input.values = GivenField::Of("f", { FieldAssociation::Points, values });
  return DiffusionSolver::Solve(mesh, input, options, OnFunctions(kind)).steps.back().atPoints;
}

/// A Gaussian on a square of equal squares with side 1, which is turned in space.
struct Plane
{
  explicit Plane(int squares) : n(squares)
  {
    flat = FlatRectangle(n, n, n, n);
    mesh = std::make_shared<const TriangleMesh>(Transform(flat, { 1, 2, 3 }, 0.3));
  }

  double SquaredRadius(Id i) const
  {
    const Vec3& p = flat.points[i];
    return std::pow(p[0] - n / 2, 2) + std::pow(p[1] - n / 2, 2);
  }

  MultiVector Gaussian(double fullWidth) const
  {
    MultiVector u(static_cast<Id>(flat.points.size()), 1);
    for (Id i = 0; i < u.rows(); ++i)
    {
      u(i, 0) = std::exp(-FourLn2 * this->SquaredRadius(i) / (fullWidth * fullWidth));
    }
    return u;
  }

  /// The full width of the Gaussian with the second moment of u.
  double WidthOf(const MultiVector& u) const
  {
    double moment = 0.0;
    for (Id i = 0; i < u.rows(); ++i)
    {
      moment += this->SquaredRadius(i) * u(i, 0);
    }
    return std::sqrt(FourLn2 * moment / u.sum());
  }

  /// The full width at which u falls to half of its value in the middle, along a line of points.
  double WidthAtHalf(const MultiVector& u) const
  {
    const Id middle = (n / 2) * (n + 1) + n / 2;
    const double half = 0.5 * u(middle, 0);
    Id k = 0;
    while (k < n / 2 && u(middle + k, 0) > half)
    {
      ++k;
    }
    const double above = u(middle + k - 1, 0);
    return 2.0 * (double(k - 1) + (above - half) / (above - u(middle + k, 0)));
  }

  int n;
  TriangleMesh flat;
  std::shared_ptr<const TriangleMesh> mesh;
};

} // namespace

TEST(DiffusionSolver, LetsAHarmonicOfTheSphereDecay)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(40));
  const DiffusionSolver::Result result =
    DiffusionSolver::Solve(mesh, HeightOn(*mesh), For(0.2, 8), InWorldUnits(5));
  ASSERT_EQ(result.steps.size(), 8u);
  EXPECT_NEAR(result.stepLength, 0.025, 1e-12);
  const MultiVector exact = std::exp(-2.0 * 0.2) * PointCoordinates(*mesh).col(2);
  const double error =
    (result.steps.back().atPoints - exact).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  EXPECT_LT(error, 5e-3); // cells of side 0.06: second order
}

/// A constant that is far larger than the variation stays, and the variation spreads as without.
TEST(DiffusionSolver, KeepsTheVariationAboveALargeConstant)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(16));
  const DiffusionSolver::Input plain = HeightOn(*mesh);
  const MultiVector expected =
    DiffusionSolver::Solve(mesh, plain, For(0.5, 2), InWorldUnits(4)).steps.back().atPoints;
  for (const double constant : { 1e6, -1e9, 1e12 })
  {
    Field values = plain.values.read(NaNs::Refused);
    values.values.array() += constant;
    DiffusionSolver::Input input;
    input.values = GivenField::Of("f", values);
    MultiVector found =
      DiffusionSolver::Solve(mesh, input, For(0.5, 2), InWorldUnits(4)).steps.back().atPoints;
    found.array() -= constant;
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
      1e-6 + 4e-16 * std::abs(constant));
  }
}

TEST(DiffusionSolver, MoreStepsOfTheSameLengthGoOnFromTheLast)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(16));
  const DiffusionSolver::Input input = HeightOn(*mesh);
  Stages stages;
  LocalSurface surface(stages, mesh, InWorldUnits(4));
  DiffusionSolver solver;
  solver.Update(surface, input, For(0.25, 2), {});
  EXPECT_EQ(stages.Runs(SolveStage), 2);
  const MultiVector six = solver.Update(surface, input, For(0.75, 6), {}).steps.back().atPoints;
  EXPECT_EQ(stages.Runs(SolveStage), 6);
  EXPECT_EQ(stages.Runs(HierarchyStage), 1);
  const DiffusionSolver::Result fresh =
    DiffusionSolver::Solve(mesh, input, For(0.75, 6), InWorldUnits(4));
  EXPECT_EQ(six, fresh.steps.back().atPoints);
  solver.Update(surface, input, For(0.375, 6), {});
  EXPECT_EQ(stages.Runs(HierarchyStage), 2);
}

/// Smoothing by a width adds its square to the square of the width that was there. Values are
/// linear between the points, which alone widens them by about an edge. Smoothing by Least has
/// this, too.
constexpr double Least = 2.0; // edges

/// The second moment is exact with a single step. The shape takes several, and points enough.
TEST(DiffusionSolver, SmoothsByTheGaussianOnAPlane)
{
  constexpr double Before = 6.0; // edges
  for (const double added : { 4.0, 12.0, 40.0 })
  {
    const double after = std::hypot(Before, added);
    const Plane plane(2 * int(1.8 * after)); // four standard deviations, and more
    const MultiVector start = plane.Gaussian(Before);
    for (const FunctionKind kind : { FunctionKind::Grid, FunctionKind::Hats })
    {
      const auto widthOf = [&](double width)
      {
        return plane.WidthOf(
          Smoothed(plane.mesh, start, OfWidth(DiffusionAmount::FullWidth, width, 1), kind));
      };
      const double found =
        std::sqrt(std::pow(widthOf(added), 2) - std::pow(widthOf(Least), 2) + Least * Least);
      EXPECT_NEAR(found, added, 0.01 * added) << int(kind);
      const double sigma = added / std::sqrt(2.0 * FourLn2);
      const MultiVector often =
        Smoothed(plane.mesh, start, OfWidth(DiffusionAmount::Sigma, sigma, 8), kind);
      EXPECT_NEAR(plane.WidthAtHalf(often), after, 0.01 * after + 0.05) << int(kind) << added;
    }
  }
}

/// On a unit sphere the heat of a point has the mean cosine exp(-2 t) of its distance.
TEST(DiffusionSolver, SmoothsByTheKernelOfASphere)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(24));
  MultiVector areas = MultiVector::Zero(static_cast<Id>(mesh->points.size()), 1);
  for (const auto& corners : mesh->triangles)
  {
    const Vec3& origin = mesh->points[corners[0]];
    const Vec3 normal =
      (mesh->points[corners[1]] - origin).cross(mesh->points[corners[2]] - origin);
    for (const Id corner : corners)
    {
      areas(corner, 0) += normal.norm() / 6.0;
    }
  }
  constexpr Id Source = 1234;
  const double edge = std::sqrt(areas(Source, 0));
  const auto cosineTo = [&](Id i) { return mesh->points[i].dot(mesh->points[Source]); };
  MultiVector start(areas.rows(), 1);
  for (Id i = 0; i < start.rows(); ++i)
  {
    start(i, 0) = std::exp(-FourLn2 * 2.0 * (1.0 - cosineTo(i)) / std::pow(6.0 * edge, 2));
  }
  for (const FunctionKind kind : { FunctionKind::Grid, FunctionKind::Hats })
  {
    const auto timeAfter = [&](double edges)
    {
      const MultiVector u =
        Smoothed(mesh, start, OfWidth(DiffusionAmount::FullWidth, edges * edge, 4), kind);
      double cosine = 0.0;
      for (Id i = 0; i < u.rows(); ++i)
      {
        cosine += areas(i, 0) * u(i, 0) * cosineTo(i);
      }
      return -0.5 * std::log(cosine / areas.cwiseProduct(u).sum());
    };
    const double first = timeAfter(Least);
    for (const double edges : { 4.0, 12.0, 40.0 })
    {
      const double time = (timeAfter(edges) - first) / (edge * edge);
      const double found = std::sqrt(4.0 * FourLn2 * time + Least * Least);
      EXPECT_NEAR(found, edges, 0.01 * edges) << int(kind);
    }
  }
}

/// A frame that changes leaves the hierarchy as it is, and so do other values at held places.
TEST(DiffusionSolver, OtherValuesKeepTheHierarchy)
{
  const auto mesh = std::make_shared<const TriangleMesh>(FlatRectangle(12, 12));
  Stages stages;
  LocalSurface surface(stages, mesh, InWorldUnits(4));
  DiffusionSolver solver;
  DiffusionSolver::Input input;
  const auto hold = [&](const std::vector<Id>& points, std::int64_t version)
  {
    input.constraints.version = StageKey().Add(version);
    input.constraints.find = [&input, points]
    {
      const MultiVector all = input.values.read(NaNs::Refused).values;
      PointValues known{ points, MultiVector(static_cast<Id>(points.size()), all.cols()) };
      for (Id k = 0; k < known.values.rows(); ++k)
      {
        known.values.row(k) = all.row(points[static_cast<std::size_t>(k)]);
      }
      return known;
    };
  };
  for (int frame = 0; frame < 6; ++frame)
  {
    input.values = Series(*mesh, 2, frame);
    if (frame >= 3)
    {
      hold(frame < 5 ? std::vector<Id>{ 0, 30 } : std::vector<Id>{ 30, 31 }, frame);
    }
    const MultiVector here = solver.Update(surface, input, For(0.01, 1), {}).steps.front().atPoints;
    EXPECT_EQ(here,
      DiffusionSolver::Solve(mesh, input, For(0.01, 1), InWorldUnits(4)).steps.front().atPoints);
    EXPECT_EQ(stages.Runs(RightHandSideStage), frame + 1);
    EXPECT_EQ(stages.Runs(HierarchyStage), frame < 3 ? 1 : frame < 5 ? 2 : 3);
  }
  EXPECT_EQ(stages.Runs(SystemStage), 1);
}

TEST(DiffusionSolver, ManyColumnsAreSolvedAsEachAlone)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(8));
  DiffusionSolver::Input all;
  all.values = Series(*mesh, 19, 0);
  all.source = Series(*mesh, 19, 1);
  Stages stages;
  LocalSurface surface(stages, mesh, InWorldUnits(4));
  DiffusionSolver solver;
  solver.Update(surface, all, For(0.125, 1), {});
  const MultiVector four = solver.Update(surface, all, For(0.5, 4), {}).steps.back().atPoints;
  const MultiVector six = solver.Update(surface, all, For(0.75, 6), {}).steps.back().atPoints;
  EXPECT_EQ(stages.Runs(HierarchyStage), 1);
  EXPECT_EQ(
    six, DiffusionSolver::Solve(mesh, all, For(0.75, 6), InWorldUnits(4)).steps.back().atPoints);
  for (const Id column : { 0, 7, 8, 18 })
  {
    const auto alone = [&](const GivenField& field)
    {
      return GivenField::Of(
        "one", { FieldAssociation::Points, field.read(NaNs::Refused).values.col(column) });
    };
    const DiffusionSolver::Input one{ alone(all.values), alone(all.source), {} };
    const MultiVector expected =
      DiffusionSolver::Solve(mesh, one, For(0.5, 4), InWorldUnits(4)).steps.back().atPoints;
    EXPECT_LT((four.col(column) - expected).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-8);
  }
}

TEST(DiffusionSolver, EachOptionChangesTheResultAsInANewSolver)
{
  // The property that counts with each amount.
  const std::string counts[] = { "DiffusionTime", "FWHM", "Sigma" };
  const auto mesh = std::make_shared<const TriangleMesh>(FlatRectangle(12, 12));
  DiffusionSolver::Input input;
  input.values = GivenField::Of("x", { FieldAssociation::Points, PointCoordinates(*mesh).col(0) });
  DiffusionSolver::Options options = For(0.02, 2);
  options.fullWidth = 0.3;
  options.sigma = 0.4;
  Stages stages;
  LocalSurface surface(stages, mesh, InWorldUnits(4));
  DiffusionSolver solver;
  const auto last = [&](const DiffusionSolver::Options& with)
  {
    return solver.Update(surface, input, with, {})
      .steps.at(static_cast<std::size_t>(with.numberOfSteps) - 1)
      .atPoints;
  };
  for (const int amount : { 0, 1, 2 })
  {
    options.amount = static_cast<DiffusionAmount>(amount);
    const MultiVector first = last(options);
    for (const auto& [name, changed] : EachChanged(options))
    {
      const MultiVector here = last(changed);
      const MultiVector fresh =
        DiffusionSolver::Solve(mesh, input, changed, InWorldUnits(4)).steps.back().atPoints;
      EXPECT_EQ(here, fresh) << name;
      const bool isAmount = std::find(counts, counts + 3, name) != counts + 3;
      EXPECT_EQ(here == first, isAmount && name != counts[amount]) << name;
      EXPECT_EQ(last(options), first) << name;
    }
  }
}

/// Every step is kept, so all of them have to fit into memory.
TEST(DiffusionSolver, RefusesStepsThatDoNotFitIntoMemory)
{
  TriangleMesh sphere = GeodesicSphere(4);
  sphere.points.resize(2000000, Vec3::Zero());
  const auto mesh = std::make_shared<const TriangleMesh>(std::move(sphere));
  try
  {
    DiffusionSolver::Solve(mesh, HeightOn(*mesh), For(0.1, 10000), InWorldUnits(3)); // 160 GB
    FAIL();
  }
  catch (const InvalidInput& error)
  {
    EXPECT_NE(std::string(error.what()).find("fewer steps"), std::string::npos) << error.what();
  }
}

TEST(DiffusionSolver, RefusesNoTimeAndAnotherNumberOfComponents)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(8));
  DiffusionSolver::Input input = HeightOn(*mesh);
  EXPECT_THROW(DiffusionSolver::Solve(mesh, input, For(0.0, 1), InWorldUnits(4)), InvalidInput);
  EXPECT_THROW(DiffusionSolver::Solve(mesh, input, For(-1.0, 1), InWorldUnits(4)), InvalidInput);
  for (const auto amount : { DiffusionAmount::FullWidth, DiffusionAmount::Sigma })
  {
    for (const double width : { 0.0, -1.0, std::nan("") })
    {
      EXPECT_THROW(DiffusionSolver::Solve(mesh, input, OfWidth(amount, width, 1), InWorldUnits(4)),
        InvalidInput);
    }
  }
  input.source = GivenField::Of("s", { FieldAssociation::Points, PointCoordinates(*mesh) });
  EXPECT_THROW(DiffusionSolver::Solve(mesh, input, For(0.1, 1), InWorldUnits(4)), InvalidInput);
}

/// Solves by the factor are exact, so that a tight iteration has the same columns.
TEST(DiffusionSolver, ManyColumnsAreThoseOfAFewAtATime)
{
  constexpr Id Columns = 70; // more than one panel of the factor
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(12));
  const MultiVector all = Series(*mesh, Columns, 0).read(NaNs::Refused).values;
  for (const FunctionKind kind : { FunctionKind::Grid, FunctionKind::Hats })
  {
    SurfaceOptions surface = InWorldUnits(4);
    surface.choice.kind = kind;
    const DiffusionSolver::Options options = For(0.05, 3);
    const auto smoothed = [&](const MultiVector& values, int threads)
    {
      DiffusionSolver::Input input;
      input.values = GivenField::Of("f", { FieldAssociation::Points, values });
      surface.space.threads = threads;
      const auto result = DiffusionSolver::Solve(mesh, input, options, surface);
      EXPECT_TRUE(result.steps.back().report.converged);
      EXPECT_EQ(result.steps.size(), 3u);
      return result.steps.back().atPoints;
    };
    const MultiVector many = smoothed(all, 1);
    EXPECT_TRUE(smoothed(all, 3) == many); // the same bits
    for (const Id first : { Id{ 0 }, Id{ 60 } })
    {
      const MultiVector few = smoothed(all.middleCols(first, 5), 1);
      const double apart =
        (few - many.middleCols(first, 5)).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
      EXPECT_LT(apart, 1e-8);
    }
  }
}

TEST(DiffusionSolver, ManyColumnsGoOnFromTheLastStep)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(8));
  DiffusionSolver::Input input;
  input.values = Series(*mesh, 130, 0);
  const DiffusionSolver::Result atOnce =
    DiffusionSolver::Solve(mesh, input, For(0.04, 4), InWorldUnits(4));
  Stages stages;
  LocalSurface surface(stages, mesh, InWorldUnits(4));
  DiffusionSolver solver;
  solver.Update(surface, input, For(0.02, 2), {});
  const DiffusionSolver::Result& result = solver.Update(surface, input, For(0.04, 4), {});
  ASSERT_EQ(result.steps.size(), 4u);
  EXPECT_TRUE(result.steps.back().atPoints == atOnce.steps.back().atPoints);
  EXPECT_EQ(stages.Runs("Solve"), 4);
}

TEST(DiffusionSolver, HeldValuesOfManyColumnsStay)
{
  const auto mesh = std::make_shared<const TriangleMesh>(GeodesicSphere(8));
  DiffusionSolver::Input input;
  input.values = Series(*mesh, 70, 0);
  const MultiVector values = input.values.read(NaNs::Refused).values;
  input.constraints.property = "Mask";
  input.constraints.find = [&] { return PointValues{ { 5 }, values.row(5) }; };
  const DiffusionSolver::Result result =
    DiffusionSolver::Solve(mesh, input, For(0.05, 1), InWorldUnits(4));
  const double apart = (result.steps.back().atPoints.row(5) - values.row(5))
                         .cwiseAbs()
                         .maxCoeff<Eigen::PropagateNaN>();
  EXPECT_LT(apart, 1e-6);
}
