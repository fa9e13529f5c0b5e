#include "Equations/PointConstraints.h"

#include "Base/Errors.h"
#include "Base/Parallel.h"
#include "Equations/ColumnScales.h"
#include "Spaces/PointComponents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>

namespace gridfem
{
namespace
{

/// Adds up the parts of a vector over the processes.
void SumParts(const DistributedRows* distributed, std::vector<double>& x)
{
  if (distributed)
  {
    distributed->Sum(Eigen::Map<MultiVector>(x.data(), static_cast<Id>(x.size()), 1));
  }
}

/// For each function, the sum of some entries of the rows.
template<class Entry>
std::vector<double> SumsAtFunctions(
  const HeldRows& rows, const DistributedRows* distributed, Entry&& entry)
{
  std::vector<double> sum(rows.columns, 0.0);
  for (Index row = 0; row < rows.rows; ++row)
  {
    for (Id k = rows.rowBegin[row]; k < rows.rowBegin[row + 1]; ++k)
    {
      sum[rows.column[k]] += entry(row, rows.value[k]);
    }
  }
  SumParts(distributed, sum);
  return sum;
}

/// The sum of numbers of the functions, times their values at a place.
double AtPlace(const SparseMatrix& rows, Index row, const std::vector<double>& ofFunction)
{
  double sum = 0.0;
  for (Id k = rows.rowBegin[row]; k < rows.rowBegin[row + 1]; ++k)
  {
    sum += rows.value[k] * ofFunction[rows.column[k]];
  }
  return sum;
}

/// Penalties of the constraints. They are relative to the diagonal at a point's functions, and
/// divided among the constraints that share functions. Pulls keep a step from reducing the misfit,
/// so they count, too. With more than 30 times the pulls, points that are denser than functions
/// take up to three times the iterations.
/// @param unitOfPull  the weight of a pull of 1
std::vector<double> WeightsOfRows(const HeldRows& rows, const SparseMatrix& A, double penalty,
  double unitOfPull, const DistributedRows* distributed)
{
  constexpr double MostTimesPull = 30.0;
  std::vector<double> weight(rows.rows, 0.0);
  for (Index row = 0; row < rows.rows; ++row)
  {
    weight[row] = rows.IsPulled(row) ? rows.pull[row] * unitOfPull : 0.0;
  }
  const std::vector<double> pulled = SumsAtFunctions(
    rows, distributed, [&](Index row, double value) { return value * value * weight[row]; });
  const std::vector<double> touched = SumsAtFunctions(
    rows, distributed, [&](Index row, double value) { return rows.IsPulled(row) ? 0.0 : value; });
  std::vector<double> diagonal = A.Diagonal();
  SumParts(distributed, diagonal);
  for (Index row = 0; row < rows.rows; ++row)
  {
    if (!rows.IsPulled(row))
    {
      const double own = penalty * AtPlace(rows, row, diagonal) +
                         std::min(penalty, MostTimesPull) * AtPlace(rows, row, pulled);
      weight[row] = own / std::max(1.0, AtPlace(rows, row, touched));
    }
  }
  return weight;
}

void CheckShapes(const SpaceLevels& space, const ConstrainedHierarchy& hierarchy,
  const MultiVector& load, const MultiVector& values)
{
  if (values.rows() != hierarchy.Rows().rows ||
      (load.rows() != 0 &&
        (load.rows() != static_cast<Id>(space.Integrals().size()) || load.cols() != values.cols())))
  {
    throw InvalidInput("There are " + std::to_string(values.rows()) + " values for " +
                       std::to_string(hierarchy.Rows().rows) + " constraints, and a load of " +
                       std::to_string(load.rows()) + " rows.");
  }
}

/// The largest magnitude in each column. NaN where a column has one.
Eigen::RowVectorXd LargestOfColumns(const MultiVector& rows)
{
  Eigen::RowVectorXd largest = Eigen::RowVectorXd::Zero(rows.cols());
  for (Id column = 0; column < rows.cols() && rows.rows() > 0; ++column)
  {
    largest[column] = rows.col(column).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  }
  return largest;
}

/// The steps of the augmented Lagrangian, for a problem whose values are about 1.
class ConstrainedIteration
{
public:
  ConstrainedIteration(const SpaceLevels& space, const ConstrainedHierarchy& hierarchy,
    const MultiVector& load, const MultiVector& values, const SolveOptions& options,
    const Projection& project)
    : space_(space), distributed_(space.Distributed(0)), hierarchy_(hierarchy), values_(values),
      options_(options), project_(project), load_(load)
  {
    load_ += this->LoadOf(values_);
    range_ = this->LargestOf(values_);
  }

