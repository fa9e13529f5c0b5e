// Patches relaxed on stencils of the grid in single precision, compared with double precision.
#include "Discretization.h"
#include "Equations/Poisson.h"
#include "Meshes.h"
#include "Multigrid/StencilBlocks.h"
#include "SampledHierarchy.h"
#include "Spaces/PatchOrdering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gridfem
{
namespace
{

using testing::RandomValues;
using testing::RelativeDifference;

/// The levels of a mesh, with smoothers.
Multigrid Hierarchy(
  const TriangleMesh& mesh, int depth, FactorPrecision precision, double lambda = 1e-3)
{
  SpaceOptions space;
  space.depth = depth;
  const GridFunctions functions = BuildGridFunctions(mesh, space);
  const LevelOperators operators = BuildLevelOperators(functions, TriangleRule(2));
  MultigridOptions options;
  options.precision = precision;
  return BuildMultigrid(testing::ViewOf(functions, operators), lambda, 1.0, options);
}

/// A curved mesh; one with sheets closer than a cell, so that functions of one corner differ; and
/// meshes with flat faces that are not parallel to a grid plane.
std::vector<TriangleMesh> Meshes()
{
  const TriangleMesh sphere = testing::GeodesicSphere(4);
  return { sphere, testing::Join(sphere, testing::Transform(sphere, { 1, 2, 3 }, 0.3, 0.98)),
    testing::Transform(testing::Box(8), { 1, 1, 1 }, 0.4),
    testing::Unweld(testing::Pulley(24, 0.1)) };
}

/// A right-hand side that comes from a function: hidden directions have little of it.
MultiVector LoadOf(const SparseMatrix& A, Id columns)
{
  MultiVector b;
  Multiply(A, RandomValues(A.rows, columns, 5), b);
  return b;
}

/// The energy of the error after a sweep.
double EnergyAfter(const MultigridLevel& level, const Smoother& smoother, const MultiVector& exact,
  SweepDirection direction)
{
  MultiVector b;
  Multiply(level.A, exact, b);
  MultiVector x = MultiVector::Zero(b.rows(), b.cols());
  smoother.Sweep(level.A, b, x, direction, 1);
  MultiVector image;
  Multiply(level.A, x - exact, image);
  return (x - exact).cwiseProduct(image).sum();
}

TEST(StencilSmoother, SweepsAsInDoublePrecision)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const Multigrid built = Hierarchy(mesh, 5, FactorPrecision::Double);
    for (std::size_t l = 0; l + 1 < built.Levels().size(); ++l)
    {
      const MultigridLevel& level = built.Levels()[l];
      const auto smoother = MakeStencilSmoother(level.A, level.order);
      ASSERT_TRUE(smoother || l > 0);
      if (!smoother)
      {
        break; // too many functions share the corners of a coarse level
      }
      EXPECT_TRUE(smoother->IsSingle() && smoother->HasSingleFactors());
      for (const auto direction : { SweepDirection::Forward, SweepDirection::Backward })
      {
        const MultiVector exact = RandomValues(level.A.rows, 1, 4);
        const double inDouble = EnergyAfter(level, *level.smoother, exact, direction);
        const double inSingle = EnergyAfter(level, *smoother, exact, direction);
        // In the worst case, single precision leaves 1e-7 / sqrt(1e-6) of a direction. Patches that
        // are relaxed twice end with less energy.
        EXPECT_LE(inSingle, 1.001 * inDouble) << "level " << l;
        if (StencilBlocks(level.A, level.order, 1).Unresolved().empty())
        {
          EXPECT_GE(inSingle, 0.999 * inDouble) << "level " << l;
        }
      }
    }
  }
}

