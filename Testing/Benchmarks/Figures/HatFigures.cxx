#include "AlgebraicMultigrid.h"
#include "Figures.h"
#include "Hierarchy.h"
#include "IndependentSets.h"
#include "Measure.h"
#include "Meshes.h"
#include "Problems.h"
#include "SetupCost.h"
#include "ShiftInvert.h"

#include <cmath>

namespace gridfem::benchmarks
{

namespace
{

constexpr int MostCycles = 30;
constexpr int Coarsest = 100;

struct NamedIterate
{
  std::string name;
  Curve::Kind kind;
  Iterate iterate;
};

double SquaredSide(const TriangleMesh& mesh)
{
  Eigen::AlignedBox3d box;
  for (const Vec3& point : mesh.points)
  {
    box.extend(point);
  }
  const double side = box.sizes().maxCoeff<Eigen::PropagateNaN>();
  return side * side;
}

/// The number of every row in the hybrid hierarchy.
std::vector<Index> FunctionsOfRows(const CotangentSystem& system, const HybridProblem& hybrid)
{
  std::vector<Index> functions(system.mass.rows());
  for (std::size_t point = 0; point < system.row.size(); ++point)
  {
    if (system.row[point] >= 0)
    {
      functions[system.row[point]] = hybrid.space.Hats().functions.ofPoint[point];
    }
  }
  return functions;
}

/// Iterates of the hybrid's cycle in the order of the rows. The multigrid must outlive them.
Iterate HybridCycles(
  const Multigrid& hybrid, const std::vector<Index>& functions, const Eigen::MatrixXd& b)
{
  Eigen::MatrixXd source(b.rows(), b.cols());
  for (std::size_t row = 0; row < functions.size(); ++row)
  {
    source.row(functions[row]) = b.row(row);
  }
  return [cycles = Cycles(hybrid, source), functions](int count)
  {
    const Eigen::MatrixXd x = cycles(count);
    Eigen::MatrixXd result(x.rows(), x.cols());
    for (std::size_t row = 0; row < functions.size(); ++row)
    {
      result.row(row) = x.row(functions[row]);
    }
    return result;
  };
}

/// Everybody's W-cycle with the thesis' smoother on one hat system.
class HatContestants
{
public:
  /// @param weight  λ in units of the unit cube
  HatContestants(const TriangleMesh& mesh, const CotangentSystem& system,
    const HybridProblem& hybrid, double weight, const Eigen::MatrixXd& exact)
    : A_(Combine(system, weight / SquaredSide(mesh))), b_(A_ * exact),
      hybrid_(hybrid.BuildCycle(weight, ThesisHybrid())), ours_(hybrid.BuildCycle(weight, {})),
      functions_(FunctionsOfRows(system, hybrid)), sets_(RemoveIndependentSets(mesh, Coarsest)),
      aksoylu1_(BuildHierarchy(A_, Compose(sets_), ThesisCycle())),
      aksoylu2_(BuildHierarchy(A_, sets_, VCycle())),
      aggregation_(MakeGamg(A_, AmgUse::ThesisCycle)),
      classical_(MakeBoomerAmg(A_, AmgUse::ThesisCycle))
  {
    aggregation_->Setup();
    classical_->Setup();
  }

  std::vector<NamedIterate> Iterates() const
  {
    return { { "grid below hats", Curve::Kind::Thesis, HybridCycles(hybrid_, functions_, b_) },
      { "Aksoylu #1", Curve::Kind::Peer, Cycles(aksoylu1_, b_) },
      { "Aksoylu #2, V-cycle", Curve::Kind::Peer, Cycles(aksoylu2_, b_) },
      { "AMG #1, aggregation", Curve::Kind::Peer, this->Of(*aggregation_) },
      { "AMG #2, classical", Curve::Kind::Peer, this->Of(*classical_) } };
  }

  const SymmetricMatrix& A() const { return A_; }
  const Eigen::MatrixXd& B() const { return b_; }
  /// Two sweeps on the hats, one patch sweep on the grid.
  Iterate Ours() const { return HybridCycles(ours_, functions_, b_); }

private:
  /// Levels that shrink by a quarter only make a W-cycle cost more the deeper it goes.
  static MultigridOptions VCycle()
  {
    MultigridOptions options = ThesisCycle();
    options.cycle = CycleType::V;
    return options;
  }

  Iterate Of(AlgebraicMultigrid& amg) const
  {
    return [this, &amg](int count) -> Eigen::MatrixXd
    {
      Eigen::VectorXd x = Eigen::VectorXd::Zero(b_.rows());
      if (count > 0)
      {
        amg.Solve(b_.col(0), x, 0.0, count);
      }
      return x;
    };
  }

