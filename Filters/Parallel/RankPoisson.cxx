#include "Parallel/RankPoisson.h"

#include "Parallel/RankLevels.h"

#include <string>

namespace gridfem
{

namespace
{

/// Collective. Rows that several ranks hold become whole.
MultiVector SumOfRanks(
  const RankSpace& space, const DividedRows& rows, const MultiVector& parts, const char* name)
{
  MultiVector whole;
  space.Ranks().Together(
    [&]
    {
      if (!parts.allFinite())
      {
        throw InvalidInput("The " + std::string(name) + " are not all finite numbers.");
      }
      whole = parts;
    });
  rows.Sum(whole);
  return whole;
}

PoissonSolution OfNothing(Id columns)
{
  PoissonSolution solution;
  solution.coefficients = MultiVector::Zero(0, columns);
  solution.report.converged = true;
  solution.report.end = SolveEnd::Converged;
  return solution;
}

} // namespace

PoissonSolution SolvePoisson(const RankSpace& space, const MultiVector& values,
  const MultiVector& gradients, const PoissonOptions& options, const Progress& progress)
{
  const Communicator& ranks = space.Ranks();
  const Progress together = OfAllRanks(ranks, progress);
  if (space.Numberings().front().total == 0)
  {
    return OfNothing(values.cols());
  }
  const RankLevels levels(space);
  const MultiVector ofValues = SumOfRanks(space, *levels.Divided(0), values, "values");
  MultiVector ofGradients;
  if (gradients.cols() > 0)
  {
    ofGradients = SumOfRanks(space, *levels.Divided(0), gradients, "gradients");
  }
  std::vector<MultigridLevel> hierarchy = BuildMultigridLevels(
    levels, options.screeningWeight, 1.0, options.multigrid, together.Part(0.0, 0.3));
  std::unique_ptr<const Multigrid> multigrid;
  ranks.Guard(
    [&] { multigrid = std::make_unique<Multigrid>(std::move(hierarchy), options.multigrid); });
  PoissonOptions own = options;
  own.start = nullptr;
  PoissonSolution solution =
    SolvePoisson(levels, *multigrid, ofValues, ofGradients, own, together.Part(0.3, 1.0));
  ranks.Maximum(&solution.accuracy.largest, 1);
  return solution;
}

} // namespace gridfem
