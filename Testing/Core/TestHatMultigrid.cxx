// The hybrid hierarchy: transfer, order of relaxation, solutions against a direct solver, numbers
// of iterations.
#include "HatMultigrid.h"

#include "Evaluation.h"
#include "HatLoad.h"
#include "HatOrdering.h"
#include "Poisson.h"
#include "Spaces.h"
#include "Support/HatSystem.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <set>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// A mesh with its grid and its hats.
struct Hybrid
{
  Hybrid(const TriangleMesh& inputMesh, int depth, HatTransfer transfer = HatTransfer::Evaluation,
    int threads = 0)
    : mesh(inputMesh)
  {
    SpaceOptions spaceOptions;
    spaceOptions.depth = depth;
    spaceOptions.threads = threads;
    space = BuildFunctionSpace(mesh, spaceOptions);
    system = BuildSystem(space, TriangleRule(2), threads, 64);
    hats = BuildHatHierarchy(mesh, space, true, transfer, threads);
    options.grid.threads = threads;
    solve.tolerance = 1e-8;
    solve.measure = SolveOptions::Measure::Residual;
  }

  /// λ in world units to grid units.
  double Weight(double lambda) const { return lambda * std::pow(space.GetGrid().spacing, 2); }

  Multigrid Build(double weight) const
  {
    return BuildHatMultigrid(hats, space, system, weight, 1.0, options);
  }

  ComponentFunctions Functions() const { return FunctionsOf(hats); }

  /// Solves (λM + L) u = λ f, f at points.
  PoissonSolution Solve(double lambda, const MultiVector& f) const
  {
    PoissonOptions poisson;
    poisson.screeningWeight = this->Weight(lambda);
    poisson.solve = solve;
    const MultiVector load = IntegrateValues(hats.functions, mesh, { FieldAssociation::Points, f });
    return SolvePoisson(this->Functions(), this->Build(poisson.screeningWeight), load, {}, poisson);
  }

  TriangleMesh mesh;
  FunctionSpace space;
  System system;
  HatHierarchy hats;
  HatMultigridOptions options;
  SolveOptions solve;
};

/// Ten sweeps of Gauss-Seidel on every level, W cycles: the solver of the thesis.
void UseThesisSweeps(HatMultigridOptions& options)
{
  options.grid.smoother = SmootherType::GaussSeidel;
  options.grid.preSweeps = options.grid.postSweeps = 10;
  options.hats.preSweeps = options.hats.postSweeps = 10;
  options.hats.cycle = CycleType::W;
  options.relaxGroups = false;
}

/// A smooth function with fine detail.
MultiVector Waves(const TriangleMesh& mesh)
{
  const Grid grid = EmbedInGrid(mesh.points, UsedPoints(mesh), 2);
  MultiVector f(static_cast<Id>(mesh.points.size()), 1);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    const Vec3 p = grid.ToGrid(mesh.points[i]) / grid.CellsPerSide();
    f(static_cast<Id>(i), 0) =
      std::sin(9.0 * p[0]) * std::cos(7.0 * p[1]) + std::sin(40.0 * p[2] + 3.0 * p[0]);
  }
  return f;
}

