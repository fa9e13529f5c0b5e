// The nearly invisible functions and their part in the cycle.
#include "Base/Errors.h"
#include "Discretisation.h"
#include "Meshes.h"
#include "PrecisionChecks.h"
#include "SampledHierarchy.h"
#include "Spaces.h"
#include "Spaces/HiddenFunctions.h"
#include "Spaces/LayeredFunctions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace gridfem
{
namespace
{

using testing::Dense;
using testing::RandomVectors;
using testing::RelativeDifference;

struct Problem : testing::Discretisation
{
  Problem(const TriangleMesh& mesh, int depth, Index coarsestSize = 64)
    : Discretisation(testing::Discretise(mesh, depth, 2, true, coarsestSize))
  {
  }

  std::vector<double> Heights(int threads = 0) const
  {
    return CornerHeights(space.Finest(), system.places.front(), system.elements.front(), threads);
  }

  Multigrid Cycle(
    double a, double b, HiddenCorrection hidden = HiddenCorrection::Always, int threads = 0) const
  {
    MultigridOptions options;
    options.hidden = hidden;
    options.threads = threads;
    return BuildMultigrid(space, system, a, b, options);
  }
};

/// Largest difference of the heights from a distance, in cells, after the better of both signs.
double LargestError(const Problem& problem, const std::function<double(const Vec3&)>& distance)
{
  const std::vector<double> height = problem.Heights();
  const MultiVector corner = testing::CoordinateCoefficients(problem.space);
  double error[2] = { 0.0, 0.0 };
  for (std::size_t f = 0; f < height.size(); ++f)
  {
    const double exact =
      distance(Vec3(corner.row(static_cast<Id>(f)).transpose())) / problem.space.GetGrid().spacing;
    error[0] = std::max(error[0], std::abs(height[f] - exact));
    error[1] = std::max(error[1], std::abs(height[f] + exact));
  }
  return std::min(error[0], error[1]);
}

TEST(CornerHeights, AreDistancesFromAPlane)
{
  const double angle = 0.4;
  const TriangleMesh plane = testing::Transform(testing::FlatRectangle(6, 5), { 1, 0.3, 0 }, angle);
  const Vec3 normal = Eigen::AngleAxisd(angle, Vec3(1, 0.3, 0).normalized()) * Vec3(0, 0, 1);
  // Areas of slivers of 1e-10 cells are known to 1e-6, and normals are as good as areas.
  EXPECT_LT(LargestError(Problem(plane, 5), [&](const Vec3& x) { return normal.dot(x); }), 1e-5);
}

TEST(CornerHeights, AreDistancesFromASphereUpToItsCurvature)
{
  for (const int depth : { 4, 5 })
  {
    const Problem sphere(testing::GeodesicSphere(60), depth);
    // A corner lies within sqrt(3) cells of the pieces in its support, whose planes are off by half
    // the curvature times that squared.
    EXPECT_LT(LargestError(sphere, [](const Vec3& x) { return x.norm() - 1.0; }),
      0.5 * 3.0 * 2.0 * std::pow(0.5, depth));
  }
}

TEST(CornerHeights, MakeFunctionsThatAreNotSeenOnFlatFaces)
{
  const Problem plane(testing::Transform(testing::FlatRectangle(6, 5), { 1, 0.3, 0 }, 0.4), 5);
  const std::vector<double> height = plane.Heights();
  const MultiVector h = Eigen::Map<const Eigen::VectorXd>(height.data(), height.size());
  MultiVector energy;
  Multiply(plane.Cycle(1.0, 1.0).Matrix(), h, energy);
  // The normal's weight in the stiffness, 1e-12, times the area.
  EXPECT_LT(h.cwiseProduct(energy).sum(), 1e-11 * h.squaredNorm());
}

TEST(HiddenLevels, AreGalerkinProducts)
{
  const Problem problem(testing::Transform(testing::Box(2), { 1, 2, 3 }, 0.7), 4);
  const HiddenLevels hidden = BuildHiddenLevels(problem.space, problem.system);
  const Eigen::MatrixXd A = Dense(LevelMatrix(problem.space, problem.system, 0, 1.0, 1.0));
  Eigen::MatrixXd V =
    Eigen::Map<const Eigen::VectorXd>(hidden.height.data(), A.rows()).asDiagonal();
  ASSERT_EQ(hidden.levels.size(), problem.system.prolongation.size());
  for (std::size_t l = 0; l < hidden.levels.size(); ++l)
  {
    V = V * Dense(problem.system.prolongation[l]);
    EXPECT_LT(RelativeDifference(Dense(hidden.levels[l].A), V.transpose() * A * V), 1e-12);
  }
}

struct Weights
{
  double a;
  double b;
};

class HiddenCycle : public ::testing::TestWithParam<Weights>
{
};

// A third correction in a space of functions, never too large: the cycle stays symmetric and
// reduces the energy of every error. On grid planes hidden functions are as small as rounding.
TEST_P(HiddenCycle, IsSymmetricAndConverges)
{
  const auto [a, b] = GetParam();
  for (const TriangleMesh& mesh :
    { testing::Transform(testing::Box(2), { 1, 1, 1 }, 0.02), testing::GeodesicSphere(12),
      testing::Join(testing::FlatRectangle(4, 4),
        testing::Transform(testing::FlatRectangle(4, 4), { 0, 0, 1 }, 0.0, 1.0, { 0, 0, 0.9 })) })
  {
    const Multigrid cycle = Problem(mesh, 4).Cycle(a, b);
    const SparseMatrix& A = cycle.Matrix();
    MultiVector Ae;
    MultiVector Af;
    MultiVector Be;
    MultiVector Bf;
    MultiVector e = RandomVectors(A.rows, 1, 1);
    Multiply(A, e, Ae);
    Multiply(A, RandomVectors(A.rows, 1, 2), Af);
    cycle.Precondition(Ae, Be);
    cycle.Precondition(Af, Bf);
    const double energy = e.cwiseProduct(Ae).sum();
    EXPECT_NEAR(Bf.cwiseProduct(Ae).sum(), Be.cwiseProduct(Af).sum(), 1e-8 * energy);
    const MultiVector zero = MultiVector::Zero(A.rows, 1);
    double before = energy;
    for (int k = 0; k < 5; ++k)
    {
      cycle.Cycle(zero, e);
      Multiply(A, e, Ae);
      const double after = e.cwiseProduct(Ae).sum();
      EXPECT_LT(after, before);
      before = after;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Weights, HiddenCycle,
  ::testing::Values(
    Weights{ 0.0, 1.0 }, Weights{ 1e-5, 1.0 }, Weights{ 0.2, 1.0 }, Weights{ 1.0, 1e-3 }));

TEST(HiddenCycle, ThreadsDoNotChangeABit)
{
  const Problem problem(testing::Transform(testing::Box(2), { 1, 1, 1 }, 0.3), 5);
  EXPECT_EQ(problem.Heights(1), problem.Heights(2));
  const Multigrid one = problem.Cycle(0.01, 1.0, HiddenCorrection::Always, 1);
  const Multigrid two = problem.Cycle(0.01, 1.0, HiddenCorrection::Always, 2);
  const MultiVector b = RandomVectors(one.Matrix().rows, 3);
  MultiVector x1;
  MultiVector x2;
  one.Precondition(b, x1);
  two.Precondition(b, x2);
  EXPECT_EQ(x1, x2);
}

/// Energy of a random error after eight cycles, relative to its start.
double EnergyLeft(const Multigrid& cycle)
{
  const SparseMatrix& A = cycle.Matrix();
  MultiVector x = RandomVectors(A.rows, 1);
  const MultiVector zero = MultiVector::Zero(A.rows, 1);
  MultiVector Ax;
  Multiply(A, x, Ax);
  const double start = x.cwiseProduct(Ax).sum();
  for (int k = 0; k < 8; ++k)
  {
    cycle.Cycle(zero, x);
  }
  Multiply(A, x, Ax);
  return x.cwiseProduct(Ax).sum() / start;
}

// What it is for: without it the energy of hidden functions falls by less than a tenth per cycle.
TEST(HiddenCycle, ConvergesFastOnFlatFaces)
{
  for (const double degrees : { 0.01, 1.0, 30.0 })
  {
    const Problem problem(
      testing::Transform(testing::Box(1), { 1, 1, 1 }, degrees * std::acos(-1.0) / 180.0), 5);
    EXPECT_LT(EnergyLeft(problem.Cycle(1e-5, 1.0)),
      1e-2 * EnergyLeft(problem.Cycle(1e-5, 1.0, HiddenCorrection::Never)));
  }
}

TEST(HiddenCycle, HasACopyInDoublePrecision)
{
  const Problem problem(testing::Transform(testing::Box(3), { 1, 2, 3 }, 0.7), 5);
  MultigridOptions options;
  options.hidden = HiddenCorrection::Always;
  options.precision = FactorPrecision::Double;
  testing::ExpectCopyInDoublePrecision(
    problem.Cycle(0.1, 1.0), BuildMultigrid(problem.space, problem.system, 0.1, 1.0, options));
}

TEST(HiddenCycle, IsTakenWhereTheSurfaceIsFlat)
{
  const auto hasHidden = [](const TriangleMesh& mesh)
  { return Problem(mesh, 5).Cycle(1.0, 1.0, HiddenCorrection::WhereFlat).RevisionOfHidden() >= 0; };
  EXPECT_TRUE(hasHidden(testing::Transform(testing::Box(3), { 1, 2, 3 }, 0.7)));
  EXPECT_FALSE(hasHidden(testing::GeodesicSphere(40)));
  EXPECT_FALSE(hasHidden(testing::Torus(90, 40, 1.0, 0.4)));
}

TEST(HiddenLevels, BrokenInputIsRefused)
{
  const Problem problem(testing::GeodesicSphere(6), 4);
  const auto add = [&](auto&& damage, double size)
  {
    Multigrid cycle = problem.Cycle(1.0, 1.0, HiddenCorrection::Never);
    HiddenLevels hidden = BuildHiddenLevels(problem.space, problem.system);
    AddLayeredFunctions(problem.space, problem.system, hidden);
    damage(hidden);
    cycle.AddHidden(std::move(hidden), size);
  };
  EXPECT_NO_THROW(add([](HiddenLevels&) {}, 1.0));
  EXPECT_THROW(add([](HiddenLevels&) {}, 0.0), InvalidInput);
  EXPECT_THROW(add([](HiddenLevels& hidden) { hidden.height.pop_back(); }, 1.0), InvalidInput);
  EXPECT_THROW(add([](HiddenLevels& hidden) { hidden.levels.pop_back(); }, 1.0), InvalidInput);
  EXPECT_THROW(
    add([](HiddenLevels& hidden) { --hidden.layeredProlongation.rows; }, 1.0), InvalidInput);
}

} // namespace
} // namespace gridfem
