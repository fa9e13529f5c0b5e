#include "AlgebraicMultigrid.h"
#include "Figures.h"
#include "Hierarchy.h"
#include "Integrals/Evaluation.h"
#include "Measure.h"
#include "Meshes.h"
#include "Problems.h"
#include "SetupCost.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace gridfem::benchmarks
{

namespace
{

constexpr int MostCycles = 30;
constexpr double Degree = 3.14159265358979323846 / 180.0;

/// A grid problem with the thesis' cycle beside ours.
struct GridCase
{
  GridProblem grid; // ours
  Multigrid thesis;
  SymmetricMatrix A;
  Eigen::MatrixXd b;

  GridCase(const TriangleMesh& mesh, int depth,
    FunctionSupport support = FunctionSupport::ConnectivityAware, Index coarsestSize = 100)
    : grid(SetUp(mesh, depth, 1, support, ScreeningWeight, coarsestSize)),
      thesis(BuildMultigrid(testing::ViewOf(grid.space, grid.system), grid.options.screeningWeight,
        1.0, ThesisCycle())),
      A(ToEigen(grid.multigrid->Matrix()))
  {
    ChooseColors(grid, 1);
    b = grid.options.screeningWeight * grid.values + grid.gradients;
  }
};

std::vector<double> ConjugateGradientResiduals(const GridCase& on)
{
  SolveOptions options;
  options.tolerance = 1e-12;
  options.maximumIterations = MostCycles;
  options.measure = SolveOptions::Measure::Residual;
  MultiVector x = MultiVector::Zero(on.b.rows(), 1);
  const Multigrid& multigrid = *on.grid.multigrid;
  const SolveReport report =
    SolveConjugateGradients(OperatorOf(multigrid), CycleOf(multigrid), on.b, x, options);
  std::vector<double> residuals;
  for (const IterationRecord& record : report.history)
  {
    residuals.push_back(record.residual);
  }
  return residuals;
}

Iterate Of(AlgebraicMultigrid& amg, const Eigen::VectorXd& b)
{
  amg.Setup();
  return [&amg, b](int count) -> Eigen::MatrixXd
  {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
    if (count > 0)
    {
      amg.Solve(b, x, 0.0, count);
    }
    return x;
  };
}

} // namespace

void WriteGridConvergence(const std::string& folder)
{
  const GridCase on(RockerArm(0).mesh, 5);
  const auto aggregation = MakeGamg(on.A, AmgUse::ThesisCycle);
  const auto classical = MakeBoomerAmg(on.A, AmgUse::ThesisCycle);
  const auto residuals = [&](const Iterate& iterate)
  { return Residuals(on.A, on.b, iterate, MostCycles); };
  const Curve grid = CountedCurve(
    "grid, W, 10 Gauss-Seidel", Curve::Kind::Thesis, residuals(Cycles(on.thesis, on.b)));
  Panel thesis{ "Rocker arm, depth 5, screening 0.01: as the thesis", "cycles", "relative residual",
    true, {} };
  thesis.curves = { grid,
    CountedCurve(
      "AMG #1, aggregation", Curve::Kind::Peer, residuals(Of(*aggregation, on.b.col(0)))),
    CountedCurve("AMG #2, classical", Curve::Kind::Peer, residuals(Of(*classical, on.b.col(0)))) };
  Panel ours{ "The same with the patch smoother", "cycles or iterations", "relative residual", true,
    { grid,
      CountedCurve(
        "grid, W, 1 patch sweep", Curve::Kind::Ours, residuals(Cycles(*on.grid.multigrid, on.b))),
      CountedCurve(
        "conjugate gradients with it", Curve::Kind::Ours, ConjugateGradientResiduals(on)) } };
  WriteFigure({ "figure-4.8", { thesis, ours } }, folder);
}

namespace
{

TriangleMesh RotatedCube(int squares, double degrees)
{
  return testing::Transform(testing::Box(squares), { 1, 1, 1 }, degrees * Degree);
}

const std::vector<double>& Angles()
{
  static const std::vector<double> angles{ 0.0, 0.01, 0.1, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0,
    7.5, 10.0, 12.5, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0 };
  return angles;
}

Panel RotationPanel(const std::string& title)
{
  Panel panel{ title, "rotation about (1,1,1), degrees", "relative residual", true, {} };
  for (const int cycles : { 1, 5, 10, 30 })
  {
    panel.curves.push_back(
      { std::to_string(cycles) + (cycles == 1 ? " cycle" : " cycles"), {}, {}, {} });
  }
  return panel;
}

void AddResiduals(Panel& panel, double angle, const GridCase& on, const Multigrid& multigrid)
{
  const Iterate iterate = Cycles(multigrid, on.b);
  const int cycles[] = { 1, 5, 10, 30 };
  for (std::size_t k = 0; k < panel.curves.size(); ++k)
  {
    panel.curves[k].x.push_back(angle);
    panel.curves[k].y.push_back(RelativeResidual(on.A, on.b, iterate(cycles[k])));
  }
}

/// Residual that is left by sweeps before and after an exact solve on the next coarser level.
double TwoLevelResidual(const GridCase& on, SmootherType smoother, int sweeps)
{
  std::vector<MultigridLevel> levels = BuildMultigridLevels(
    testing::ViewOf(on.grid.space, on.grid.system), on.grid.options.screeningWeight, 1.0, {});
  levels.resize(2);
  levels[1].prolongation = SharedMatrix();
  MultigridOptions options = ThesisCycle();
  options.smoother = smoother;
  options.preSweeps = sweeps;
  options.postSweeps = sweeps;
  const Multigrid twoLevels(std::move(levels), options);
  return RelativeResidual(on.A, on.b, Cycles(twoLevels, on.b)(1));
}

/// The excess of the sum of the other entries of each row over the diagonal, summed, relative to
/// the diagonals. [T (4.7), (4.8)]
double NonDiagonalDominance(const SymmetricMatrix& A)
{
  double excess = 0.0;
  double diagonals = 0.0;
  for (Eigen::Index row = 0; row < A.rows(); ++row)
  {
    double others = 0.0;
    double diagonal = 0.0;
    for (SymmetricMatrix::InnerIterator entry(A, row); entry; ++entry)
    {
      (entry.row() == row ? diagonal : others) += std::abs(entry.value());
    }
    excess += std::max(0.0, others - diagonal);
    diagonals += diagonal;
  }
  return excess / diagonals;
}

} // namespace

void WriteRotatedCubes(const std::string& folder)
{
  Figure residuals{ "figure-4.11", { RotationPanel("Cube, depth 5: W, 10 Gauss-Seidel sweeps"),
                                     RotationPanel("The same: W, 1 patch sweep") } };
  for (Curve& curve : residuals.panels[0].curves)
  {
    curve.kind = Curve::Kind::Thesis;
  }
  Panel twoLevels{ "Cube, depth 4: one cycle of two levels", "rotation about (1,1,1), degrees",
    "relative residual", true,
    { { "no smoothing", Curve::Kind::Reference, {}, {} },
      { "10 Gauss-Seidel sweeps", Curve::Kind::Thesis, {}, {} },
      { "1 patch sweep", Curve::Kind::Ours, {}, {} } } };
  Panel dominance{ "Cube, depth 5: missing diagonal dominance", "rotation about (1,1,1), degrees",
    "share of the diagonal", false, { { "finest matrix", Curve::Kind::Reference, {}, {} } } };
  for (const double angle : Angles())
  {
    const GridCase on(RotatedCube(1, angle), 5);
    AddResiduals(residuals.panels[0], angle, on, on.thesis);
    AddResiduals(residuals.panels[1], angle, on, *on.grid.multigrid);
    const GridCase small(RotatedCube(1, angle), 4);
    const double left[] = { TwoLevelResidual(small, SmootherType::GaussSeidel, 0),
      TwoLevelResidual(small, SmootherType::GaussSeidel, 10),
      TwoLevelResidual(small, SmootherType::Patch, 1) };
    for (int k = 0; k < 3; ++k)
    {
      twoLevels.curves[k].x.push_back(angle);
      twoLevels.curves[k].y.push_back(left[k]);
    }
    dominance.curves[0].x.push_back(angle);
    dominance.curves[0].y.push_back(NonDiagonalDominance(on.A));
  }
  WriteFigure(residuals, folder);
  WriteFigure({ "figure-4.12", { twoLevels, dominance } }, folder);
}

namespace
{

/// |u - exact| at the points of the mesh.
std::vector<double> ErrorAtPoints(const GridCase& on, const Eigen::MatrixXd& x)
{
  const MultiVector error = EvaluateAtPoints(on.grid.space, MultiVector(x - on.grid.exact));
  std::vector<double> values(error.rows());
  for (Id i = 0; i < error.rows(); ++i)
  {
    values[i] = error.row(i).cwiseAbs().sum();
  }
  return values;
}

} // namespace

void WriteErrorMaps(const std::string& folder)
{
  const TriangleMesh cube = RotatedCube(96, 1.0);
  const GridCase on(cube, 5);
  const std::vector<double> thesis = ErrorAtPoints(on, Cycles(on.thesis, on.b)(1));
  const std::vector<double> ours = ErrorAtPoints(on, Cycles(*on.grid.multigrid, on.b)(1));
  const std::vector<double> later = ErrorAtPoints(on, Cycles(*on.grid.multigrid, on.b)(3));
  const double largest = *std::max_element(thesis.begin(), thesis.end());
  WriteSurfaces("figure-4.13",
    { { "1 cycle, 10 Gauss-Seidel sweeps", cube, thesis, largest },
      { "1 cycle, 1 patch sweep", cube, ours, largest },
      { "3 cycles, 1 patch sweep", cube, later, largest } },
    folder);
}

void WriteSeparatedCubes(const std::string& folder)
{
  const TriangleMesh cubes = testing::CubeArray(6, 2, 1.0);
  Panel thesis{ "216 cubes, depth 5: W, 10 Gauss-Seidel sweeps", "cycles", "relative residual",
    true, {} };
  Panel ours{ "The same: W, 1 patch sweep", "cycles", "relative residual", true, {} };
  std::vector<ColoredSurface> surfaces;
  for (const FunctionSupport support :
    { FunctionSupport::Plain, FunctionSupport::ConnectivityAware })
  {
    const bool isPlain = support == FunctionSupport::Plain;
    const std::string name = isPlain ? "plain space" : "connectivity-aware space";
    // So small that no level is solved directly on which plain functions reach several cubes.
    constexpr Index CoarsestSize = 8;
    const GridCase on(cubes, 5, support, CoarsestSize);
    std::mt19937 generator(1);
    Eigen::MatrixXd start(on.b.rows(), 1);
    for (Eigen::Index i = 0; i < start.rows(); ++i)
    {
      start(i) = double(generator()) / double(std::mt19937::max());
    }
    const Curve::Kind kind = isPlain ? Curve::Kind::Peer : Curve::Kind::Ours;
    const Iterate cycles = Cycles(on.thesis, on.b, start);
    surfaces.push_back({ "10 cycles, " + name, cubes, ErrorAtPoints(on, cycles(10)), 0.0 });
    thesis.curves.push_back(CountedCurve(name, kind, Residuals(on.A, on.b, cycles, MostCycles)));
    ours.curves.push_back(CountedCurve(
      name, kind, Residuals(on.A, on.b, Cycles(*on.grid.multigrid, on.b, start), MostCycles)));
  }
  for (ColoredSurface& surface : surfaces)
  {
    surface.largest = *std::max_element(surfaces[0].value.begin(), surfaces[0].value.end());
  }
  WriteSurfaces("figure-6.5", surfaces, folder);
  WriteFigure({ "figure-6.6", { thesis, ours } }, folder);
}

} // namespace gridfem::benchmarks