/// Dense Rᵀ as the thesis writes it: M_c⁻¹ Pᵀ M_f E_f, lumped masses, over the clipped mesh.
Eigen::MatrixXd PseudoEvaluation(const Hybrid& hybrid)
{
  const ClippedMesh& clipped = hybrid.space.clipped;
  const auto points = static_cast<Id>(clipped.position.size());
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(points);
  for (Id piece = 0; piece < clipped.NumberOfPieces(); ++piece)
  {
    const Index* corner = &clipped.corners[clipped.pieceBegin[piece]];
    const Id count = clipped.pieceBegin[piece + 1] - clipped.pieceBegin[piece];
    for (Id k = 1; k + 1 < count; ++k)
    {
      const Vec3& apex = clipped.position[corner[0]];
      const double third =
        (clipped.position[corner[k]] - apex).cross(clipped.position[corner[k + 1]] - apex).norm() /
        6.0;
      for (const Id point : { corner[0], corner[k], corner[k + 1] })
      {
        mass[point] += third;
      }
    }
  }
  const HatFunctions& functions = hybrid.hats.functions;
  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(points, functions.Count());
  for (Id point = 0; point < points; ++point)
  {
    if (point < clipped.numberOfInputPoints)
    {
      P(point, functions.ofPoint[point]) = 1.0;
      continue;
    }
    const CutPoint& cut = clipped.cutPoints[point - clipped.numberOfInputPoints];
    for (int k = 0; k < 3; ++k)
    {
      P(point, functions.ofPoint[hybrid.mesh.triangles[cut.triangle][k]]) += cut.Weights()[k];
    }
  }
  const Index count = hybrid.space.Finest().numberOfFunctions;
  const Eigen::MatrixXd E =
    EvaluateAtClippedPoints(hybrid.space, MultiVector::Identity(count, count));
  const Eigen::VectorXd lumped = P.transpose() * mass;
  return lumped.cwiseInverse().asDiagonal() * (P.transpose() * (mass.asDiagonal() * E));
}

/// Part of the surface, measured in ∫ b_i, whose grid functions get no residual: empty columns.
double ShareWithoutResidual(const Hybrid& hybrid)
{
  const SharedArray<Index>& column = hybrid.hats.prolongation.column;
  const std::set<Index> reached(column.begin(), column.end());
  double without = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < hybrid.system.integral.size(); ++i)
  {
    all += hybrid.system.integral[i];
    without += reached.count(static_cast<Index>(i)) ? 0.0 : hybrid.system.integral[i];
  }
  return without / all;
}

} // namespace

TEST(HatTransfer, EvaluatesAtThePoints)
{
  for (const TriangleMesh& mesh :
    { Transform(GeodesicSphere(5), { 1, 2, 3 }, 0.4), Unweld(Transform(Box(3), { 1, 2, 3 }, 0.4)) })
  {
    const Hybrid hybrid(mesh, 4, HatTransfer::Evaluation);
    const MultiVector x = RandomValues(hybrid.space.Finest().numberOfFunctions, 2);
    MultiVector onHats;
    Multiply(hybrid.hats.prolongation, x, onHats);
    EXPECT_LT(RelativeDifference(
                ValuesAtPoints(hybrid.hats.functions, onHats), EvaluateAtPoints(hybrid.space, x)),
      1e-13);
  }
}

TEST(HatTransfer, IsThePseudoEvaluationMatrixOfTheThesis)
{
  for (const TriangleMesh& mesh : { Transform(GeodesicSphere(4), { 1, 2, 3 }, 0.4),
         Transform(Box(2), { 1, 1, 3 }, 0.8), FlatRectangle(3, 2) })
  {
    for (const int depth : { 2, 3, 4 }) // grids coarser and finer than the mesh
    {
      const Hybrid hybrid(mesh, depth, HatTransfer::PseudoEvaluation);
      EXPECT_LT(
        (Dense(hybrid.hats.prolongation) - PseudoEvaluation(hybrid)).cwiseAbs().maxCoeff(), 1e-12);
    }
  }
}

TEST(HatTransfer, KeepsConstants)
{
  for (const SpaceCase& c : AllSpaces())
  {
    const FunctionSpace space = c.Build();
    const HatFunctions hats = NumberHatFunctions(c.mesh);
    for (const HatTransfer transfer : { HatTransfer::Evaluation, HatTransfer::PseudoEvaluation })
    {
      MultiVector sums;
      Multiply(BuildHatProlongation(hats, space, c.mesh, transfer),
        MultiVector::Ones(space.Finest().numberOfFunctions, 1), sums);
      EXPECT_LT((sums.array() - 1.0).abs().maxCoeff(), 1e-14) << c;
    }
  }
}