  SymmetricMatrix A_;
  Eigen::MatrixXd b_;
  Multigrid hybrid_;
  Multigrid ours_;
  std::vector<Index> functions_;
  std::vector<Prolongation> sets_;
  Multigrid aksoylu1_;
  Multigrid aksoylu2_;
  std::unique_ptr<AlgebraicMultigrid> aggregation_;
  std::unique_ptr<AlgebraicMultigrid> classical_;
};

Panel ConvergencePanel(const std::string& title, const HatContestants& contestants)
{
  Panel panel{ title, "cycles", "relative residual", true, {} };
  for (const NamedIterate& method : contestants.Iterates())
  {
    panel.curves.push_back(CountedCurve(method.name, method.kind,
      Residuals(contestants.A(), contestants.B(), method.iterate, MostCycles)));
  }
  return panel;
}

/// The hybrid as the thesis has it against ours.
Panel HybridPanel(const HatContestants& contestants)
{
  const auto residuals = [&](const Iterate& iterate)
  { return Residuals(contestants.A(), contestants.B(), iterate, MostCycles); };
  return { "The same with our smoother", "cycles", "relative residual", true,
    { CountedCurve("W, 10 Gauss-Seidel", Curve::Kind::Thesis,
        residuals(contestants.Iterates().front().iterate)),
      CountedCurve("2 sweeps on hats, W, 1 patch sweep below", Curve::Kind::Ours,
        residuals(contestants.Ours())) } };
}

/// Coefficients of the error along the eigenvectors.
Panel SpectrumOfError(int cycles, const HatContestants& contestants, const SymmetricMatrix& mass,
  const Eigen::MatrixXd& vectors, const Eigen::MatrixXd& exact)
{
  Panel panel{ "After " + std::to_string(cycles) + (cycles == 1 ? " cycle" : " cycles"),
    "number of the eigenfunction", "coefficient of the error", true, {} };
  for (const NamedIterate& method : contestants.Iterates())
  {
    const Eigen::VectorXd coefficients =
      (vectors.transpose() * (mass * (exact - method.iterate(cycles)))).cwiseAbs();
    panel.curves.push_back(CountedCurve(method.name, method.kind,
      { coefficients.data(), coefficients.data() + coefficients.size() }, 1));
  }
  return panel;
}

} // namespace

void WriteHatConvergence(const std::string& folder)
{
  constexpr int Modes = 100;
  constexpr int Depth = 5;
  const TriangleMesh mesh = RockerArm(0).mesh;
  const CotangentSystem system = AssembleCotangents(mesh);
  const HybridProblem hybrid = SetUpHybrid(mesh, Depth, 1);
  const HatContestants colors(
    mesh, system, hybrid, ScreeningWeight, ToRows(system, ColorsAtPoints(mesh, 1)));
  WriteFigure(
    { "figure-4.7",
      { ConvergencePanel("Rocker arm, hat functions, screening 0.01: as the thesis", colors),
        HybridPanel(colors) } },
    folder);
  const HatSpectrum spectrum = SpectraSpectrum(system, Modes, TruthTolerance);
  const Eigen::MatrixXd sum = spectrum.vectors.rowwise().sum();
  Figure convergence{ "figure-4.9", {} };
  Figure errors{ "figure-4.10", {} };
  for (const double weight : { 1e-2, 1.0, 1e2, 1e4 })
  {
    const HatContestants contestants(mesh, system, hybrid, weight, sum);
    convergence.panels.push_back(
      ConvergencePanel("Sum of 100 eigenfunctions, screening " + Text("%g", weight), contestants));
    for (const int cycles : { 1, 5, 10 })
    {
      if (weight == 1e-2)
      {
        errors.panels.push_back(
          SpectrumOfError(cycles, contestants, system.mass, spectrum.vectors, sum));
      }
    }
  }
  WriteFigure(convergence, folder);
  WriteFigure(errors, folder);
}

void WriteKnotConvergence(const std::string& folder)
{
  constexpr int Depth = 5;
  const TriangleMesh knot = testing::TrefoilTube(400, 40);
  const CotangentSystem system = AssembleCotangents(knot);
  const Eigen::MatrixXd b =
    Combine(system, ScreeningWeight / SquaredSide(knot)) * ToRows(system, ColorsAtPoints(knot, 1));
  const SymmetricMatrix A = Combine(system, ScreeningWeight / SquaredSide(knot));
  Panel thesis{ "Knot, hat functions, grid of depth 5: W, 10 Gauss-Seidel", "cycles",
    "relative residual", true, {} };
  Panel ours{ "2 sweeps on hats, W, 1 patch sweep below", "cycles", "relative residual", true, {} };
  for (const FunctionSupport support :
    { FunctionSupport::Plain, FunctionSupport::ConnectivityAware })
  {
    const bool isPlain = support == FunctionSupport::Plain;
    const HybridProblem hybrid = SetUpHybrid(knot, Depth, 1, support);
    const std::vector<Index> functions = FunctionsOfRows(system, hybrid);
    for (Panel* panel : { &thesis, &ours })
    {
      const Multigrid cycle = hybrid.BuildCycle(
        ScreeningWeight, panel == &thesis ? ThesisHybrid() : testing::HybridCycle());
      panel->curves.push_back(
        CountedCurve(isPlain ? "plain grid below" : "connectivity-aware grid below",
          isPlain ? Curve::Kind::Peer : Curve::Kind::Ours,
          Residuals(A, b, HybridCycles(cycle, functions, b), MostCycles)));
    }
  }
  WriteFigure({ "figure-6.7", { thesis, ours } }, folder);
}

} // namespace gridfem::benchmarks