TEST(StencilSmoother, TakesAnyNumberOfColumnsAndThreads)
{
  const Multigrid built = Hierarchy(Meshes()[1], 5, FactorPrecision::Double);
  const MultigridLevel& level = built.Levels().front();
  const auto smoother = MakeStencilSmoother(level.A, level.order);
  ASSERT_TRUE(smoother);
  const MultiVector b = LoadOf(level.A, 9);
  MultiVector all = MultiVector::Zero(b.rows(), b.cols());
  smoother->Sweep(level.A, b, all, SweepDirection::Forward, 1);
  for (const Id columns : { 1, 2, 3, 4, 5, 9 })
  {
    MultiVector x = MultiVector::Zero(b.rows(), columns);
    smoother->Sweep(level.A, b.leftCols(columns), x, SweepDirection::Forward, 1);
    // A single column is added up in another order.
    EXPECT_LT(RelativeDifference(x, all.leftCols(columns)), 1e-4) << columns;
    MultiVector again = MultiVector::Zero(b.rows(), columns);
    smoother->Sweep(level.A, b.leftCols(columns), again, SweepDirection::Forward, 3);
    EXPECT_EQ(x, again) << columns;
  }
}

TEST(StencilSmoother, BackwardIsTheAdjointOfForward)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const Multigrid built = Hierarchy(mesh, 5, FactorPrecision::Double);
    const MultigridLevel& level = built.Levels().front();
    const auto smoother = MakeStencilSmoother(level.A, level.order);
    ASSERT_TRUE(smoother);
    const MultiVector a = LoadOf(level.A, 1);
    MultiVector b;
    Multiply(level.A, RandomValues(level.A.rows, 1, 8), b);
    MultiVector forward = MultiVector::Zero(a.rows(), 1);
    MultiVector backward = forward;
    smoother->Sweep(level.A, a, forward, SweepDirection::Forward, 1);
    smoother->Sweep(level.A, b, backward, SweepDirection::Backward, 1);
    const double scale = std::sqrt(a.cwiseProduct(forward).sum() * b.cwiseProduct(backward).sum());
    EXPECT_NEAR(b.cwiseProduct(forward).sum(), a.cwiseProduct(backward).sum(), 1e-4 * scale);
  }
}

TEST(StencilSmoother, IterationsAreThoseOfDoublePrecision)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    const Multigrid mixed = Hierarchy(mesh, 5, FactorPrecision::Mixed);
    ASSERT_TRUE(mixed.Levels().front().smoother->IsSingle());
    const Multigrid inDouble = Hierarchy(mesh, 5, FactorPrecision::Double);
    const MultiVector b = LoadOf(mixed.Matrix(), 2);
    SolveOptions options;
    options.tolerance = 1e-10;
    const auto iterations = [&](const Multigrid& multigrid)
    {
      MultiVector x = MultiVector::Zero(b.rows(), b.cols());
      const SolveReport report =
        SolveConjugateGradients(OperatorOf(multigrid), CycleOf(multigrid), b, x, options);
      EXPECT_TRUE(report.converged);
      return report.iterations;
    };
    EXPECT_LE(iterations(mixed), iterations(inDouble) + 1);
  }
}

TEST(StencilSmoother, TheSizeOfNumbersDoesNotMatter)
{
  const Multigrid multigrid = Hierarchy(Meshes()[0], 4, FactorPrecision::Mixed);
  const MultiVector b = LoadOf(multigrid.Matrix(), 2);
  MultiVector x;
  multigrid.Precondition(b, x);
  for (const double unit : { std::ldexp(1.0, -600), std::ldexp(1.0, 600) })
  {
    MultiVector scaled = b;
    scaled.col(0) *= unit;
    MultiVector y;
    multigrid.Precondition(scaled, y);
    EXPECT_EQ(y.col(0), unit * x.col(0));
    EXPECT_EQ(y.col(1), x.col(1));
  }
}

TEST(StencilSmoother, CyclesFromAnyStartReachDoublePrecision)
{
  const Multigrid multigrid = Hierarchy(Meshes()[2], 4, FactorPrecision::Mixed);
  ASSERT_TRUE(multigrid.Levels().front().smoother->IsSingle());
  const MultiVector b = LoadOf(multigrid.Matrix(), 1);
  MultiVector x = RandomValues(b.rows(), 1, 3);
  for (int cycle = 0; cycle < 60; ++cycle)
  {
    multigrid.Cycle(b, x);
  }
  MultiVector r;
  Residual(multigrid.Matrix(), x, b, r);
  EXPECT_LT(r.norm(), 1e-10 * b.norm());
}