TEST(HatTransfer, ReachesTheWholeSurfaceAlsoWhereTheGridIsFiner)
{
  // 18 points reach their own 8 functions each, some tenth of a grid of depth 5. The points of the
  // clipped mesh miss only functions that all pieces touch with one cut-off corner of their cell,
  // where all points lie on faces on which the function vanishes: it is 1/27 there at most.
  const TriangleMesh mesh = Transform(GeodesicSphere(2), { 1, 2, 3 }, 0.4);
  EXPECT_GT(ShareWithoutResidual(Hybrid(mesh, 5, HatTransfer::Evaluation)), 0.5);
  EXPECT_LT(ShareWithoutResidual(Hybrid(mesh, 5, HatTransfer::PseudoEvaluation)), 1.0 / 27.0);
}

TEST(HatTransfer, RefusesAnotherMesh)
{
  const Hybrid hybrid(GeodesicSphere(3), 3);
  EXPECT_THROW(BuildHatProlongation(
                 hybrid.hats.functions, hybrid.space, GeodesicSphere(2), HatTransfer::Evaluation),
    InvalidInput);
}

namespace
{

/// The blocks of an order that have each unknown.
std::vector<std::set<Id>> BlocksOfUnknowns(const PatchOrder& order, Index unknowns)
{
  std::vector<std::set<Id>> blocks(unknowns);
  for (Id block = 0; block + 1 < static_cast<Id>(order.blockBegin.size()); ++block)
  {
    for (Id k = order.blockBegin[block]; k < order.blockBegin[block + 1]; ++k)
    {
      for (const Index unknown : order.dof[k])
      {
        if (unknown >= 0)
        {
          blocks[unknown].insert(block);
        }
      }
    }
  }
  return blocks;
}

/// Blocks of one colour are relaxed at the same time.
void ExpectColoursSeparateBlocks(const PatchOrder& order, const SparseMatrix& A)
{
  const std::vector<std::set<Id>> blocks = BlocksOfUnknowns(order, A.rows);
  std::vector<std::size_t> colour(order.blockBegin.size() - 1);
  EXPECT_GE(colour.size(), 6u); // there is something to colour
  for (std::size_t c = 0; c + 1 < order.colourBegin.size(); ++c)
  {
    std::fill(colour.begin() + order.colourBegin[c], colour.begin() + order.colourBegin[c + 1], c);
  }
  for (Index i = 0; i < A.rows; ++i)
  {
    for (Id k = A.rowBegin[i]; k < A.rowBegin[i + 1]; ++k)
    {
      for (const Id a : blocks[i])
      {
        for (const Id b : blocks[A.column[k]])
        {
          ASSERT_TRUE(a == b || colour[a] != colour[b]) << i << " " << A.column[k];
        }
      }
    }
  }
}

/// 18 points around a large ring at each of `along` places.
TriangleMesh Ring(int along)
{
  return Torus(along, 18, 10.0, 0.3);
}

SparseMatrix HatStiffness(const TriangleMesh& mesh)
{
  return AssembleHatMatrices(mesh, NumberHatFunctions(mesh)).stiffness;
}

} // namespace

TEST(HatOrdering, VisitsEveryUnknownOnceAndSeparatesBlocksOfAColour)
{
  const SparseMatrix A = HatStiffness(GeodesicSphere(30)); // 3602 functions
  const PatchOrder order = OrderInBlocks(A);
  std::vector<int> visits(A.rows, 0);
  for (const auto& group : order.dof)
  {
    for (const Index unknown : group)
    {
      visits[std::max(unknown, 0)] += unknown >= 0;
    }
  }
  EXPECT_EQ(visits, std::vector<int>(A.rows, 1));
  ExpectColoursSeparateBlocks(order, A);
}

