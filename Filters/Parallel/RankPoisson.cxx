#include "Parallel/RankPoisson.h"

#include "Parallel/RankComponents.h"
#include "Parallel/RankCycle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace gridfem
{

namespace
{

/// Collective. What the ranks add to integrals, at the owners of the functions.
MultiVector SumAtOwners(
  const Communicator& ranks, const LevelVectors& vectors, const MultiVector& parts, Id own)
{
  MultiVector sums;
  std::vector<double> column;
  ranks.Together(
    [&]
    {
      sums.resize(own, parts.cols());
      column.resize(parts.rows());
    });
  const PetscVector sum = vectors.Make();
  for (Id c = 0; c < parts.cols(); ++c)
  {
    Eigen::Map<Eigen::VectorXd>(column.data(), parts.rows()) = parts.col(c);
    vectors.Add(column, sum);
    VectorEntries entries(sum);
    for (Id k = 0; k < own; ++k)
    {
      sums(k, c) = entries[k];
    }
  }
  return sums;
}

/// Collective. Per column, over all ranks.
Eigen::RowVectorXd LargestOf(const Communicator& ranks, const MultiVector& x)
{
  Eigen::RowVectorXd largest = Eigen::RowVectorXd::Zero(x.cols());
  if (x.rows() > 0)
  {
    largest = x.cwiseAbs().colwise().maxCoeff();
  }
  ranks.Maximum(largest.data(), largest.size());
  return largest;
}

/// A projection of blocks as one of PETSc's vectors.
template<class Project>
RankCycle::Projection OnVectors(Id own, Project project)
{
  return [own, project, x = MultiVector(own, 1)](Vec vector) mutable
  {
    VectorEntries entries(vector);
    for (Id k = 0; k < own; ++k)
    {
      x(k, 0) = entries[k];
    }
    project(x);
    for (Id k = 0; k < own; ++k)
    {
      entries[k] = x(k, 0);
    }
  };
}

void RequireFinite(const Communicator& ranks, const MultiVector& load, const char* name)
{
  ranks.Together(
    [&]
    {
      if (!load.allFinite())
      {
        throw InvalidInput("The " + std::string(name) + " are not all finite numbers.");
      }
    });
}

} // namespace

PoissonSolution SolvePoisson(const RankSpace& space, const MultiVector& values,
  const MultiVector& gradients, const RankPoissonOptions& options, const Progress& progress)
{
  const Communicator& ranks = space.Ranks();
  const LevelNumbering& numbering = space.Numberings().front();
  const double lambda = options.screeningWeight;
  if (!(lambda >= 0.0) || std::isinf(lambda))
  {
    throw InvalidInput("The screening weight must be a number of 0 or more.");
  }
  RequireFinite(ranks, values, "values");
  RequireFinite(ranks, gradients, "gradients");
  PoissonSolution solution;
  ranks.Together(
    [&] { solution.coefficients = MultiVector::Zero(numbering.Functions(), values.cols()); });
  solution.report.converged = true;
  solution.report.end = SolveEnd::Converged;
  if (numbering.total == 0)
  {
    return solution;
  }
  RankCycle cycle(space, lambda, 1.0, options.multigrid);
  const LevelVectors& vectors = cycle.Vectors();
  const RankComponents components(
    ranks, numbering, vectors, space.Own().Functions().Finest(), space.Own().Operators().integral);
  ranks.Together([&] { progress.Check(0.3); });

  const Id own = numbering.OwnFunctions();
  MultiVector rest = SumAtOwners(ranks, vectors, values, own);
  const Eigen::RowVectorXd size = lambda * LargestOf(ranks, rest);
  const MultiVector mean = components.OfIntegrals(rest);
  components.SubtractIntegrals(mean, rest);
  rest *= lambda;
  Eigen::RowVectorXd whole = size;
  if (gradients.cols() > 0)
  {
    const MultiVector given = SumAtOwners(ranks, vectors, gradients, own);
    whole += LargestOf(ranks, given);
    rest += given;
  }
  // ∫ <s, ∇b_i> sums to 0 over a component but for rounding, which a small λ would blow up.
  components.SubtractIntegrals(components.OfIntegrals(rest), rest);
  const Eigen::RowVectorXd left = LargestOf(ranks, rest);

  const auto ofSolution =
    OnVectors(own, [&](MultiVector& x) { components.AddConstants(-components.OfFunction(x), x); });
  const auto ofResidual = OnVectors(
    own, [&](MultiVector& r) { components.SubtractIntegrals(components.OfIntegrals(r), r); });
  const PetscVector b = vectors.Make();
  const PetscVector x = vectors.Make();
  std::vector<double> entries;
  ranks.Together([&] { entries.resize(numbering.Functions()); });
  for (Id c = 0; c < rest.cols(); ++c)
  {
    // What is left when the means are taken out can be rounding alone: then it is 0.
    constexpr double Relative = 8.0 * std::numeric_limits<double>::epsilon();
    const double scale = left[c] > Relative * whole[c] ? 1.0 / left[c] : 0.0;
    {
      VectorEntries load(b);
      for (Id k = 0; k < own; ++k)
      {
        load[k] = scale * rest(k, c);
      }
    }
    KeepWorse(cycle.Solve(b, x, options.solve, ofSolution, ofResidual,
                progress.Part(0.3 + 0.7 * double(c) / double(rest.cols()),
                  0.3 + 0.7 * double(c + 1) / double(rest.cols()))),
      solution.report);
    MultiVector column(own, 1);
    {
      VectorEntries found(x);
      for (Id k = 0; k < own; ++k)
      {
        column(k, 0) = scale > 0.0 ? found[k] / scale : 0.0;
      }
    }
    components.AddConstants(mean.col(c), column);
    {
      VectorEntries found(x);
      for (Id k = 0; k < own; ++k)
      {
        found[k] = column(k, 0);
      }
    }
    vectors.Spread(x, entries);
    solution.coefficients.col(c) =
      Eigen::Map<const Eigen::VectorXd>(entries.data(), static_cast<Id>(entries.size()));
  }
  return solution;
}

} // namespace gridfem
