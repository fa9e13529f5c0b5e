#include "Equations/HarmonicInterpolation.h"

#include "Base/Errors.h"
#include "Equations/BiharmonicIteration.h"
#include "Equations/Poisson.h"
#include "Spaces/PointComponents.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <limits>
#include <string>

namespace gridfem
{
namespace
{

/// Applies L⁺ to every column, or L⁺ of the next coarser level. Keeps the worst report.
class InverseLaplacian
{
public:
  InverseLaplacian(
    const FiniteElementSpace& space, const InterpolationOptions& options, const Progress& progress)
    : space_(space), multigrid_(BuildMultigrid(space, 0.0, 1.0, options.multigrid, progress)),
      poisson_(PoissonOptions{ { options.multigrid, options.solve }, 0.0 })
  {
  }

  MultiVector OnCoarser(const MultiVector& load, const Progress& progress) const
  {
    PoissonOptions coarser = poisson_;
    coarser.solve.maximumIterations = 0;
    return SolvePoisson(
      space_, multigrid_, MultiVector::Zero(load.rows(), load.cols()), load, coarser, progress)
      .coefficients;
  }

  MultiVector Of(const MultiVector& load, const Progress& progress)
  {
    PoissonSolution solution = SolvePoisson(
      space_, multigrid_, MultiVector::Zero(load.rows(), load.cols()), load, poisson_, progress);
    KeepWorse(std::move(solution.report), report);
    return std::move(solution.coefficients);
  }