TEST(HatOrdering, GroupsReachEveryUnknownAndSeparateBlocksOfAColour)
{
  for (const TriangleMesh& mesh : { GeodesicSphere(30), Ring(150), Ring(600) })
  {
    const SparseMatrix A = HatStiffness(mesh);
    const PatchOrder groups = GroupByCoupling(A);
    const std::vector<std::set<Id>> blocks = BlocksOfUnknowns(groups, A.rows);
    EXPECT_TRUE(
      std::none_of(blocks.begin(), blocks.end(), [](const std::set<Id>& b) { return b.empty(); }));
    EXPECT_TRUE(std::any_of(blocks.begin(), blocks.end(),
      [](const std::set<Id>& b) { return b.size() > 1; })); // some reach over borders
    ExpectColoursSeparateBlocks(groups, A);
  }
}

TEST(HatOrdering, GroupsFollowStrongCouplings)
{
  // Triangles four times as long along the ring as around the tube: all 18 points at one place are
  // coupled strongly, so that no group of eight leaves it.
  constexpr double Pi = 3.14159265358979323846;
  constexpr int Along = 150;
  const TriangleMesh mesh = Ring(Along);
  const HatFunctions hats = NumberHatFunctions(mesh);
  std::vector<long> place(hats.Count());
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
  {
    const double angle = std::atan2(mesh.points[p][1], mesh.points[p][0]);
    place[hats.ofPoint[p]] = std::lround(angle / (2.0 * Pi) * Along + Along) % Along;
  }
  for (const auto& group : GroupByCoupling(HatStiffness(mesh)).dof)
  {
    for (const Index member : group)
    {
      ASSERT_GE(member, 0);
      EXPECT_EQ(place[member], place[group[0]]);
    }
  }
}

TEST(HatMultigrid, IsASymmetricPositivePreconditioner)
{
  for (const HatTransfer transfer : { HatTransfer::Evaluation, HatTransfer::PseudoEvaluation })
  {
    const Hybrid hybrid(Torus(12, 60, 1.0, 0.3), 3, transfer);
    ASSERT_FALSE(hybrid.hats.groups.dof.empty());
    const Multigrid multigrid = hybrid.Build(hybrid.Weight(10.0));
    const MultiVector x = RandomValues(hybrid.hats.functions.Count(), 6);
    MultiVector Bx;
    multigrid.Precondition(x, Bx);
    const Eigen::MatrixXd products = x.transpose() * Bx;
    EXPECT_LT(RelativeDifference(products, products.transpose()), 1e-12);
    EXPECT_GT(products.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0.0);
  }
}

TEST(HatMultigrid, TakesNewWeights)
{
  const Hybrid hybrid(Torus(20, 20, 1.0, 0.3), 4);
  Multigrid updated = hybrid.Build(hybrid.Weight(1.0));
  UpdateHatMultigrid(hybrid.hats, hybrid.space, hybrid.system, hybrid.Weight(50.0), 1.0, updated);
  const Multigrid built = hybrid.Build(hybrid.Weight(50.0));
  const MultiVector b = RandomValues(hybrid.hats.functions.Count(), 1);
  MultiVector x;
  MultiVector y;
  updated.Precondition(b, x);
  built.Precondition(b, y);
  EXPECT_EQ(x, y);
}

TEST(HatMultigrid, DoesNotDependOnThreads)
{
  const TriangleMesh mesh = Transform(GeodesicSphere(40), { 1, 2, 3 }, 0.5);
  const MultiVector f = Waves(mesh);
  for (const HatTransfer transfer : { HatTransfer::Evaluation, HatTransfer::PseudoEvaluation })
  {
    EXPECT_EQ(Hybrid(mesh, 5, transfer, 1).Solve(10.0, f).coefficients,
      Hybrid(mesh, 5, transfer, 3).Solve(10.0, f).coefficients);
  }
}

