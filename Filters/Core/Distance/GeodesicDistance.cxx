#include "Distance/GeodesicDistance.h"

#include "Distance/CurveDistance.h"
#include "Distance/NearestSource.h"
#include "Distance/StraightDistance.h"
#include "Equations/Poisson.h"
#include "Grid/TriangleArea.h"
#include "Integrals/TriangleMetric.h"
#include "Spaces/PointComponents.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

namespace gridfem
{
namespace
{

/// Reach of the distance through space around a curve, in √t. At smaller distances, heat on a grid
/// has no reliable direction. At much larger distances, surfaces are not flat.
constexpr double NearReach = 2.9;

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// Mean distance between functions that overlap, in units of length of the space. Pairs are
/// weighted by their overlap ∫ b_i b_j, so that large elements count by their area.
double MeanSpacing(const FiniteElementSpace& space, const Job& job)
{
  const auto [sum, weights] =
    SpacingSums(space.Matrix(0, 1.0, 0.0, job), space.EmbeddingOfMesh(job));
  return std::sqrt(sum / weights);
}

const FiniteElementSpace& HeatSpace(const FiniteElementSpace& space)
{
  const FiniteElementSpace* nested = space.NestedLevels();
  return nested ? *nested : space;
}

/// The coarsest level on which √t is at least half of MostSmoothing. Functions of the next coarser
/// level are twice as far from each other.
std::size_t LevelFor(double smoothing, const FiniteElementSpace& space)
{
  const double coarser = std::floor(std::log2(2.0 * smoothing / MostSmoothing));
  return static_cast<std::size_t>(
    std::clamp(coarser, 0.0, static_cast<double>(space.NumberOfLevels() - 1)));
}

std::vector<char> MarkSources(const std::vector<Id>& sources, std::size_t points)
{
  if (sources.empty())
  {
    throw InvalidInput("There are no sources for the distance.");
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

/// ∫ b_i over the curve.
MultiVector LoadOfCurve(const FiniteElementSpace& space, const SurfaceCurve& curve)
{
  const EdgeSamples samples = space.SamplesOfSegments(curve.segments);
  return IntegrateAlong(samples, MultiVector::Ones(samples.rows.rows, 1));
}

/// 1 on triangles where the distances near a curve are known and have the slope of a distance, else
/// 0. The slope fails where distances come from two parts of the curve, or around a sharp edge.
/// Triangles with a part of the curve always count.
Field NearTriangles(
  const TriangleMesh& mesh, const SurfaceCurve& curve, const std::vector<double>& near)
{
  constexpr double Least = 0.8;
  constexpr double Most = 1.25;
  Field known{ FieldAssociation::Points,
    Eigen::Map<const Eigen::VectorXd>(near.data(), static_cast<Eigen::Index>(near.size())) };
  const Field gradient = GradientsOf(mesh, known);
  Field isNear{ FieldAssociation::Triangles,
    MultiVector::Zero(static_cast<Id>(mesh.triangles.size()), 1) };
  for (Id t = 0; t < isNear.values.rows(); ++t)
  {
    const double slope = gradient.values.row(t).norm(); // NaN beyond the reach
    isNear.values(t, 0) = slope > Least && slope < Most ? 1.0 : 0.0;
  }
  for (const TriangleSegment& segment : curve.segments)
  {
    isNear.values(segment.triangle, 0) = 1.0;
  }
  return isNear;
}

/// Estimates the errors of a distance by comparing it with the distance on functions twice as far
/// from each other.
void CompareDistances(
  const TriangleMesh& mesh, const std::vector<double>& coarser, DistanceField& field)
{
  // Errors fall by this factor plus 1 from depth to depth. On scans they fall by 1.3 to 2. This was
  // measured with three sources on each of eight scans (armadillo, fandisk, genus3, happy buddha,
  // knot, neptune, raptor, turbine), against exact distances.
  constexpr double DifferenceOverError = 0.6;
  double area = 0.0;
  double mean = 0.0;
  double square = 0.0;
  double error = 0.0;
  double largest = 0.0;
  for (Id t = 0; t < static_cast<Id>(mesh.triangles.size()); ++t)
  {
    const double weight = AreaOf(mesh, t) / 3.0;
    for (const Id point : mesh.triangles[t])
    {
      const double distance = field.atPoints[point];
      const double difference = coarser[point] - distance;
      if (std::isfinite(difference))
      {
        area += weight;
        mean += weight * distance;
        square += weight * distance * distance;
        error += weight * difference * difference;
        largest = std::max(largest, std::abs(difference));
      }
    }
  }
  const double variance = area > 0.0 ? square - mean * mean / area : 0.0;
  field.accuracy.discretization =
    variance > 0.0 ? std::sqrt(error / variance) / DifferenceOverError : 0.0;
  field.accuracy.largest = largest / DifferenceOverError;
}

} // namespace

std::array<double, 2> SpacingSums(const SparseMatrix& mass, const MultiVector& place)
{
  std::array<double, 2> sums{ 0.0, 0.0 };
  for (Index i = 0; i < mass.rows; ++i)
  {
    for (Id k = mass.rowBegin[i]; k < mass.rowBegin[i + 1]; ++k)
    {
      const Index j = mass.column[k];
      const double weight = i == j ? 0.0 : std::abs(mass.value[k]);
      sums[0] += weight * (place.row(i) - place.row(j)).squaredNorm();
      sums[1] += weight;
    }
  }
  return sums;
}

Field AwayFromSources(const TriangleMesh& mesh, const std::vector<char>& isSource)
{
  Field away{ FieldAssociation::Triangles,
    MultiVector::Constant(static_cast<Id>(mesh.triangles.size()), 1, -1.0) };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const auto& corner = mesh.triangles[t];
    if (isSource[corner[0]] && isSource[corner[1]] && isSource[corner[2]])
    {
      away.values(static_cast<Id>(t), 0) = 0.0;
    }
  }
  return away;
}

bool IsNegativeAnywhere(const MultiVector& heatAtPoints)
{
  return (heatAtPoints.array() < 0.0).any();
}

std::vector<double> ShiftedToZero(const MultiVector& value, const std::vector<Index>& component,
  const std::vector<double>& zero, const SourceMarks& marks)
{
  std::vector<double> shifted(component.size(), NaN);
  for (std::size_t point = 0; point < component.size(); ++point)
  {
    const Index c = component[point];
    if (c >= 0 && !std::isnan(zero[c]))
    {
      shifted[point] = marks.isSource[point] ? 0.0
                                             : std::max(marks.straight[point],
                                                 value(static_cast<Id>(point), 0) - zero[c]);
    }
  }
  return shifted;
}

DistanceField DistanceMethod::FromCurve(
  const SurfaceCurve& /*curve*/, const SolveOptions& /*solve*/, const Job& /*job*/) const
{
  throw std::logic_error("Several processes find no distances from curves.");
}

GeodesicDistance::GeodesicDistance(std::shared_ptr<const FiniteElementSpace> space,
  std::shared_ptr<const TriangleMesh> mesh, const DistanceOptions& options, const Job& job)
  : space_(std::move(space)), mesh_(std::move(mesh)), options_(options)
{
  if (!(options_.smoothing > 0.0) || std::isinf(options_.smoothing))
  {
    throw InvalidInput(
      "The smoothing is " + std::to_string(options_.smoothing) + "; it must be a number above 0.");
  }
  const FiniteElementSpace& heatSpace = HeatSpace(*space_);
  time_ = std::pow(options_.smoothing * MeanSpacing(heatSpace, job.threads), 2);
  const std::size_t level = LevelFor(options_.smoothing, heatSpace);
  heat_ =
    std::make_unique<DistantHeat>(heatSpace, level, time_, job.Part(0.0, 0.3), options_.heatChange);
  if (options_.estimateErrors && level + 1 < heatSpace.NumberOfLevels())
  {
    coarserHeat_ =
      std::make_unique<DistantHeat>(heatSpace, level + 1, 4.0 * time_, job.Part(0.3, 0.4));
  }
  poisson_ = std::make_unique<Multigrid>(
    BuildMultigrid(*space_, 0.0, 1.0, options_.multigrid, job.progress.Part(0.4, 0.9)));
  component_ =
    ComponentsOfPoints(*space_, space_->ComponentsOf(0, job.Part(0.9, 0.95)), job.Part(0.95, 1.0));
}

/// ∫ <X, ∇b_i>, with X = 0 on triangles that belong to sources.
MultiVector GeodesicDistance::LoadOfDistance(
  const MultiVector& heat, const std::vector<char>& isSource, const Job& job) const
{
  const Field away = AwayFromSources(*mesh_, isSource);
  return space_->LoadOfDirections(heat, &away, job);
}

std::vector<double> GeodesicDistance::ShiftedToSources(const MultiVector& distance,
  const std::vector<Id>& sources, const SourceMarks& marks, const Job& job) const
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
  std::transform(sum.begin(), sum.end(), count.begin(), sum.begin(),
    [](double total, Id of) { return of > 0 ? total / static_cast<double>(of) : NaN; });
  return ShiftedToZero(value, component_, sum, marks);
}

/// ∫ <X, ∇b_i>, where X points away from the curve outside and toward it inside. Near the curve, X
/// is the gradient of the distance through space; farther away, the direction of the heat with the
/// sign of the side.
MultiVector GeodesicDistance::LoadOfSignedDistance(const MultiVector& heat,
  const SurfaceCurve& curve, const std::vector<double>& near, const Job& job) const
{
  const Field isNear = NearTriangles(*mesh_, curve, near);
  Field away{ FieldAssociation::Triangles, MultiVector::Zero(isNear.values.rows(), 1) };
  for (Id t = 0; t < away.values.rows(); ++t)
  {
    const auto& corner = mesh_->triangles[t];
    const int sides = curve.side[corner[0]] + curve.side[corner[1]] + curve.side[corner[2]];
    const int side = sides > 0 ? 1 : sides < 0 ? -1 : 0;
    away.values(t, 0) = isNear.values(t, 0) > 0.0 ? 0.0 : -side;
  }
  Field known{ FieldAssociation::Points, MultiVector(static_cast<Id>(near.size()), 1) };
  std::transform(near.begin(), near.end(), known.values.data(),
    [](double distance) { return std::isnan(distance) ? 0.0 : distance; });
  return space_->LoadOfDirections(heat, &away, job.Part(0.0, 0.5)) +
         space_->LoadOfGradientsOf(known, &isNear, job.Part(0.5, 1.0));
}

/// The mean over the curve on each component; NaN if the curve does not touch it.
std::vector<double> GeodesicDistance::ZeroesOnCurve(
  const MultiVector& distance, const SurfaceCurve& curve) const
{
  const auto last = std::max_element(component_.begin(), component_.end());
  const Index components = last == component_.end() ? 0 : *last + 1;
  std::vector<double> sum(components, 0.0);
  std::vector<double> length(components, 0.0);
  const EdgeSamples samples = space_->SamplesOfSegments(curve.segments);
  for (Index row = 0; row < samples.rows.rows; ++row)
  {
    const Id triangle = curve.segments[samples.edge[row]].triangle;
    const Index component = component_[mesh_->triangles[triangle][0]];
    if (component < 0)
    {
      continue;
    }
    double value = 0.0;
    for (Id k = samples.rows.rowBegin[row]; k < samples.rows.rowBegin[row + 1]; ++k)
    {
      value += samples.rows.value[k] * distance(samples.rows.column[k], 0);
    }
    sum[component] += samples.length[row] * value;
    length[component] += samples.length[row];
  }
  std::transform(sum.begin(), sum.end(), length.begin(), sum.begin(),
    [](double total, double of) { return of > 0.0 ? total / of : NaN; });
  return sum;
}

std::vector<double> GeodesicDistance::ShiftedToCurve(const MultiVector& distance,
  const SurfaceCurve& curve, const std::vector<double>& near, double reach,
  const std::vector<double>& straight, const Job& job) const
{
  const std::vector<double> zero = this->ZeroesOnCurve(distance, curve);
  const MultiVector value = space_->ValuesAtPoints(distance, job);
  std::vector<double> shifted(component_.size(), NaN);
  for (std::size_t point = 0; point < component_.size(); ++point)
  {
    if (component_[point] < 0)
    {
      continue;
    }
    const double solved = value(static_cast<Id>(point), 0) - zero[component_[point]];
    const bool isNear = std::abs(near[point]) < reach; // not NaN either
    const double share = isNear ? 1.0 - std::abs(near[point]) / reach : 0.0;
    const double mixed = isNear ? share * near[point] + (1.0 - share) * solved : solved;
    const auto side = curve.side[point];
    shifted[point] = std::isnan(solved) ? NaN
                     : side > 0         ? std::max(straight[point], mixed)
                     : side < 0         ? std::min(-straight[point], mixed)
                                        : mixed;
  }
  return shifted;
}

/// Solves L φ = load.
/// @return  φ; its report goes into the field
MultiVector GeodesicDistance::Solve(const MultiVector& load, const SolveOptions& solve,
  DistanceField& field, const Progress& progress) const
{
  PoissonOptions options{ { options_.multigrid, solve }, 0.0 };
  options.estimateErrors = options_.estimateErrors;
  PoissonSolution solution =
    SolvePoisson(*space_, *poisson_, MultiVector::Zero(load.rows(), 1), load, options, progress);
  field.accuracy.algebraic = solution.accuracy.algebraic;
  field.report = std::move(solution.report);
  field.report.converged = field.report.converged && field.heatConverged && field.unreached == 0;
  return std::move(solution.coefficients);
}

/// The differences between a distance from points and one from a curve: the source of the heat, the
/// use of its gradient, and the place where the distance is 0.
struct GeodesicDistance::Sources
{
  MultiVector heat; // per function of the space of the heat
  std::function<MultiVector(const MultiVector& heat, const Job& job)> loadOfDistance;
  std::function<std::vector<double>(const MultiVector& distance, const Job& job)> shifted;
};

DistanceField GeodesicDistance::FromAll(
  const Sources& sources, const SolveOptions& solve, const Job& job) const
{
  HeatField heat = heat_->From(sources.heat, job.Part(0.0, 0.45));
  DistanceField field;
  field.heatConverged = heat.converged;
  field.heatSweeps = heat.sweeps;
  field.unreached = heat.unreached;
  field.heatOscillates =
    IsNegativeAnywhere(HeatSpace(*space_).ValuesAtPoints(heat.coefficients, job.threads));
  const MultiVector load = sources.loadOfDistance(heat.coefficients, job.Part(0.45, 0.55));
  const MultiVector distance = this->Solve(load, solve, field, job.progress.Part(0.55, 0.8));
  field.atPoints = sources.shifted(distance, job.Part(0.8, 0.85));
  if (coarserHeat_)
  {
    this->EstimateErrors(sources, field, job.Part(0.85, 1.0));
  }
  return field;
}

/// Computes the distance once more on the next coarser level.
void GeodesicDistance::EstimateErrors(
  const Sources& sources, DistanceField& field, const Job& job) const
{
  const HeatField heat = coarserHeat_->From(sources.heat, job.Part(0.0, 0.4));
  const MultiVector load = sources.loadOfDistance(heat.coefficients, job.Part(0.4, 0.8));
  PoissonOptions options{ { options_.multigrid, {} }, 0.0 };
  options.solve.maximumIterations = 0;
  const PoissonSolution coarser = SolvePoisson(*space_, *poisson_,
    MultiVector::Zero(load.rows(), 1), load, options, job.progress.Part(0.8, 0.9));
  const std::vector<double> atPoints = sources.shifted(coarser.coefficients, job.Part(0.9, 1.0));
  CompareDistances(*mesh_, atPoints, field);
  field.accuracy.isTrusted =
    heat.converged && field.heatConverged && field.unreached == 0 && !field.heatOscillates;
}

DistanceField GeodesicDistance::From(
  const std::vector<Id>& sources, const SolveOptions& solve, const Job& job) const
{
  SourceMarks marks{ MarkSources(sources, mesh_->points.size()), {} };
  marks.straight =
    DistancesThroughSpace(*mesh_, RimOfSources(*mesh_, marks.isSource, job.threads), job.threads);
  return this->FromAll({ LoadOfPoints(HeatSpace(*space_), sources),
                         [&](const MultiVector& heat, const Job& part)
                         { return this->LoadOfDistance(heat, marks.isSource, part); },
                         [&](const MultiVector& distance, const Job& part)
                         { return this->ShiftedToSources(distance, sources, marks, part); } },
    solve, job);
}

DistanceField GeodesicDistance::FromCurve(
  const SurfaceCurve& curve, const SolveOptions& solve, const Job& job) const
{
  if (curve.side.size() != mesh_->points.size() || curve.segments.empty())
  {
    throw InvalidInput("The curve has sides for " + std::to_string(curve.side.size()) +
                       " points of " + std::to_string(mesh_->points.size()) + ", and " +
                       std::to_string(curve.segments.size()) + " segments.");
  }
  const double reach = NearReach * std::sqrt(time_) * space_->UnitLength();
  const std::vector<double> near = DistancesNear(curve, *mesh_, reach, job.threads);
  const std::vector<double> straight =
    DistancesThroughSpace(*mesh_, PiecesOf(curve, *mesh_), job.threads);
  return this->FromAll(
    { LoadOfCurve(HeatSpace(*space_), curve),
      [&](const MultiVector& heat, const Job& part)
      { return this->LoadOfSignedDistance(heat, curve, near, part); },
      [&](const MultiVector& distance, const Job& part)
      { return this->ShiftedToCurve(distance, curve, near, reach, straight, part); } },
    solve, job.Part(0.05, 1.0));
}

} // namespace gridfem