  /// @return whether another step may help
  bool Step(
    const ConstraintOptions& constraints, const Progress& progress, ConstrainedSolution& solution)
  {
    SolveOptions step = options_;
    step.tolerance = std::max(SmallestTolerance, step.tolerance * share_);
    const Multigrid& multigrid = hierarchy_.GetMultigrid();
    const bool isFirst = solution.steps == 0;
    if (isFirst || constraints.estimateOn)
    {
      this->Start(isFirst, constraints.estimateOn);
    }
    if (watch_)
    {
      step.measureBy = [this](const Iterate& iterate) { return (*watch_)(iterate); };
    }
    Append(SolveWithFallback(IterationType::ConjugateGradients, OperatorOf(multigrid),
             CycleWithFallback(multigrid), load_, x, step, project_, progress),
      solution.report);
    ++solution.steps;
    MultiVector atPoints;
    Multiply(hierarchy_.Rows(), x, atPoints, multigrid.Options().threads);
    const MultiVector rest = this->Misfits(atPoints);
    misfit = this->LargestOf(rest);
    const double before = solution.relativeMisfit;
    solution.relativeMisfit = this->Relative(misfit);
    solution.isExact = solution.relativeMisfit <= constraints.tolerance;
    const bool isBetter = solution.steps < 3 || solution.relativeMisfit < 0.7 * before;
    if (!solution.report.converged || solution.isExact || !isBetter)
    {
      return false;
    }
    load_ += this->LoadOf(rest);
    // The next step starts near its solution, so its tolerance is on the last digits, as the misfit
    // requires. A misfit that falls slowly needs no smaller tolerance: there are more constraints
    // than functions can meet.
    share_ *= solution.steps == 1 || solution.relativeMisfit < 0.1 * before ? 0.1 : 1.0;
    return true;
  }

  /// @param size, scale  as in AccuracyWatch::Result
  SolutionAccuracy Accuracy(const Columns& size, const Eigen::RowVectorXd& scale) const
  {
    return watch_ ? watch_->Result(x, size, scale, ErrorOrder::Observed) : SolutionAccuracy();
  }

  MultiVector x;
  Eigen::RowVectorXd misfit; // largest misfit of each column

private:
  static constexpr double SmallestTolerance = 1e-13;

  /// Solves on the coarser levels for the load of the step. Their solution meets the values nearly
  /// as well. It serves as a start and for the estimate of an error.
  void Start(bool isStart, const SpaceLevels* estimateOn)
  {
    const Multigrid& multigrid = hierarchy_.GetMultigrid();
    MultiVector nested;
    MultiVector lastStep;
    multigrid.NestedIteration(load_, nested, estimateOn ? &lastStep : nullptr);
    if ((CountNotFinite(nested, distributed_) > 0.0).any())
    {
      nested.setZero();
    }
    if (project_.solution)
    {
      project_.solution(nested);
    }
    if (isStart)
    {
      x = nested;
    }
    if (estimateOn)
    {
      watch_.emplace(*estimateOn, std::move(nested), lastStep, 0.0, multigrid.Options().threads);
    }
  }

  MultiVector LoadOf(const MultiVector& values) const
  {
    MultiVector load =
      hierarchy_.Penalty().LoadOf(values, hierarchy_.GetMultigrid().Options().threads);
    if (distributed_)
    {
      distributed_->Sum(load);
    }
    return load;
  }

  Eigen::RowVectorXd LargestOf(const MultiVector& rows) const
  {
    const Eigen::RowVectorXd largest = LargestOfColumns(rows);
    return distributed_ ? LargestOfColumns(distributed_->Gather(largest)) : largest;
  }

  double Relative(const Eigen::RowVectorXd& misfits) const
  {
    const auto& integrals = space_.Integrals();
    std::array<double, 1> total = { std::accumulate(
      integrals.begin() + GhostRows(distributed_), integrals.end(), 0.0) };
    SumOverProcesses(distributed_, total);
    const double area = total[0];
    const Columns squares = space_.SquaredNorms(x, hierarchy_.GetMultigrid().Options().threads);
    double relative = 0.0;
    for (Id c = 0; c < misfits.size(); ++c)
    {
      const double size = area > 0.0 ? std::sqrt(std::max(0.0, squares[c]) / area) : 0.0;
      const double range = std::max(range_[c], size);
      relative = LargerOrUnknown(relative, range > 0.0 ? misfits[c] / range : misfits[c]);
    }
    return relative;
  }

  /// The misfits of rows that are held and that functions reach; 0 at others.
  MultiVector Misfits(const MultiVector& atPoints) const
  {
    MultiVector rest = values_ - atPoints;
    const SparseMatrix& rows = hierarchy_.Rows();
    for (Index row = 0; row < rows.rows; ++row)
    {
      if (rows.rowBegin[row] == rows.rowBegin[row + 1] || hierarchy_.IsPulled(row))
      {
        rest.row(row).setZero();
      }
    }
    return rest;
  }