namespace
{

struct PoissonCase
{
  const char* name;
  TriangleMesh mesh;
  int depth;
};

void PrintTo(const PoissonCase& c, std::ostream* stream)
{
  *stream << c.name << " depth " << c.depth;
}

std::vector<PoissonCase> PoissonCases()
{
  std::vector<PoissonCase> cases = { { "sphere", Transform(GeodesicSphere(20), { 1, 2, 0 }, 1), 4 },
    { "coarse sphere", Transform(GeodesicSphere(3), { 1, 2, 0 }, 1), 5 },
    { "thin triangles", Torus(12, 150, 1.0, 0.3), 4 },
    { "soup", Unweld(Transform(Box(6), { 1, 0, 1 }, 0.3, 40.0)), 4 },
    { "two sheets", TwoSheets(10, 0.01), 4 } };
  for (const char* name : { "neptune_30k.ply", "bones_26comp_4k.ply", "cheese_18k.ply",
         "dragon_res3_nonmanifold.ply", "stanford_bunny.ply", "conrod.stl" })
  {
    const std::string path = RealMesh(name);
    if (!path.empty())
    {
      cases.push_back({ name, ReadMesh(path), 5 });
    }
  }
  return cases;
}

class HatPoisson : public ::testing::TestWithParam<PoissonCase>
{
};

} // namespace

TEST_P(HatPoisson, IsTheSolutionOfADirectSolver)
{
  const TriangleMesh& mesh = GetParam().mesh;
  const HatSystem reference = BuildHatSystem(mesh);
  const MultiVector f = Waves(mesh);
  Hybrid hybrid(mesh, GetParam().depth);
  hybrid.solve.tolerance = 1e-11;
  for (const double relative : { 1.0, 1e3 })
  {
    const double lambda = relative / SurfaceArea(mesh);
    const PoissonSolution solution = hybrid.Solve(lambda, f);
    EXPECT_TRUE(solution.report.converged);
    const MultiVector u = ValuesAtPoints(hybrid.hats.functions, solution.coefficients);
    const Eigen::MatrixXd expected = SolveHatPoisson(mesh, reference, lambda, f);
    EXPECT_LT((u - expected).cwiseAbs().maxCoeff(), 1e-7 * expected.cwiseAbs().maxCoeff());
  }
}

