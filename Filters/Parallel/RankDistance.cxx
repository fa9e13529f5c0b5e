#include "Parallel/RankDistance.h"

#include "Distance/StraightDistance.h"
#include "Equations/Poisson.h"
#include "Parallel/HeldPoints.h"
#include "Spaces/PointComponents.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace gridfem
{

namespace
{

/// Mean spacing of the functions of all ranks.
double MeanSpacing(const RankLevels& levels, int threads)
{
  const RankSpace& space = levels.Space();
  std::array<double, 2> sums{ 0.0, 0.0 };
  space.Ranks().Together(
    [&]
    {
      sums =
        SpacingSums(space.Own().Matrix(0, 1.0, 0.0, threads), space.Own().EmbeddingOfMesh(threads));
    });
  space.Ranks().Sum(sums.data(), 2);
  return std::sqrt(sums[0] / sums[1]);
}

/// Σ b_i(source), complete in all rows.
MultiVector LoadOfRows(const RankLevels& levels, const SparseMatrix& rows)
{
  MultiVector load;
  levels.Space().Ranks().Together(
    [&]
    {
      load = MultiVector::Zero(rows.columns, 1);
      for (std::size_t k = 0; k < rows.column.size(); ++k)
      {
        load(rows.column[k], 0) += rows.value[k];
      }
    });
  levels.Distributed(0)->Sum(load);
  return load;
}

} // namespace

RankDistance::RankDistance(const RankLevels& levels, std::shared_ptr<const TriangleMesh> mesh,
  const DistanceOptions& options, const Job& job)
  : levels_(levels), mesh_(std::move(mesh)), options_(options)
{
  if (!(options_.smoothing > 0.0) || options_.smoothing >= MostSmoothing)
  {
    throw InvalidInput("The smoothing is " + std::to_string(options_.smoothing) +
                       "; on several ranks it must be a number above 0 and below " +
                       std::to_string(MostSmoothing) + ".");
  }
  const double time = std::pow(options_.smoothing * MeanSpacing(levels_, job.threads), 2);
  heat_ =
    std::make_unique<RankHeat>(levels_.OfGrid(), time, options_.heatChange, job.Part(0.0, 0.3));
  levels_.Space().Ranks().Guard(
    [&]
    {
      poisson_ = std::make_unique<Multigrid>(
        BuildMultigrid(levels_, 0.0, 1.0, options_.multigrid, job.progress.Part(0.3, 0.9)));
    });
  components_ = levels_.ComponentsOf(0, job.threads);
  component_ = ComponentsOfPoints(levels_, components_, job.threads);
}

/// Marks the sources, including points at the place of another rank's source.
std::vector<char> RankDistance::MarkSources(const std::vector<Id>& sources) const
{
  const RankSpace& space = levels_.Space();
  MultiVector count;
  space.Ranks().Together(
    [&]
    {
      count = MultiVector::Zero(static_cast<Id>(mesh_->points.size()), 1);
      for (const Id source : sources)
      {
        count(source, 0) = 1.0;
      }
    });
  double any = count.sum();
  space.Ranks().Maximum(&any, 1);
  if (any == 0.0)
  {
    throw InvalidInput("There are no sources for the distance.");
  }
  space.SumAtPoints(count);
  std::vector<char> isSource(mesh_->points.size());
  for (std::size_t k = 0; k < isSource.size(); ++k)
  {
    isSource[k] = count(static_cast<Id>(k), 0) > 0.0;
  }
  return isSource;
}

/// The distance through space from the sources of all ranks.
std::vector<double> RankDistance::StraightDistances(
  const std::vector<char>& isSource, int threads) const
{
  const Communicator& ranks = levels_.Space().Ranks();
  std::vector<std::array<double, 6>> own; // the ends of segments
  ranks.Together(
    [&]
    {
      for (const auto& [a, b] : RimOfSources(*mesh_, isSource, threads))
      {
        own.push_back({ a[0], a[1], a[2], b[0], b[1], b[2] });
      }
    });
  const std::vector<std::array<double, 6>> all = ranks.Gather(own);
  std::vector<double> straight;
  ranks.Together(
    [&]
    {
      std::vector<Segment> rim;
      for (const std::array<double, 6>& ends : all)
      {
        rim.push_back({ Vec3(ends[0], ends[1], ends[2]), Vec3(ends[3], ends[4], ends[5]) });
      }
      straight = DistancesThroughSpace(*mesh_, std::move(rim), threads);
    });
  return straight;
}

MultiVector RankDistance::LoadOfDistance(
  const MultiVector& heat, const std::vector<char>& isSource) const
{
  Field away;
  levels_.Space().Ranks().Together([&] { away = AwayFromSources(*mesh_, isSource); });
  return levels_.LoadOfDirections(heat, away, options_.multigrid.threads);
}

/// The mean over the sources of each component; NaN if it has none.
/// @param rows  values of functions at the sources that this rank evaluates
std::vector<double> RankDistance::ZeroesAt(
  const SparseMatrix& rows, const MultiVector& distance) const
{
  const std::vector<Index> component = ComponentsOfRows(rows, components_);
  std::vector<double> sum(components_.count, 0.0);
  std::vector<double> count(components_.count, 0.0);
  for (Index row = 0; row < rows.rows; ++row)
  {
    if (component[row] < 0)
    {
      continue;
    }
    for (Id k = rows.rowBegin[row]; k < rows.rowBegin[row + 1]; ++k)
    {
      sum[component[row]] += rows.value[k] * distance(rows.column[k], 0);
    }
    count[component[row]] += 1.0;
  }
  SumOverProcesses(levels_.Distributed(0), sum);
  SumOverProcesses(levels_.Distributed(0), count);
  for (std::size_t c = 0; c < sum.size(); ++c)
  {
    sum[c] = count[c] > 0.0 ? sum[c] / count[c] : std::numeric_limits<double>::quiet_NaN();
  }
  return sum;
}

DistanceField RankDistance::From(
  const std::vector<Id>& sources, const SolveOptions& solve, const Job& job) const
{
  SourceMarks marks{ this->MarkSources(sources), {} };
  marks.straight = this->StraightDistances(marks.isSource, job.threads);
  const MultiVector zeroes = MultiVector::Zero(static_cast<Id>(sources.size()), 1);
  const HeldValues onGrid = HoldPoints(levels_.OfGrid(), sources, zeroes);
  const HeldValues held = levels_.Hats() ? HoldPoints(levels_, sources, zeroes) : onGrid;
  const HeatField heat = heat_->From(LoadOfRows(levels_.OfGrid(), onGrid.rows), job.Part(0.0, 0.5));
  const MultiVector load = this->LoadOfDistance(heat.coefficients, marks.isSource);
  const PoissonOptions options{ { options_.multigrid, solve }, 0.0 };
  PoissonSolution solution = SolvePoisson(levels_, *poisson_, MultiVector::Zero(load.rows(), 1),
    load, options, job.progress.Part(0.5, 0.95));
  DistanceField field;
  field.heatConverged = heat.converged;
  field.heatSweeps = heat.sweeps;
  field.unreached = heat.unreached;
  std::vector<double> ranksWithCold = { double(
    IsNegativeAnywhere(levels_.OfGrid().ValuesAtPoints(heat.coefficients))) };
  SumOverProcesses(levels_.Distributed(0), ranksWithCold);
  field.heatOscillates = ranksWithCold[0] > 0.0;
  field.accuracy.algebraic = solution.accuracy.algebraic;
  field.report = std::move(solution.report);
  field.report.converged = field.report.converged && field.heatConverged && field.unreached == 0;
  const std::vector<double> zero = this->ZeroesAt(held.rows, solution.coefficients);
  const MultiVector value = levels_.ValuesAtPoints(solution.coefficients);
  field.atPoints = ShiftedToZero(value, component_, zero, marks);
  return field;
}

} // namespace gridfem