  const SpaceLevels& space_;
  const DistributedRows* distributed_;
  const ConstrainedHierarchy& hierarchy_;
  const MultiVector& values_;
  const SolveOptions& options_;
  const Projection& project_;
  MultiVector load_;
  Eigen::RowVectorXd range_;
  double share_ = 1.0;                 // of the tolerance, in a step
  std::optional<AccuracyWatch> watch_; // of the last step
};

} // namespace

Columns SizeOfSolution(const SpaceLevels& surface, const Components& components,
  const std::vector<char>& isHeld, const MultiVector& rest, const MultiVector& constant,
  int threads)
{
  std::vector<double> integral = surface.Integrals();
  for (std::size_t i = 0; i < integral.size(); ++i)
  {
    integral[i] = isHeld[components.ofFunction[i]] ? integral[i] : 0.0;
  }
  const ComponentMeans means(
    components.ofFunction, integral, components.count, threads, surface.Distributed(0));
  const MultiVector mean = means.OfFunction(rest);
  MultiVector centered = rest;
  means.AddConstants(-mean, centered);
  return (surface.SquaredNorms(centered, threads).max(0.0) + means.SquaredSpread(mean + constant))
    .sqrt();
}

FreeConstants::FreeConstants(const Components& components, const std::vector<char>& isHeld,
  int threads, const DistributedRows* distributed)
  : isHeld_(isHeld), one_(components.ofFunction.size(), 1.0),
    means_(components.ofFunction, one_, components.count, threads, distributed)
{
}

Projection FreeConstants::AsProjection() const
{
  if (std::all_of(isHeld_.begin(), isHeld_.end(), [](char held) { return held; }))
  {
    return {};
  }
  return { [this](MultiVector& x)
    { means_.AddConstants(-MeansOfFree(isHeld_, means_.OfFunction(x)), x); },
    [this](MultiVector& b)
    { means_.SubtractIntegrals(MeansOfFree(isHeld_, means_.OfIntegrals(b)), b); } };
}

MultiVector MeansOfFree(const std::vector<char>& isHeld, MultiVector means)
{
  for (Id c = 0; c < means.rows(); ++c)
  {
    if (isHeld[c])
    {
      means.row(c).setZero();
    }
  }
  return means;
}

ConstrainedHierarchy::ConstrainedHierarchy(const SpaceLevels& space, double a, double b,
  HeldRows rows, double penalty, const MultigridOptions& options, const Progress& progress)
  : multigrid_(
      this->BuildLevels(space, a, b, std::move(rows), penalty, options, progress.Part(0.0, 0.5)),
      options)
{
  progress.Check(1.0);
}

std::vector<MultigridLevel> ConstrainedHierarchy::BuildLevels(const SpaceLevels& space, double a,
  double b, HeldRows rows, double penalty, const MultigridOptions& options,
  const Progress& progress)
{
  std::vector<MultigridLevel> levels = BuildMultigridLevels(space, a, b, options, progress);
  const DistributedRows* const distributed = space.Distributed(0);
  std::vector<double> weight = WeightsOfRows(rows, levels.front().A, penalty, a + b, distributed);
  pull_ = std::move(rows.pull);
  penalty_ = RowPenalty(space, std::move(rows), std::move(weight), options.threads);
  for (std::size_t l = 0; l < levels.size(); ++l)
  {
    if (distributed && !space.Distributed(l))
    {
      penalty_.AddSumTo(l, 1.0, *distributed, levels[l].A, options.threads);
      continue;
    }
    penalty_.AddTo(l, 1.0, levels[l].A, options.threads);
    if (distributed) // terms across borders of processes are made from the matrix
    {
      levels[l].distributed = space.Divide(l, levels[l].A, options);
    }
  }
  return levels;
}

std::vector<char> HeldComponents(
  const SpaceLevels& space, double a, const SparseMatrix& rows, const Components& components)
{
  std::vector<double> holders(components.count, 0.0); // number of holders in this process
  for (const Index function : rows.column)
  {
    holders[components.ofFunction[function]] += 1.0;
  }
  for (std::size_t i = 0; a > 0.0 && i < components.ofFunction.size(); ++i)
  {
    holders[components.ofFunction[i]] += space.Integrals()[i] > 0.0 ? 1.0 : 0.0;
  }
  SumOverProcesses(space.Distributed(0), holders);
  std::vector<char> isHeld(holders.size());
  std::transform(
    holders.begin(), holders.end(), isHeld.begin(), [](double count) { return count > 0.0; });
  return isHeld;
}

MultiVector ConstantsOf(const SpaceLevels& space, double a, const MultiVector& load,
  const std::vector<Index>& componentOfRow, const MultiVector& values, const Components& components)
{
  MultiVector constant = MultiVector::Zero(components.count, values.cols());
  Eigen::ArrayXd count = Eigen::ArrayXd::Zero(components.count);
  for (Id row = 0; row < values.rows(); ++row)
  {
    if (componentOfRow[row] >= 0)
    {
      constant.row(componentOfRow[row]) += values.row(row);
      count[componentOfRow[row]] += 1.0;
    }
  }
  MultiVector sum = MultiVector::Zero(components.count, values.cols());
  Eigen::ArrayXd mass = Eigen::ArrayXd::Zero(components.count);
  const DistributedRows* const distributed = space.Distributed(0);
  for (Id i = GhostRows(distributed); i < load.rows(); ++i)
  {
    sum.row(components.ofFunction[i]) += load.row(i);
    mass[components.ofFunction[i]] += a * space.Integrals()[i];
  }
  SumOverProcesses(distributed, constant);
  SumOverProcesses(distributed, count);
  SumOverProcesses(distributed, sum);
  SumOverProcesses(distributed, mass);
  for (Index c = 0; c < components.count; ++c)
  {
    const double size = count[c] > 0.0 ? count[c] : mass[c];
    constant.row(c) = (count[c] > 0.0 ? constant : sum).row(c) * (size > 0.0 ? 1.0 / size : 0.0);
  }
  return constant;
}

ConstrainedSolution SolveConstrained(const SpaceLevels& space, double a,
  const ConstrainedHierarchy& hierarchy, const MultiVector& load, const MultiVector& values,
  const ConstraintOptions& constraints, const SolveOptions& options, const Progress& progress)
{
  CheckShapes(space, hierarchy, load, values);
  const int threads = hierarchy.GetMultigrid().Options().threads;
  const Components components = space.ComponentsOf(0, threads);
  const std::vector<Index> componentOfRow = ComponentsOfRows(hierarchy.Rows(), components);
  ConstrainedSolution solution;
  solution.isHeld = HeldComponents(space, a, hierarchy.Rows(), components);
  const DistributedRows* const distributed = space.Distributed(0);
  const FreeConstants free(components, solution.isHeld, threads, distributed);
  const Projection project = free.AsProjection();

  // Constants are solved for directly, so that tolerances apply to the deviation from them.
  const MultiVector constant = ConstantsOf(space, a, load, componentOfRow, values, components);
  MultiVector rest =
    load.rows() > 0
      ? load
      : MultiVector(MultiVector::Zero(static_cast<Id>(space.Integrals().size()), values.cols()));
  for (Id i = 0; a > 0.0 && i < rest.rows(); ++i)
  {
    rest.row(i) -= a * space.Integrals()[i] * constant.row(components.ofFunction[i]);
  }
  MultiVector wanted = values;
  SubtractConstants(constant, componentOfRow, wanted);
  const Eigen::RowVectorXd scale = ScalesOf(rest, wanted, distributed);
  rest *= scale.asDiagonal();
  wanted *= scale.asDiagonal();
  if (project.residual)
  {
    project.residual(rest);
  }

  ConstrainedIteration iteration(space, hierarchy, rest, wanted, options, project);
  while (
    iteration.Step(constraints, progress, solution) && solution.steps < constraints.maximumSteps)
  {
  }
  if (constraints.estimateOn)
  {
    solution.accuracy =
      iteration.Accuracy(SizeOfSolution(*constraints.estimateOn, components, solution.isHeld,
                           iteration.x, constant * scale.asDiagonal(), threads),
        scale);
  }
  solution.misfit = iteration.misfit.size() > 0
                      ? (iteration.misfit.array() / scale.array()).maxCoeff<Eigen::PropagateNaN>()
                      : 0.0;
  solution.coefficients = std::move(iteration.x);
  RemoveScales(scale, solution.coefficients, solution.report, distributed);
  for (Id i = 0; i < solution.coefficients.rows(); ++i)
  {
    const Index own = components.ofFunction[i];
    if (solution.isHeld[own])
    {
      solution.coefficients.row(i) += constant.row(own);
    }
  }
  return solution;
}

void SetMeans(const SpaceLevels& space, const std::vector<char>& isHeld, const MultiVector& means,
  MultiVector& coefficients, int threads)
{
  const Components components = space.ComponentsOf(0, threads);
  const ComponentMeans ofSpace(
    components.ofFunction, space.Integrals(), components.count, threads, space.Distributed(0));
  ofSpace.AddConstants(MeansOfFree(isHeld, means - ofSpace.OfFunction(coefficients)), coefficients);
}

} // namespace gridfem
