#include "Equations/BiharmonicIteration.h"

#include "Spaces/FiniteElementSpace.h"
#include "Spaces/PointComponents.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

/// Penalty of the constraints in K. It is enough to condition S. With a larger one, values as dense
/// as the functions take longer to settle.
constexpr double Penalty = 30.0;

/// Tolerances of the solves with K and of the multipliers. A larger tolerance of the caller
/// replaces them.
constexpr double InnerTolerance = 1e-7;
constexpr double OuterTolerance = 1e-5;
constexpr double OuterOverInner = OuterTolerance / InnerTolerance;

/// Products with S and with its factors.
class NodalProducts
{
public:
  NodalProducts(const FiniteElementSpace& space, const ConstrainedHierarchy& hierarchy,
    const SolveOptions& solve, const Projection& project, const Progress& progress)
    : space_(space), hierarchy_(hierarchy), threads_(hierarchy.GetMultigrid().Options().threads),
      mass_(space.Matrix(0, 1.0, 0.0, threads_)), solve_(solve), project_(project),
      progress_(progress)
  {
  }

  /// K⁻¹ b
  MultiVector Invert(const MultiVector& b)
  {
    MultiVector right = b;
    if (project_.residual)
    {
      project_.residual(right);
    }
    const Multigrid& multigrid = hierarchy_.GetMultigrid();
    MultiVector x = MultiVector::Zero(b.rows(), b.cols());
    KeepWorse(SolveWithFallback(IterationType::ConjugateGradients, OperatorOf(multigrid),
                CycleWithFallback(multigrid), right, x, solve_, project_, progress_),
      inner);
    return x;
  }

  /// K⁻¹ Cᵀ W ν
  MultiVector Spread(const MultiVector& multipliers)
  {
    return this->Invert(hierarchy_.Penalty().LoadOf(multipliers, threads_));
  }

  MultiVector MassOf(const MultiVector& u) const
  {
    MultiVector product;
    Multiply(mass_, u, product, threads_);
    return product;
  }

  MultiVector AtPoints(const MultiVector& u) const
  {
    MultiVector values;
    Multiply(hierarchy_.Rows(), u, values, threads_);
    return values;
  }

  MultiVector Weighted(const MultiVector& values) const
  {
    return hierarchy_.Penalty().Weighted(values);
  }

  MultiVector Product(const MultiVector& multipliers)
  {
    return this->Weighted(this->AtPoints(this->Invert(this->MassOf(this->Spread(multipliers)))));
  }

  /// The row sums of S: the area around each point.
  std::vector<double> Areas()
  {
    const Eigen::Map<const Eigen::VectorXd> integrals(
      space_.Integrals().data(), static_cast<Eigen::Index>(space_.Integrals().size()));
    const MultiVector area = this->Weighted(this->AtPoints(this->Invert(integrals)));
    const double mean = area.cwiseAbs().mean();
    std::vector<double> areas(area.rows());
    for (Id k = 0; k < area.rows(); ++k)
    {
      areas[k] = std::max(area(k, 0), 1e-6 * mean); // a point among others may have almost no area
    }
    return areas;
  }

  SolveReport inner = SolveReport::Solved(); // the worst report of the solves with K

private:
  const FiniteElementSpace& space_;
  const ConstrainedHierarchy& hierarchy_;
  int threads_;
  SparseMatrix mass_;
  SolveOptions solve_;
  const Projection& project_;
  Progress progress_;
};

/// Solves with S, with the areas around the points as preconditioner.
SolveReport SolveForMultipliers(NodalProducts& products, Id points, int threads,
  const MultiVector& right, const SolveOptions& options, MultiVector& multipliers,
  const Progress& progress)
{
  const std::vector<double> areas = products.Areas();
  LinearOperator S;
  S.rows = points;
  S.threads = threads;
  S.multiply = [&](const MultiVector& x, MultiVector& y) { y = products.Product(x); };
  S.residual = [&](const MultiVector& x, const MultiVector& b, MultiVector& r)
  { r = b - products.Product(x); };
  S.products = [threads](const MultiVector& x, const MultiVector& y)
  { return ColumnProducts(x, y, threads); };
  const Preconditioner divide = [&areas](const MultiVector& r, MultiVector& z)
  {
    const Eigen::Map<const Eigen::VectorXd> area(
      areas.data(), static_cast<Eigen::Index>(areas.size()));
    z = area.cwiseInverse().asDiagonal() * r;
  };
  multipliers = MultiVector::Zero(points, right.cols());
  return SolveConjugateGradients(S, divide, right, multipliers, options, {}, progress);
}

/// Replaces the report of a solution by the report of a solve that has failed.
void ReportFailure(const SolveReport& report, double wanted, ConstrainedSolution& solution)
{
  if (solution.report.converged && !report.converged)
  {
    solution.report = report;
    solution.wanted = wanted;
  }
}

} // namespace

ConstrainedSolution IterateBiharmonic(const FiniteElementSpace& space, const SparseMatrix& rows,
  const MultiVector& values, const InterpolationOptions& options, const Progress& progress)
{
  const int threads = options.multigrid.threads;
  const ConstrainedHierarchy hierarchy(
    space, 0.0, 1.0, rows, Penalty, options.multigrid, progress.Part(0.0, 0.03));
  const ConstrainedHierarchy strict(space, 0.0, 1.0, rows, options.constraints.penalty,
    options.multigrid, progress.Part(0.03, 0.06));
  // Contradictory values would keep conjugate gradients from converging. A solve that ends early
  // misses all values, and says nothing about them.
  ConstrainedSolution solution = SolveConstrained(
    space, 0.0, strict, {}, values, options.constraints, options.solve, progress.Part(0.06, 0.1));
  MultiVector wanted = values;
  if (solution.report.converged && !solution.isExact)
  {
    Multiply(rows, solution.coefficients, wanted, threads);
  }
  const Components components = space.ComponentsOf(0, threads);
  const std::vector<Index> componentOfRow = ComponentsOfRows(rows, components);
  const MultiVector mean = ConstantsOf(space, 0.0, {}, componentOfRow, wanted, components);
  SubtractConstants(mean, componentOfRow, wanted);

  const FreeConstants free(components, solution.isHeld, threads);
  const Projection project = free.AsProjection();
  SolveOptions outer = options.solve;
  outer.tolerance = std::max(OuterTolerance, options.solve.tolerance);
  SolveOptions inner = options.solve;
  inner.tolerance = outer.tolerance / OuterOverInner;
  NodalProducts products(space, hierarchy, inner, project, progress.Part(0.1, 0.1));
  const MultiVector penalised = products.Spread(wanted);
  MultiVector multipliers;
  solution.wanted = outer.tolerance;
  solution.report = SolveForMultipliers(products, rows.rows, threads,
    products.Weighted(wanted - products.AtPoints(penalised)), outer, multipliers,
    progress.Part(0.1, 0.9));
  solution.coefficients =
    penalised + products.Invert(products.MassOf(products.Spread(multipliers)));

  const ConstrainedSolution rest =
    SolveConstrained(space, 0.0, strict, {}, wanted - products.AtPoints(solution.coefficients),
      options.constraints, options.solve, progress.Part(0.9, 1.0));
  solution.coefficients += rest.coefficients;
  ReportFailure(products.inner, inner.tolerance, solution);
  ReportFailure(rest.report, options.solve.tolerance, solution);
  SubtractConstants(-mean, components.ofFunction, solution.coefficients);
  return solution;
}

} // namespace gridfem