/// A rank relaxes only some patches, and the others together with its neighbors.
TEST(StencilSmoother, RelaxesSomeOfThePatches)
{
  for (const TriangleMesh& mesh : Meshes())
  {
    SpaceOptions options;
    options.depth = 5;
    const GridFunctions functions = BuildGridFunctions(mesh, options);
    const PatchLevel& all = functions.Finest();
    PatchLevel some;
    some.depth = all.depth;
    some.numberOfFunctions = all.numberOfFunctions;
    const auto half = static_cast<std::ptrdiff_t>(all.cell.size() / 2);
    some.cell.assign(all.cell.begin(), all.cell.begin() + half);
    some.dof.assign(all.dof.begin(), all.dof.begin() + half);
    MultigridLevel level;
    const LevelOperators operators = BuildLevelOperators(functions, TriangleRule(2));
    level.A = testing::ViewOf(functions, operators).Matrix(0, 1e-3, 1.0);
    level.order = OrderPatches(some, all);
    const auto inSingle = MakeStencilSmoother(level.A, level.order);
    ASSERT_TRUE(inSingle);
    const auto inDouble = MakePatchSmoother(level.A, level.order, 1, FactorPrecision::Double);
    const MultiVector exact = RandomValues(level.A.rows, 1, 4);
    const double single = EnergyAfter(level, *inSingle, exact, SweepDirection::Forward);
    EXPECT_LE(single, 1.001 * EnergyAfter(level, *inDouble, exact, SweepDirection::Forward));
  }
}

TEST(StencilSmoother, RefilledIsAsNew)
{
  const TriangleMesh mesh = Meshes()[1];
  const Multigrid first = Hierarchy(mesh, 5, FactorPrecision::Double, 1e-3);
  const Multigrid other = Hierarchy(mesh, 5, FactorPrecision::Double, 1.0);
  for (std::size_t l = 0; l + 1 < first.Levels().size(); ++l)
  {
    const MultigridLevel& level = other.Levels()[l];
    const auto refilled = MakeStencilSmoother(first.Levels()[l].A, level.order);
    ASSERT_TRUE(refilled && refilled->Refill(level.A, level.order, 2));
    const auto made = MakeStencilSmoother(level.A, level.order);
    const MultiVector b = LoadOf(level.A, 3);
    MultiVector x = MultiVector::Zero(b.rows(), b.cols());
    MultiVector y = x;
    refilled->Sweep(level.A, b, x, SweepDirection::Forward, 1);
    made->Sweep(level.A, b, y, SweepDirection::Forward, 1);
    EXPECT_EQ(x, y);
  }
}

TEST(StencilSmoother, IsNotMadeWhereItDoesNotServe)
{
  const auto tilted =
    testing::SampledHierarchy(testing::TiltedPlane(5, 10.3, 1e-4), 5, 4, 1e-3, 1.0);
  bool patternFits = false;
  EXPECT_FALSE(MakeStencilSmoother(tilted[0].A, tilted[0].order, 1, &patternFits));
  EXPECT_TRUE(patternFits) << "almost parallel to the grid: other values may serve";
  const auto steep =
    testing::SampledHierarchy(testing::TiltedPlane(5, 10.3, 1e-2), 5, 4, 1e-3, 1.0);
  EXPECT_TRUE(MakeStencilSmoother(steep[0].A, steep[0].order));

  const Multigrid sphere = Hierarchy(Meshes()[0], 4, FactorPrecision::Double);
  const MultigridLevel& level = sphere.Levels().front();
  PatchOrder order = level.order;
  order.corner.clear();
  EXPECT_FALSE(MakeStencilSmoother(level.A, order, 1, &patternFits)) << "no corners";
  EXPECT_FALSE(patternFits);
  order = level.order;
  std::swap(order.dof.unknown[0], order.dof.unknown[1]);
  EXPECT_FALSE(MakeStencilSmoother(level.A, order, 1, &patternFits)) << "not corners of a cell";
  EXPECT_FALSE(patternFits);
}