  SolveReport report = SolveReport::Solved();

private:
  const FiniteElementSpace& space_;
  Multigrid multigrid_;
  PoissonOptions poisson_;
};

/// Returns `count` rows from the row `first` on, as dense columns.
MultiVector DenseTranspose(const SparseMatrix& rows, Index first, Index count)
{
  MultiVector dense = MultiVector::Zero(rows.columns, count);
  for (Index row = first; row < first + count; ++row)
  {
    for (Id k = rows.rowBegin[row]; k < rows.rowBegin[row + 1]; ++k)
    {
      dense(rows.column[k], row - first) = rows.value[k];
    }
  }
  return dense;
}

/// Computes L⁺ Cᵀ and the Green's matrix C L⁺ M L⁺ Cᵀ of the points. A solve needs ten vectors for
/// each of its columns, so few columns are solved at a time.
/// @param inverse  L⁺
template<class Inverse>
MultiVector SolveForPoints(const SparseMatrix& mass, const SparseMatrix& rows,
  const Inverse& inverse, Eigen::MatrixXd& green, const Job& job)
{
  constexpr Index ColumnsAtOnce = 8; // they fill the lanes of a vector instruction
  MultiVector ofPoints(rows.columns, rows.rows);
  green.resize(rows.rows, rows.rows);
  for (Index first = 0; first < rows.rows; first += ColumnsAtOnce)
  {
    const Index count = std::min(ColumnsAtOnce, rows.rows - first);
    const double done = double(first) / rows.rows;
    const MultiVector part = inverse(DenseTranspose(rows, first, count),
      job.progress.Part(done, done + double(count) / rows.rows));
    ofPoints.middleCols(first, count) = part;
    MultiVector massOf;
    Multiply(mass, part, massOf, job.threads);
    // The rows up to the last of these points; the rows below them follow from the symmetry.
    const Index known = first + count;
    green.block(0, first, known, count) = ofPoints.leftCols(known).transpose() * massOf;
    green.block(first, 0, count, first) = green.block(0, first, first, count).transpose();
  }
  return ofPoints;
}

/// Solves a symmetric system [S B; Bᵀ 0] that may be singular, by least squares.
Eigen::MatrixXd SolveSymmetric(const Eigen::MatrixXd& system, const Eigen::MatrixXd& right)
{
  constexpr double Rounding = 1e-10;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(system);
  const Eigen::ArrayXd size = eigen.eigenvalues().array().abs();
  const Eigen::ArrayXd inverse =
    (size > Rounding * size.maxCoeff()).select(eigen.eigenvalues().array().inverse(), 0.0);
  return eigen.eigenvectors() * inverse.matrix().asDiagonal() *
         (eigen.eigenvectors().transpose() * right);
}

/// One column per component with points, with 1 at its points.
struct PointsOfComponents
{
  Eigen::MatrixXd ones;
  std::vector<Index> component; // of each column
};

PointsOfComponents GroupPoints(const SparseMatrix& rows, const Components& components)
{
  std::vector<Index> columnOf(components.count, -1);
  PointsOfComponents points;
  for (const Index function : rows.column)
  {
    Index& column = columnOf[components.ofFunction[function]];
    if (column < 0)
    {
      column = static_cast<Index>(points.component.size());
      points.component.push_back(components.ofFunction[function]);
    }
  }
  points.ones =
    Eigen::MatrixXd::Zero(rows.rows, static_cast<Eigen::Index>(points.component.size()));
  const std::vector<Index> component = ComponentsOfRows(rows, components);
  for (Index row = 0; row < rows.rows; ++row)
  {
    if (component[row] >= 0)
    {
      points.ones(row, columnOf[component[row]]) = 1.0;
    }
  }
  return points;
}

/// Computes G μ + c; NaN on components without a point.
/// @param inverse  L⁺
template<class Inverse>
MultiVector FitBiharmonic(const Components& components, const PointsOfComponents& points,
  const SparseMatrix& mass, const SparseMatrix& rows, const MultiVector& values,
  const Inverse& inverse, const Job& job)
{
  Eigen::MatrixXd green;
  const MultiVector ofPoints = SolveForPoints(mass, rows, inverse, green, job.Part(0.0, 0.8));
  const Eigen::Index m = rows.rows;
  const Eigen::Index constants = points.ones.cols();
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(m + constants, m + constants);
  const double size = std::max(green.diagonal().maxCoeff(), std::numeric_limits<double>::min());
  system.topLeftCorner(m, m) = 0.5 / size * (green + green.transpose());
  system.topRightCorner(m, constants) = points.ones;
  system.bottomLeftCorner(constants, m) = points.ones.transpose();
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(m + constants, values.cols());
  right.topRows(m) = values;
  const Eigen::MatrixXd solved = SolveSymmetric(system, right);

  MultiVector massOf;
  Multiply(mass, ofPoints * (solved.topRows(m) / size), massOf, job.threads);
  MultiVector coefficients = inverse(massOf, job.progress.Part(0.8, 1.0));
  MultiVector constant = MultiVector::Constant(
    components.count, values.cols(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t k = 0; k < points.component.size(); ++k)
  {
    constant.row(points.component[k]) = solved.row(m + static_cast<Eigen::Index>(k));
  }
  for (Id i = 0; i < coefficients.rows(); ++i)
  {
    coefficients.row(i) += constant.row(components.ofFunction[i]);
  }
  return coefficients;
}

/// The errors of a solution, by comparison with the function from the next coarser level.
SolutionAccuracy AccuracyOf(const FiniteElementSpace& space, const Components& components,
  const std::vector<char>& isHeld, MultiVector fine, MultiVector coarser, int threads)
{
  for (Id i = 0; i < fine.rows(); ++i)
  {
    if (!isHeld[components.ofFunction[i]])
    {
      fine.row(i).setZero();
      coarser.row(i).setZero();
    }
  }
  const AccuracyWatch watch(space, std::move(coarser), {}, 0.0, threads);
  const MultiVector none = MultiVector::Zero(components.count, fine.cols());
  return watch.Result(fine, SizeOfSolution(space, components, isHeld, fine, none, threads),
    Eigen::RowVectorXd::Ones(fine.cols()), ErrorOrder::Second);
}

ConstrainedSolution Biharmonic(const FiniteElementSpace& space, const SparseMatrix& rows,
  const MultiVector& values, const InterpolationOptions& options, const Progress& progress)
{
  const int threads = options.multigrid.threads;
  const Components components = space.ComponentsOf(0, threads);
  const PointsOfComponents points = GroupPoints(rows, components);
  const SparseMatrix mass = space.Matrix(0, 1.0, 0.0, threads);
  InverseLaplacian inverse(space, options, progress.Part(0.0, 0.1));
  ConstrainedSolution solution;
  solution.coefficients = FitBiharmonic(
    components, points, mass, rows, values,
    [&](const MultiVector& load, const Progress& part) { return inverse.Of(load, part); },
    Job{ threads, progress.Part(0.1, 0.9) });
  solution.report = inverse.report;
  solution.steps = 1;
  solution.isHeld.assign(components.count, 0);
  for (const Index component : points.component)
  {
    solution.isHeld[component] = 1;
  }
  const MultiVector coarser = FitBiharmonic(
    components, points, mass, rows, values,
    [&](const MultiVector& load, const Progress& part) { return inverse.OnCoarser(load, part); },
    Job{ threads, progress.Part(0.9, 1.0) });
  solution.accuracy =
    AccuracyOf(space, components, solution.isHeld, solution.coefficients, coarser, threads);
  return solution;
}

/// Measures the difference between a solution and its values, and whether it exceeds the tolerance.
void MeasureMisfit(const SparseMatrix& rows, const MultiVector& values, double tolerance,
  int threads, ConstrainedSolution& solution)
{
  MultiVector reached;
  Multiply(rows, solution.coefficients, reached, threads);
  solution.misfit = 0.0;
  double range = 0.0;
  for (Index row = 0; row < rows.rows; ++row)
  {
    if (rows.rowBegin[row] < rows.rowBegin[row + 1])
    {
      const auto rest = (reached.row(row) - values.row(row)).cwiseAbs();
      solution.misfit = LargerOrUnknown(solution.misfit, rest.maxCoeff<Eigen::PropagateNaN>());
      range = std::max(range, (values.row(row) - values.row(0)).cwiseAbs().maxCoeff());
    }
  }
  solution.relativeMisfit = range > 0.0 ? solution.misfit / range : solution.misfit;
  solution.isExact = solution.relativeMisfit <= tolerance;
}

/// Sets the solution to NaN on components without a point.
void ForgetFree(const FiniteElementSpace& space, int threads, ConstrainedSolution& solution)
{
  const MultiVector unknown = MultiVector::Constant(static_cast<Id>(solution.isHeld.size()),
    solution.coefficients.cols(), std::numeric_limits<double>::quiet_NaN());
  SetMeans(space, solution.isHeld, unknown, solution.coefficients, threads);
}

} // namespace

ConstrainedSolution InterpolateHarmonically(const FiniteElementSpace& space, const HeldRows& rows,
  const MultiVector& values, const InterpolationOptions& options, const Progress& progress)
{
  if (rows.column.empty() || rows.rows != values.rows())
  {
    throw InvalidInput("There are " + std::to_string(values.rows()) + " values for " +
                       std::to_string(rows.rows) +
                       " points; at least one point of the surface needs a value.");
  }
  if (options.smoothness == Smoothness::Harmonic)
  {
    ConstraintOptions constraints = options.constraints;
    constraints.estimateOn = &space;
    const ConstrainedHierarchy hierarchy(
      space, 0.0, 1.0, rows, constraints.penalty, options.multigrid, progress.Part(0.0, 0.3));
    ConstrainedSolution solution = SolveConstrained(
      space, 0.0, hierarchy, {}, values, constraints, options.solve, progress.Part(0.3, 1.0));
    ForgetFree(space, options.multigrid.threads, solution);
    return solution;
  }
  if (rows.rows > options.mostAtOnce)
  {
    constexpr double Met = 1e-6;
    ConstrainedSolution solution = IterateBiharmonic(space, rows, values, options, progress);
    MeasureMisfit(rows, values, Met, options.multigrid.threads, solution);
    ForgetFree(space, options.multigrid.threads, solution);
    return solution;
  }
  constexpr double Tolerance = 1e-4; // dense multipliers inherit the tolerance of the solves
  ConstrainedSolution solution = Biharmonic(space, rows, values, options, progress);
  MeasureMisfit(rows, values, Tolerance, options.multigrid.threads, solution);
  return solution;
}

} // namespace gridfem