TEST_P(HatPoisson, KeepsTheMeansWithoutScreening)
{
  const Hybrid hybrid(GetParam().mesh, GetParam().depth);
  const PoissonSolution solution = hybrid.Solve(0.0, Waves(GetParam().mesh));
  EXPECT_TRUE(solution.report.converged);
  const ComponentFunctions functions = hybrid.Functions();
  const MultiVector load = IntegrateValues(
    hybrid.hats.functions, hybrid.mesh, { FieldAssociation::Points, Waves(GetParam().mesh) });
  Eigen::VectorXd integral = Eigen::VectorXd::Zero(functions.numberOfComponents);
  Eigen::VectorXd area = integral;
  for (std::size_t i = 0; i < functions.component.size(); ++i)
  {
    integral[functions.component[i]] += load(static_cast<Id>(i), 0);
    area[functions.component[i]] += functions.integral[i];
  }
  for (std::size_t i = 0; i < functions.component.size(); ++i)
  {
    const Index k = functions.component[i];
    ASSERT_NEAR(solution.coefficients(static_cast<Id>(i), 0), integral[k] / area[k], 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, HatPoisson, ::testing::ValuesIn(PoissonCases()));

namespace
{

/// Iterations to a residual of 1e-8 for one weight in units of the unit cube.
int Iterations(const Hybrid& hybrid, double lambda)
{
  const double side = hybrid.space.GetGrid().spacing * hybrid.space.GetGrid().CellsPerSide();
  const PoissonSolution solution = hybrid.Solve(lambda / (side * side), Waves(hybrid.mesh));
  EXPECT_TRUE(solution.report.converged);
  return solution.report.iterations;
}

} // namespace

TEST(HatMultigrid, NeedsFewIterationsOnSubdividedMeshes)
{
  const std::string path = RealMesh("rocker_arm.ply");
  if (path.empty())
  {
    GTEST_SKIP() << "The folder of real meshes is not there.";
  }
  TriangleMesh mesh = ReadMesh(path);
  for (const int depth : { 5, 6 }) // 10,044 and 40,176 points, a third as many grid functions
  {
    const Hybrid hybrid(mesh, depth);
    for (const double lambda : { 1e-2, 1.0, 1e2, 1e4 })
    {
      // 4 to 6 were measured; Gauss-Seidel without groups needs up to 14, and 24 at 642,816 points.
      EXPECT_LE(Iterations(hybrid, lambda), 7) << depth << " " << lambda;
    }
    mesh = SubdivideInPlane(mesh);
  }
}

TEST(HatMultigrid, DoesNotMindThinTriangles)
{
  // 150 points around a thin tube and 12 along: triangles 10 and more times as long as wide.
  const TriangleMesh mesh = SubdivideInPlane(Torus(12, 150, 1.0, 0.3));
  Hybrid hybrid(mesh, 4);
  const int withGroups = Iterations(hybrid, 1.0);
  hybrid.options.relaxGroups = false;
  const int without = Iterations(hybrid, 1.0);
  EXPECT_LE(withGroups, 20);
  EXPECT_LE(2 * withGroups, without);
}

TEST(HatMultigrid, ConvergesInTenCyclesOfTheThesis)
{
  const std::string path = RealMesh("rocker_arm.ply");
  const TriangleMesh mesh =
    path.empty() ? Transform(GeodesicSphere(40), { 1, 2, 3 }, 0.5) : ReadMesh(path);
  for (const HatTransfer transfer : { HatTransfer::Evaluation, HatTransfer::PseudoEvaluation })
  {
    Hybrid hybrid(mesh, 5, transfer);
    UseThesisSweeps(hybrid.options);
    for (const double lambda : { 1e-2, 1e2, 1e4 })
    {
      const double weight = lambda * std::pow(0.25, 5);
      const Multigrid multigrid = hybrid.Build(weight);
      const MultiVector load =
        IntegrateValues(hybrid.hats.functions, mesh, { FieldAssociation::Points, Waves(mesh) });
      MultiVector x = MultiVector::Zero(load.rows(), 1);
      const SolveReport report = SolveCycles(multigrid, weight * load, x, hybrid.solve);
      EXPECT_TRUE(report.converged);
      EXPECT_LE(report.iterations, 10) << lambda; // Fig. 4.7
    }
  }
}

TEST(HatMultigrid, DoesNotMindAGridThatIsMuchFinerThanTheMesh)
{
  // A point's residual spread over the hat is answered alike by every grid; a point load is not.
  const TriangleMesh mesh = Transform(GeodesicSphere(3), { 1, 2, 3 }, 0.5); // 38 points
  const auto cycles = [&](int depth, HatTransfer transfer)
  {
    Hybrid hybrid(mesh, depth, transfer);
    hybrid.options.relaxGroups = false; // of 38 points they would leave the grid nothing to do
    const double weight = 0.01 * std::pow(0.25, depth);
    const Multigrid multigrid = hybrid.Build(weight);
    MultiVector x = MultiVector::Zero(hybrid.hats.functions.Count(), 1);
    const MultiVector load =
      IntegrateValues(hybrid.hats.functions, mesh, { FieldAssociation::Points, Waves(mesh) });
    const SolveReport report = SolveCycles(multigrid, weight * load, x, hybrid.solve);
    EXPECT_TRUE(report.converged);
    return report.iterations;
  };
  EXPECT_EQ(cycles(6, HatTransfer::PseudoEvaluation), cycles(4, HatTransfer::PseudoEvaluation));
  EXPECT_GT(cycles(6, HatTransfer::Evaluation), cycles(6, HatTransfer::PseudoEvaluation));
}
