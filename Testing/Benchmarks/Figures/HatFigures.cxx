#include "AlgebraicMultigrid.h"
#include "Figures.h"
#include "Hierarchy.h"
#include "IndependentSets.h"
#include "Measure.h"
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

/// Everybody's cycle with the thesis' smoother on one hat system.
class HatContestants
{
public:
  HatContestants(const TriangleMesh& mesh, const SymmetricMatrix& A, const Eigen::MatrixXd& b)
    : A_(A), b_(b), sets_(RemoveIndependentSets(mesh, Coarsest)),
      aksoylu1_(BuildHierarchy(A_, Compose(sets_), ThesisCycle())),
      aksoylu2_(BuildHierarchy(A_, sets_, OneVisit())),
      aggregation_(MakeGamg(A_, AmgUse::ThesisCycle)),
      classical_(MakeBoomerAmg(A_, AmgUse::ThesisCycle))
  {
    aggregation_->Setup();
    classical_->Setup();
  }

  std::vector<NamedIterate> Iterates() const
  {
    return { { "Aksoylu #1", Curve::Kind::Peer, Cycles(aksoylu1_, b_) },
      { "Aksoylu #2, V", Curve::Kind::Peer, Cycles(aksoylu2_, b_) },
      { "AMG #1, aggregation", Curve::Kind::Peer, this->Of(*aggregation_) },
      { "AMG #2, classical", Curve::Kind::Peer, this->Of(*classical_) } };
  }

  const SymmetricMatrix& A() const { return A_; }
  const Eigen::MatrixXd& B() const { return b_; }

private:
  /// Two dozen levels that shrink by a quarter each would make a W-cycle cost thousands of sweeps.
  static MultigridOptions OneVisit()
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

double SquaredSide(const TriangleMesh& mesh)
{
  Eigen::AlignedBox3d box;
  for (const Vec3& point : mesh.points)
  {
    box.extend(point);
  }
  const double side = box.sizes().maxCoeff();
  return side * side;
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
  const TriangleMesh mesh = RockerArm(0).mesh;
  HatProblem colours = AssembleProblem(mesh);
  ChooseColours(mesh, colours, 1);
  WriteFigure(
    { "figure-4.7", { ConvergencePanel("Rocker arm, hat functions, colours, screening 0.01",
                      HatContestants(mesh, colours.A, colours.b)) } },
    folder);
  const HatSpectrum spectrum = SpectraSpectrum(colours.hats, Modes);
  const Eigen::MatrixXd sum = spectrum.vectors.rowwise().sum();
  Figure convergence{ "figure-4.9", {} };
  Figure errors{ "figure-4.10", {} };
  for (const double weight : { 1e-2, 1.0, 1e2, 1e4 })
  {
    const SymmetricMatrix A = Combine(colours.hats, weight / SquaredSide(mesh));
    const HatContestants contestants(mesh, A, A * sum);
    convergence.panels.push_back(ConvergencePanel(Text("Screening %g", weight), contestants));
    for (const int cycles : { 1, 5, 10 })
    {
      if (weight == 1e-2)
      {
        errors.panels.push_back(
          SpectrumOfError(cycles, contestants, colours.hats.mass, spectrum.vectors, sum));
      }
    }
  }
  WriteFigure(convergence, folder);
  WriteFigure(errors, folder);
}

} // namespace gridfem::benchmarks
