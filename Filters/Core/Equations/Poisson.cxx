#include "Equations/Poisson.h"

#include "Algebra/ComponentMeans.h"
#include "Equations/ColumnScales.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace gridfem
{

namespace
{

void CheckRows(const char* name, const MultiVector& load, std::size_t functions)
{
  if (static_cast<std::size_t>(load.rows()) != functions)
  {
    throw InvalidInput("The integrals of the " + std::string(name) + " have " +
                       std::to_string(load.rows()) + " rows for " + std::to_string(functions) +
                       " functions.");
  }
}

void CheckInput(const SpaceLevels& space, const MultiVector& values, const MultiVector& gradients,
  const PoissonOptions& options)
{
  if (!(options.screeningWeight >= 0.0) || std::isinf(options.screeningWeight))
  {
    throw InvalidInput("The screening weight is " + std::to_string(options.screeningWeight) +
                       "; it must be a number of 0 or more.");
  }
  if (!(options.accuracy >= 0.0 && options.accuracy <= 1.0))
  {
    throw InvalidInput("The accuracy must lie between 0 and 1.");
  }
  CheckRows("values", values, space.Integrals().size());
  if (gradients.cols() != 0)
  {
    CheckRows("gradients", gradients, space.Integrals().size());
    if (gradients.cols() != values.cols())
    {
      throw InvalidInput("There are " + std::to_string(gradients.cols()) + " gradient fields for " +
                         std::to_string(values.cols()) + " value fields.");
    }
  }
}

/// Tolerance of the energy residual, for solutions that coarser levels contain.
constexpr double RoundingTolerance = 1e-9;

/// Accepts NaN, which stays in its column and is reported there.
void RequireInRange(const Eigen::RowVectorXd& size)
{
  constexpr double Largest = 1e150;
  if ((size.array() > Largest).any())
  {
    throw InvalidInput("The screening weight is too large for the range of numbers.");
  }
}

/// |x_c| of every column.
Eigen::RowVectorXd NormsOf(const LinearOperator& A, const MultiVector& x)
{
  return A.products(x, x).sqrt().matrix().transpose();
}

/// Sets a column to 0 if nothing but rounding is left after the means are taken out.
void DropRounding(const LinearOperator& A, const Eigen::RowVectorXd& size, MultiVector& rest)
{
  constexpr double Relative = 8.0 * std::numeric_limits<double>::epsilon();
  const Eigen::RowVectorXd left = NormsOf(A, rest);
  for (Id c = 0; c < rest.cols(); ++c)
  {
    if (left[c] <= Relative * size[c])
    {
      rest.col(c).setZero();
    }
  }
}

/// Computes an approximate error z for the residual r, and its size in the measure of convergence.
Columns MeasureError(
  const Multigrid& multigrid, const Projection& project, MultiVector r, MultiVector& z)
{
  project.residual(r);
  multigrid.Precondition(r, z);
  project.solution(z);
  return OperatorOf(multigrid).products(r, z).abs().sqrt();
}

/// sqrt(λ ∫ m²) for the means m of a field.
Columns EnergyOfMeans(
  const LinearOperator& A, double lambda, const ComponentMeans& means, const MultiVector& values)
{
  MultiVector constants = MultiVector::Zero(values.rows(), values.cols());
  means.AddConstants(means.OfIntegrals(values), constants);
  return (lambda * A.products(constants, values)).abs().sqrt();
}

/// Overlapping sheets: clipping perturbs their integrals by about 1e-10 cells. Opposite fields on
/// them therefore leave a spurious load of that size, which no function needs to match. A column is
/// dropped if the energy of its solution is equally small, relative to the energy of the means.
/// @param energyOfMeans  the square root of this energy, of every column
/// @return               whether a column was dropped
bool DropCanceled(const Multigrid& multigrid, const Projection& project,
  const Columns& energyOfMeans, MultiVector& rest)
{
  constexpr double Clipping = 1e-9;
  MultiVector solution;
  const Columns energy = MeasureError(multigrid, project, rest, solution);
  bool isDropped = false;
  for (Id c = 0; c < rest.cols(); ++c)
  {
    if (energy[c] > 0.0 && energy[c] <= Clipping * energyOfMeans[c])
    {
      rest.col(c).setZero();
      isDropped = true;
    }
  }
  return isDropped;
}

double NormOfDiagonal(const Multigrid& multigrid, const DistributedRows* distributed)
{
  const SparseMatrix& A = multigrid.Matrix();
  MultiVector diagonal(A.rows, 1);
  for (Index row = 0; row < A.rows; ++row)
  {
    diagonal(row, 0) = A.Coefficient(row, row);
  }
  if (distributed)
  {
    distributed->Sum(diagonal);
  }
  return NormsOf(OperatorOf(multigrid), diagonal)[0];
}

/// The start by nested iteration. Columns with NaN start from zero.
MultiVector NestedStart(const Multigrid& multigrid, const MultiVector& load,
  const DistributedRows* distributed, MultiVector* lastStep)
{
  MultiVector start;
  multigrid.NestedIteration(load, start, lastStep);
  const Columns lost = CountNotFinite(start, distributed);
  for (Id c = 0; c < start.cols(); ++c)
  {
    if (lost[c] > 0.0)
    {
      start.col(c).setZero();
    }
  }
  return start;
}

/// The given start if it fits and is finite; otherwise no rows.
MultiVector GivenStart(
  const MultiVector& load, const MultiVector* given, const Eigen::RowVectorXd& scale)
{
  if (given && given->rows() == load.rows() && given->cols() == load.cols())
  {
    MultiVector start = *given * scale.asDiagonal();
    if (start.allFinite())
    {
      return start;
    }
  }
  return {};
}

/// Whether every column is either solved or not determined to the tolerance by the numbers. The
/// test compares the remaining error with the error by rounding of the entries of A.
/// @param isStuck  false: more iterations help where the error by rounding is smaller than the
///   remaining error
bool IsRounding(const Multigrid& multigrid, const DistributedRows* distributed,
  const MultiVector& b, const MultiVector& x, double tolerance, bool isStuck,
  const Projection& project)
{
  constexpr double Relative = 16.0 * std::numeric_limits<double>::epsilon();
  const LinearOperator A = OperatorOf(multigrid);
  MultiVector r;
  A.residual(x, b, r);
  MultiVector error;
  const Columns left = MeasureError(multigrid, project, r, error);
  const MultiVector solution = x + error; // an iteration that breaks down at once leaves x = 0
  SparseMatrix positive = multigrid.Matrix();
  for (double& value : positive.value)
  {
    value = std::abs(value);
  }
  MultiVector rounding;
  Multiply(positive, solution.cwiseAbs(), rounding);
  if (distributed)
  {
    distributed->Sum(rounding);
  }
  rounding.array() *= Relative * error.array().sign();
  const Columns undetermined = MeasureError(multigrid, project, rounding, error);
  MultiVector product;
  A.multiply(solution, product);
  const Columns wanted = tolerance * A.products(solution, product).abs().sqrt();
  const Columns least = isStuck ? wanted : wanted.max(left);
  return (left <= wanted || undetermined > least).all();
}

/// Solves for the part without means, and estimates its errors.
/// @param squaredSpread  of the means that are left out
/// @param scale          of the columns of the load
PoissonSolution SolveWithoutMeans(const SpaceLevels& space, const Multigrid& multigrid,
  const MultiVector& load, const Columns& squaredSpread, const Eigen::RowVectorXd& scale,
  const PoissonOptions& options, const Projection& project, const Progress& progress)
{
  SolveOptions solve = options.solve;
  if (options.accuracy > 0.0 && solve.tolerance == 0.0)
  {
    solve.tolerance = RoundingTolerance;
  }
  std::optional<AccuracyWatch> watch;
  PoissonSolution solution;
  solution.coefficients = GivenStart(load, options.start, scale);
  const bool isWatched = options.accuracy > 0.0 || options.estimateErrors;
  if (isWatched || solution.coefficients.rows() == 0)
  {
    MultiVector lastStep;
    MultiVector nested =
      NestedStart(multigrid, load, space.Distributed(0), isWatched ? &lastStep : nullptr);
    project.solution(nested);
    if (solution.coefficients.rows() == 0)
    {
      solution.coefficients = nested;
    }
    if (isWatched)
    {
      watch.emplace(
        space, std::move(nested), lastStep, options.accuracy, multigrid.Options().threads);
      solve.measureBy = [&watch](const Iterate& iterate) { return (*watch)(iterate); };
    }
  }
  project.solution(solution.coefficients);
  if (options.solve.maximumIterations == 0)
  {
    return solution;
  }
  solution.report = SolveWithFallback(options.iteration, OperatorOf(multigrid),
    CycleWithFallback(multigrid), load, solution.coefficients, solve, project, progress);
  if (!solution.report.converged &&
      IsRounding(multigrid, space.Distributed(0), load, solution.coefficients, solve.tolerance,
        solution.report.end != SolveEnd::IterationLimit, project))
  {
    solution.isAtRounding = true;
    solution.report.end = SolveEnd::Stagnation;
  }
  if (watch)
  {
    const Columns rest = space.SquaredNorms(solution.coefficients, multigrid.Options().threads);
    solution.accuracy = watch->Result(
      solution.coefficients, (rest.max(0.0) + squaredSpread).sqrt(), scale, ErrorOrder::Second);
  }
  return solution;
}

} // namespace

PoissonSolution SolvePoisson(const SpaceLevels& space, const Multigrid& multigrid,
  const MultiVector& values, const MultiVector& gradients, const PoissonOptions& options,
  const Progress& progress)
{
  CheckInput(space, values, gradients, options);
  const double lambda = options.screeningWeight;
  const int threads = multigrid.Options().threads;
  const Components components = space.ComponentsOf(0, threads);
  const DistributedRows* const distributed = space.Distributed(0);
  const ComponentMeans means(
    components.ofFunction, space.Integrals(), components.count, threads, distributed);
  const LinearOperator A = OperatorOf(multigrid);

  // λM + L maps functions of zero mean to vectors of zero sum, and constants to M times constants.
  // The two parts of the equation can therefore be solved separately.
  const auto removeMeans = [&means](MultiVector& coefficients)
  { means.AddConstants(-means.OfFunction(coefficients), coefficients); };
  const auto removeSums = [&means](MultiVector& load)
  { means.SubtractIntegrals(means.OfIntegrals(load), load); };

  const Eigen::RowVectorXd scale = ScalesOf(values, gradients, distributed);
  MultiVector rest = values * scale.asDiagonal();
  Eigen::RowVectorXd size = lambda * NormsOf(A, rest);
  const MultiVector meanOfField = means.OfIntegrals(rest);
  means.SubtractIntegrals(meanOfField, rest);
  rest *= lambda;
  if (meanOfField.rows() > 0)
  {
    // The constants cancel to rounding in every row, both in the matrix and in ∫ <∇f, ∇b_i>.
    size += NormOfDiagonal(multigrid, distributed) * meanOfField.cwiseAbs().colwise().maxCoeff();
  }
  if (gradients.cols() != 0)
  {
    const MultiVector scaled = gradients * scale.asDiagonal();
    rest += scaled;
    size += NormsOf(A, scaled);
  }
  RequireInRange(size);
  // ∫ <s, ∇b_i> sums to 0 over a component up to rounding, which a small λ would amplify.
  removeSums(rest);
  DropRounding(A, size, rest);

  const Projection project{ removeMeans, removeSums };
  const auto solve = [&]
  {
    return SolveWithoutMeans(
      space, multigrid, rest, means.SquaredSpread(meanOfField), scale, options, project, progress);
  };
  PoissonSolution solution = solve();
  const bool isIterated = options.solve.maximumIterations > 0;
  if (isIterated && !solution.report.converged &&
      DropCanceled(
        multigrid, project, EnergyOfMeans(A, lambda, means, values * scale.asDiagonal()), rest))
  {
    solution = solve();
  }
  means.AddConstants(meanOfField, solution.coefficients);
  RemoveScales(scale, solution.coefficients, solution.report, distributed);
  return solution;
}

} // namespace gridfem
