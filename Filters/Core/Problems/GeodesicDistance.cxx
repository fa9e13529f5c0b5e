#include "Problems/GeodesicDistance.h"

#include "Problems/NearestSource.h"
#include "Problems/Poisson.h"
#include "Spaces/PointComponents.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace gridfem
{
namespace
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// How far functions that overlap are from each other, in units of length of the space: a mean over
/// pairs, weighted by their overlap ∫ b_i b_j, so that large elements count as the area they have.
double MeanSpacing(const FiniteElementSpace& space, const Job& job)
{
  const SparseMatrix mass = space.Matrix(0, 1.0, 0.0, job);
  const MultiVector place = space.EmbeddingOfMesh(job);
  double sum = 0.0;
  double weights = 0.0;
  for (Index i = 0; i < mass.rows; ++i)
  {
    for (Id k = mass.rowBegin[i]; k < mass.rowBegin[i + 1]; ++k)
    {
      const Index j = mass.column[k];
      const double weight = i == j ? 0.0 : std::abs(mass.value[k]);
      sum += weight * (place.row(i) - place.row(j)).squaredNorm();
      weights += weight;
    }
  }
  return std::sqrt(sum / weights);
}

const FiniteElementSpace& HeatSpace(const FiniteElementSpace& space)
{
  const FiniteElementSpace* nested = space.NestedLevels();
  return nested ? *nested : space;
}

/// Functions of the next level are twice as far from each other: the coarsest level on which √t is
/// as long as by default on the finest.
std::size_t LevelFor(double smoothing, const FiniteElementSpace& space)
{
  const double coarser = std::floor(std::log2(smoothing / DistanceOptions().smoothing));
  return static_cast<std::size_t>(
    std::clamp(coarser, 0.0, static_cast<double>(space.NumberOfLevels() - 1)));
}

std::vector<char> MarkSources(const std::vector<Id>& sources, std::size_t points)
{
  if (sources.empty())
  {
    throw InvalidInput("There are no sources that distances could start from.");
  }
  RequireSources(sources, points);
  std::vector<char> isSource(points, 0);
  for (const Id source : sources)
  {
    isSource[source] = 1;
  }
  return isSource;
}

/// Σ b_i(source)
MultiVector LoadOfPoints(const FiniteElementSpace& space, const std::vector<Id>& points)
{
  const SparseMatrix rows = space.RowsAtPoints(points);
  MultiVector load = MultiVector::Zero(rows.columns, 1);
  for (std::size_t k = 0; k < rows.column.size(); ++k)
  {
    load(rows.column[k], 0) += rows.value[k];
  }
  return load;
}

} // namespace

GeodesicDistance::GeodesicDistance(std::shared_ptr<const FiniteElementSpace> space,
  std::shared_ptr<const TriangleMesh> mesh, DistanceOptions options, const Job& job)
  : space_(std::move(space)), mesh_(std::move(mesh)), options_(std::move(options))
{
  if (!(options_.smoothing > 0.0) || std::isinf(options_.smoothing))
  {
    throw InvalidInput(
      "The smoothing is " + std::to_string(options_.smoothing) + "; it must be a number above 0.");
  }
  const FiniteElementSpace& heatSpace = HeatSpace(*space_);
  time_ = std::pow(options_.smoothing * MeanSpacing(heatSpace, job.threads), 2);
  heat_ = std::make_unique<DistantHeat>(
    heatSpace, LevelFor(options_.smoothing, heatSpace), time_, job.Part(0.0, 0.4));
  poisson_ = std::make_unique<Multigrid>(
    BuildMultigrid(*space_, 0.0, 1.0, options_.multigrid, job.progress.Part(0.4, 0.9)));
  component_ =
    ComponentsOfPoints(*space_, space_->ComponentsOf(0, job.Part(0.9, 0.95)), job.Part(0.95, 1.0));
}

/// ∫ <X, ∇b_i>; X = 0 on triangles that belong to sources.
MultiVector GeodesicDistance::LoadOfDistance(
  const MultiVector& heat, const std::vector<char>& isSource, const Job& job) const
{
  Field away{ FieldAssociation::Triangles,
    MultiVector::Constant(static_cast<Id>(mesh_->triangles.size()), 1, -1.0) };
  for (std::size_t t = 0; t < mesh_->triangles.size(); ++t)
  {
    const auto& corner = mesh_->triangles[t];
    if (isSource[corner[0]] && isSource[corner[1]] && isSource[corner[2]])
    {
      away.values(static_cast<Id>(t), 0) = 0.0;
    }
  }
  return space_->LoadOfDirections(heat, &away, job);
}

std::vector<double> GeodesicDistance::ShiftedToSources(
  const MultiVector& distance, const std::vector<Id>& sources, const Job& job) const
{
  const MultiVector value = space_->ValuesAtPoints(distance, job);
  const auto last = std::max_element(component_.begin(), component_.end());
  const Index components = last == component_.end() ? 0 : *last + 1;
  std::vector<double> sum(components, 0.0);
  std::vector<Id> count(components, 0);
  for (const Id source : sources)
  {
    if (component_[source] >= 0)
    {
      sum[component_[source]] += value(source, 0);
      ++count[component_[source]];
    }
  }
  std::vector<double> shifted(component_.size(), NaN);
  for (std::size_t point = 0; point < component_.size(); ++point)
  {
    const Index c = component_[point];
    if (c >= 0 && count[c] > 0)
    {
      const double zero = sum[c] / static_cast<double>(count[c]);
      shifted[point] = std::max(0.0, value(static_cast<Id>(point), 0) - zero);
    }
  }
  for (const Id source : sources)
  {
    shifted[source] = component_[source] >= 0 ? 0.0 : NaN;
  }
  return shifted;
}

DistanceField GeodesicDistance::From(
  const std::vector<Id>& sources, const SolveOptions& solve, const Job& job) const
{
  const std::vector<char> isSource = MarkSources(sources, mesh_->points.size());
  DistanceField field;
  const HeatField heat = heat_->From(LoadOfPoints(HeatSpace(*space_), sources), job.Part(0.0, 0.5));
  field.heatConverged = heat.converged;
  field.heatSweeps = heat.sweeps;
  field.unreached = heat.unreached;

  const MultiVector load = this->LoadOfDistance(heat.coefficients, isSource, job.Part(0.5, 0.65));
  PoissonOptions options;
  options.screeningWeight = 0.0;
  options.multigrid = options_.multigrid;
  options.solve = solve;
  PoissonSolution solution = SolvePoisson(*space_, *poisson_, MultiVector::Zero(load.rows(), 1),
    load, options, job.progress.Part(0.65, 0.95));
  field.report = std::move(solution.report);
  field.report.converged = field.report.converged && heat.converged;
  field.atPoints = this->ShiftedToSources(solution.coefficients, sources, job.Part(0.95, 1.0));
  return field;
}

} // namespace gridfem