/// A mesh that touches a cell only with the tip of a triangle has an almost empty function.
TEST(StencilSmoother, FunctionsOfAnySizeCount)
{
  const Multigrid built = Hierarchy(Meshes()[1], 5, FactorPrecision::Double);
  const MultigridLevel& level = built.Levels().front();
  for (const double size : { 1e-60, 1e-18, 1e18 })
  {
    std::vector<double> sizeOf(level.A.rows, 1.0);
    for (std::size_t k = 7; k < sizeOf.size(); k += 101)
    {
      sizeOf[k] = size;
    }
    SparseMatrix A = level.A;
    MultiVector exact = RandomValues(A.rows, 3, 4);
    for (Index row = 0; row < A.rows; ++row)
    {
      exact.row(row) /= sizeOf[row]; // as much energy as the others
      for (Id k = A.rowBegin[row]; k < A.rowBegin[row + 1]; ++k)
      {
        A.value[k] *= sizeOf[row] * sizeOf[A.column[k]];
      }
    }
    const auto smoother = MakeStencilSmoother(A, level.order);
    const auto asBefore = MakeStencilSmoother(level.A, level.order);
    ASSERT_TRUE(smoother);
    for (const auto direction : { SweepDirection::Forward, SweepDirection::Backward })
    {
      MultiVector b;
      Multiply(A, exact, b);
      MultiVector x = MultiVector::Zero(b.rows(), b.cols());
      smoother->Sweep(A, b, x, direction, 2);
      MultiVector y = MultiVector::Zero(b.rows(), b.cols());
      for (Index row = 0; row < A.rows; ++row)
      {
        b.row(row) /= sizeOf[row];
        x.row(row) *= sizeOf[row];
      }
      asBefore->Sweep(level.A, b, y, direction, 2);
      EXPECT_LT(RelativeDifference(x, y), 1e-3) << size;
    }
    const auto refilled = MakeStencilSmoother(level.A, level.order);
    ASSERT_TRUE(refilled->Refill(A, level.order, 1));
    const MultiVector b = LoadOf(A, 1);
    MultiVector x = MultiVector::Zero(b.rows(), 1);
    MultiVector y = x;
    refilled->Sweep(A, b, x, SweepDirection::Forward, 1);
    smoother->Sweep(A, b, y, SweepDirection::Forward, 1);
    EXPECT_EQ(x, y);
  }
}

/// Sheets through the same cells have functions at the same corners.
TEST(StencilBlocks, KeepEveryEntryOfARow)
{
  const Multigrid built = Hierarchy(Meshes()[1], 4, FactorPrecision::Double);
  const MultigridLevel& level = built.Levels().front();
  const StencilBlocks blocks(level.A, level.order, 2);
  ASSERT_FALSE(blocks.IsEmpty());
  Id extras = 0;
  for (Id b = 0; b + 1 < static_cast<Id>(level.order.blockBegin.size()); ++b)
  {
    const StencilBlocks::Block& block = blocks.BlockAt(b);
    for (Id p = level.order.blockBegin[b]; p < level.order.blockBegin[b + 1]; ++p)
    {
      const StencilBlocks::Patch& patch = blocks.PatchAt(p);
      extras += patch.extras;
      for (int c = 0; c < StencilBlocks::N; ++c)
      {
        const Index row = level.order.dof[p][c];
        ASSERT_EQ(blocks.Unknowns(block)[patch.slot[StencilBlocks::OwnSlot(c)]], row);
        Eigen::VectorXd found = Eigen::VectorXd::Zero(level.A.rows);
        for (int place = 0; place < StencilRow::Size; ++place)
        {
          const int slot =
            (c & 1) + place % 4 + 4 * ((c >> 1 & 1) + place / 4 % 3) + 16 * ((c >> 2) + place / 12);
          const float value = blocks.Rows(block)[patch.row[c]].value[place];
          if (value != 0.0f)
          {
            found[blocks.Unknowns(block)[patch.slot[slot]]] += value;
          }
        }
        for (Index k = 0; k < patch.extras; ++k)
        {
          const StencilBlocks::Extra& extra = blocks.Extras(patch)[k];
          if (extra.corner == c)
          {
            found[blocks.Unknowns(block)[extra.column]] += extra.value;
          }
        }
        for (Index column = 0; column < level.A.rows; ++column)
        {
          ASSERT_EQ(found[column], static_cast<float>(level.A.Coefficient(row, column)));
        }
      }
    }
  }
  EXPECT_GT(extras, 0) << "the case that is tested does not occur";
}

} // namespace
} // namespace gridfem
