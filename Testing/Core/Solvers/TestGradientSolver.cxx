// Derivatives of fields on a surface, and the parts of vectors: exact values, and the stages that a
// change repeats.
#include "Solvers/GradientSolver.h"

#include "AtDepth.h"
#include "Base/Errors.h"
#include "Base/VectorRows.h"
#include "Meshes.h"
#include "Solvers/LocalSurface.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

using Derived = GradientSolver::Derived;

std::shared_ptr<const TriangleMesh> Sphere()
{
  return std::make_shared<const TriangleMesh>(GeodesicSphere(12));
}

const SurfaceOptions AtDepth4 = AtDepth<GradientSolver>(4);

GivenField VectorsAt(const TriangleMesh& mesh, const std::function<Vec3(const Vec3&)>& vector)
{
  Field field{ FieldAssociation::Points, MultiVector(static_cast<Id>(mesh.points.size()), 3) };
  for (Id point = 0; point < field.values.rows(); ++point)
  {
    SetRow(field.values, point, vector(mesh.points[point]));
  }
  return GivenField::Of("v", std::move(field));
}

/// ∇z on the unit sphere.
Vec3 Upwards(const Vec3& p)
{
  return Vec3::UnitZ() - p[2] * p;
}

const Derived& Find(const std::vector<Derived>& fields, std::string_view name)
{
  for (const Derived& field : fields)
  {
    if (field.name == name)
    {
      return field;
    }
  }
  throw std::runtime_error("no " + std::string(name));
}

} // namespace

TEST(GradientSolver, OfALinearFieldIsItsSlope)
{
  const Vec3 slope = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()) * Vec3(3, -2, 0);
  const auto sheet =
    std::make_shared<const TriangleMesh>(Transform(FlatRectangle(10, 10), { 1, 2, 3 }, 0.7));
  Field field{ FieldAssociation::Points, MultiVector(static_cast<Id>(sheet->points.size()), 1) };
  for (Id point = 0; point < field.values.rows(); ++point)
  {
    field.values(point, 0) = slope.dot(sheet->points[point]) + 7.0;
  }
  GradientSolver::Options options;
  options.equation.solve.tolerance = 1e-8;
  options.equation.accuracy = 0.0;
  const auto result =
    GradientSolver::Solve(sheet, { GivenField::Of("f", field) }, options, AtDepth4);
  ASSERT_EQ(result.derivatives.size(), 2u);
  const Derived& gradient = Find(result.derivatives, "Gradient");
  for (const MultiVector& rows : { gradient.atPoints, gradient.onTriangles })
  {
    EXPECT_LT(
      (rows.rowwise() - slope.transpose()).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-4);
  }
  EXPECT_LT(
    Find(result.derivatives, "Laplacian").atPoints.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
    1e-2);
}

/// A large constant has no gradient. What is left of the values differs by rounding, 1.2e-7.
TEST(GradientSolver, DoesNotSeeALargeConstant)
{
  const auto sphere = Sphere();
  Field field{ FieldAssociation::Points, MultiVector(static_cast<Id>(sphere->points.size()), 1) };
  for (Id point = 0; point < field.values.rows(); ++point)
  {
    field.values(point, 0) = sphere->points[point][2];
  }
  const auto derivativesOf = [&](double constant)
  {
    Field raised = field;
    raised.values.array() += constant;
    return GradientSolver::Solve(sphere, { GivenField::Of("f", raised) }, {}, AtDepth4).derivatives;
  };
  const std::vector<Derived> plain = derivativesOf(0.0);
  const std::vector<Derived> raised = derivativesOf(1e9);
  for (const char* name : { "Gradient", "Laplacian" })
  {
    const MultiVector difference = Find(raised, name).atPoints - Find(plain, name).atPoints;
    EXPECT_LT(difference.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-4) << name;
  }
}

TEST(GradientSolver, TakesASlopeForAGradientWithoutRotation)
{
  GradientSolver::Options options;
  options.hodgeDecomposition = true;
  const auto sphere = Sphere();
  const auto result =
    GradientSolver::Solve(sphere, { VectorsAt(*sphere, &Upwards) }, options, AtDepth4);
  for (std::size_t point = 0; point < sphere->points.size(); ++point)
  {
    const auto row = static_cast<Id>(point);
    const Vec3 found = RowOf(Find(result.parts, "GradientPart").atPoints, row);
    ASSERT_NEAR((found - Upwards(sphere->points[point])).norm(), 0.0, 0.1);
    ASSERT_NEAR(RowOf(Find(result.parts, "RotationPart").atPoints, row).norm(), 0.0, 0.1);
    ASSERT_NEAR(Find(result.parts, "Potential").atPoints(row, 0), sphere->points[point][2], 0.05);
  }
}

TEST(GradientSolver, RunsOnlyTheStageThatAChangeAsksFor)
{
  const auto sphere = Sphere();
  Stages stages;
  LocalSurface surface(stages, sphere, AtDepth4);
  GradientSolver solver;
  GradientSolver::Input input{ VectorsAt(*sphere, &Upwards) };
  GradientSolver::Options options;
  solver.Update(surface, input, options, {});
  for (const bool on : { true, false, true })
  {
    options.hodgeDecomposition = on;
    EXPECT_EQ(solver.Update(surface, input, options, {}).parts.size(), on ? 5u : 0u);
  }
  EXPECT_EQ(stages.Runs(SolveStage), 1);
  EXPECT_EQ(stages.Runs(HodgeStage), 1);
  input.values.version.Add(1);
  const auto& result = solver.Update(surface, input, options, {});
  EXPECT_EQ(stages.Runs(SolveStage), 2);
  EXPECT_EQ(stages.Runs(HodgeStage), 2);
  EXPECT_EQ(stages.Runs(SystemStage), 1);

  const auto oneShot = GradientSolver::Solve(sphere, input, options, AtDepth4);
  ASSERT_EQ(result.derivatives.size(), oneShot.derivatives.size());
  for (std::size_t k = 0; k < result.derivatives.size(); ++k)
  {
    EXPECT_EQ(result.derivatives[k].atPoints, oneShot.derivatives[k].atPoints);
    EXPECT_EQ(result.derivatives[k].onTriangles, oneShot.derivatives[k].onTriangles);
  }
}

TEST(GradientSolver, RefusesToTakeCoordinatesApart)
{
  GradientSolver::Options options;
  options.hodgeDecomposition = true;
  EXPECT_THROW(GradientSolver::Solve(Sphere(), {}, options, AtDepth4), InvalidInput);
}
