#include "Solvers/GaussianFieldSolver.h"

#include "Base/Errors.h"
#include "Distance/NearestSource.h"
#include "Grid/PlaceNumbers.h"
#include "Solvers/SolveOnMesh.h"
#include "Solvers/SolveWarnings.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <numeric>
#include <sstream>
#include <utility>

namespace gridfem
{
namespace
{

/// Samples that are solved together. They fill the lanes of a vector instruction.
constexpr Id SamplesAtOnce = 8;

void RequireSampling(const GaussianFieldSolver::Options& options, bool isObserved)
{
  RequireOptions(options);
  if (options.range == 0.0)
  {
    throw InvalidInput("Range is 0. It must be above 0.");
  }
  if (isObserved && options.standardDeviation == 0.0)
  {
    throw InvalidInput("Standard Deviation is 0. It must be above 0 to predict from observations.");
  }
}

Id NumberOfSamples(const GaussianFieldSolver::Options& options)
{
  return options.statistics && options.numberOfSamples == 1
           ? GaussianFieldSolver::SamplesOfStatistics
           : options.numberOfSamples;
}

/// The memory for samples at all points. The caller copies them.
/// @param kept  bytes of the result that they replace
MemoryNeed NeedOfSamples(Id points, Id samples, double kept)
{
  return { 2.0 * sizeof(double) * double(points) * double(samples) - kept,
    "Number Of Samples " + std::to_string(samples) + " at " + std::to_string(points) + " points",
    "Choose fewer samples, or Statistics." };
}

/// A range below four distances of functions loses 5 % of the variance or more.
std::vector<std::string> WarningsOfResolution(double range, double spacing)
{
  constexpr double Least = 4.0;
  if (range >= Least * spacing)
  {
    return {};
  }
  std::ostringstream text;
  text << "The Range is only " << range / spacing << " times the distance between functions. The "
       << "field is therefore too smooth, and its standard deviation too small. A larger Depth, or "
          "a finer mesh with hat functions, resolves it.";
  return { text.str() };
}

MemoryNeed NeedOfObservations(Id points, Id functions)
{
  return { PointCovariances::EstimateMemory(points, functions),
    "The prediction from " + std::to_string(points) + " observations with " +
      std::to_string(functions) + " basis functions",
    "Choose fewer observations or a smaller Depth." };
}

/// On a component that is small beside the range, the mean of a sample varies too much. At the
/// limit the standard deviation on a sphere is 7 % too large. Predictions do not depend on a
/// constant of the whole field.
std::vector<std::string> WarningsOfSize(
  const std::vector<double>& deviationsOfMeans, bool isPredicted)
{
  constexpr double Most = 0.63; // the range is half the square root of the area
  const auto large = std::count_if(deviationsOfMeans.begin(), deviationsOfMeans.end(),
    [](double deviation) { return !(deviation <= Most); });
  const bool isOne = deviationsOfMeans.size() == 1;
  if (large == 0 || (isOne && isPredicted))
  {
    return {};
  }
  std::ostringstream text;
  text << std::setprecision(3) << "The Range is large beside ";
  if (isOne)
  {
    text << "the surface";
  }
  else
  {
    text << large << " of " << deviationsOfMeans.size() << " connected components";
  }
  text << ". The samples therefore vary by more than Standard Deviation: their mean over "
       << (isOne ? "the surface" : "such a component") << " alone varies by "
       << (isOne ? "" : "up to ")
       << *std::max_element(deviationsOfMeans.begin(), deviationsOfMeans.end())
       << " times Standard Deviation. Choose a Range below half of the square root of the area"
       << (isOne ? "." : ", or leave fragments out with the filter Connectivity.");
  return { text.str() };
}

/// Sums of the samples and of their squares.
struct Sums
{
  Eigen::VectorXd first;
  Eigen::VectorXd second;

  void Add(const MultiVector& samples)
  {
    if (first.size() == 0)
    {
      first.setZero(samples.rows());
      second.setZero(samples.rows());
    }
    first += samples.rowwise().sum();
    second += samples.cwiseAbs2().rowwise().sum();
  }

  /// Mean and standard deviation. The fields have mean 0, so the difference loses no digits.
  MultiVector Statistics(Id samples) const
  {
    MultiVector result(first.size(), 2);
    result.col(0) = first / double(samples);
    const Eigen::ArrayXd squares = second.array() - first.array() * result.col(0).array();
    result.col(1) =
      (squares.isNaN().select(squares, squares.max(0.0)) / double(samples - 1)).sqrt();
    return result;
  }

  /// The standard deviation of samples whose mean is known to be 0.
  Eigen::VectorXd DeviationFromZero(Id samples) const
  {
    return (second.array() / double(samples)).sqrt();
  }
};

/// Removes points that no function reaches.
PointValues Reached(const PointValues& values, const std::vector<char>& isReached)
{
  PointValues reached;
  reached.values.resize(values.values.rows(), values.values.cols());
  for (std::size_t k = 0; k < values.points.size(); ++k)
  {
    if (isReached[values.points[k]])
    {
      reached.values.row(static_cast<Id>(reached.points.size())) =
        values.values.row(static_cast<Id>(k));
      reached.points.push_back(values.points[k]);
    }
  }
  reached.values.conservativeResize(static_cast<Id>(reached.points.size()), Eigen::NoChange);
  return reached;
}

/// Returns the mean of the values of each place at all points there, and NaN at other points.
Eigen::VectorXd MeansAtPlaces(
  const Surface& surface, const std::vector<Id>& points, const Eigen::VectorXd& values)
{
  const std::vector<Vec3>& all = surface.Mesh().points;
  std::vector<Index> placeOf(all.size());
  std::iota(placeOf.begin(), placeOf.end(), Index(0));
  if (surface.AreCoincidentPointsWelded())
  {
    std::vector<Place> places;
    for (const Id point : points)
    {
      places.push_back(PlaceOf(all[point]));
    }
    placeOf = PlaceNumbers(std::move(places)).OfPoints(all, surface.Threads());
  }
  std::vector<double> sum(all.size(), 0.0);
  std::vector<double> count(all.size(), 0.0);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    sum[placeOf[points[k]]] += values[static_cast<Id>(k)];
    count[placeOf[points[k]]] += 1.0;
  }
  Eigen::VectorXd means(static_cast<Id>(all.size()));
  for (std::size_t point = 0; point < all.size(); ++point)
  {
    const Index place = placeOf[point];
    means[static_cast<Id>(point)] = place == PlaceNumbers::None
                                      ? std::numeric_limits<double>::quiet_NaN()
                                      : sum[place] / count[place]; // NaN without a value
  }
  return means;
}

void RequireObservations(const PointValues& observed)
{
  if (observed.values.cols() != 1)
  {
    throw InvalidInput("The observations have " + std::to_string(observed.values.cols()) +
                       " components. Gaussian Field predicts one.");
  }
  if (observed.points.empty())
  {
    throw InvalidInput("No observation is at a point of the surface.");
  }
  if (!observed.values.allFinite())
  {
    throw InvalidInput("There is an observation that is not finite.");
  }
  constexpr Id Most = GaussianFieldSolver::MostObservations;
  if (observed.values.rows() > Most)
  {
    throw InvalidInput("There are " + std::to_string(observed.values.rows()) +
                       " observations. Gaussian Field can use up to " + std::to_string(Most) +
                       ". Choose fewer points by a Mask Array, or put NaN at the others.");
  }
}

/// The standard deviation of errors in the covariance.
double NoiseOf(const GaussianFieldSolver::Options& options)
{
  return std::max(
    options.observationNoise, GaussianFieldSolver::LeastNoise * options.standardDeviation);
}

} // namespace

const GaussianFieldSolver::Result& GaussianFieldSolver::Update(
  Surface& surface, const Input& input, const Options& options, const Job& job)
{
  RequireSampling(options, static_cast<bool>(input.observations));
  surface.Prepare(job.progress.Part(0.0, 0.2));
  RequireFirstDegree(surface.UsedOptions().choice.kind, "Random fields");
  if (!options.statistics)
  {
    surface.Require(NeedOfSamples(static_cast<Id>(surface.Mesh().points.size()),
      options.numberOfSamples, sizeof(double) * double(result_.atPoints.size())));
  }
  this->UpdateField(surface, options, { surface.Threads(), job.progress.Part(0.2, 0.3) });
  this->TakeObservations(surface, input);
  this->UpdateCovariances(surface, { surface.Threads(), job.progress.Part(0.3, 0.6) });
  Stages& stages = surface.GetStages();
  StageKey key = KeyOfOptions(options);
  key.Add(stages.Version(HierarchyStage)).Add(observed_.points);
  for (Id row = 0; row < observed_.values.rows(); ++row)
  {
    key.Add(observed_.values(row, 0));
  }
  const Job ofSolves{ surface.Threads(), job.progress.Part(covariances_ ? 0.6 : 0.3, 1.0) };
  stages.Run(SolveStage, key,
    [&]
    {
      result_ = {};
      ofSamples_ = SolveReport::Solved();
      ofCovariances_ = SolveReport::Solved();
      weights_.reset();
      if (covariances_)
      {
        this->Predict(surface, options, ofSolves.Part(0.0, 0.1));
      }
      this->Sample(surface, options, ofSolves.Part(covariances_ ? 0.1 : 0.0, 1.0));
      result_.report = ofSamples_;
      KeepWorse(ofCovariances_, result_.report);
      result_.warnings = this->Warnings(options);
    });
  job.Check(1.0);
  return result_;
}

void GaussianFieldSolver::UpdateField(
  const Surface& surface, const Options& options, const Job& job)
{
  MaternOptions ofField{ options.equation };
  const double range = surface.LengthInWorldUnits(options.range);
  const double unit = surface.Space().UnitLength();
  ofField.kappa = std::sqrt(8.0 * options.smoothness) / range * unit;
  ofField.smoothness = options.smoothness;
  ofField.multigrid.threads = surface.Threads();
  StageKey key;
  key.Add(surface.GetStages().Version(SystemStage)).Add(ofField.kappa).Add(ofField.smoothness);
  key.Add(KeyOf(options.equation));
  surface.GetStages().Run(HierarchyStage, key,
    [&]
    {
      covariances_.reset(); // frees their memory first
      field_.reset();
      field_ = std::make_unique<const MaternField>(surface.WholeSpace(), ofField, job);
      resolutionWarnings_ = WarningsOfResolution(
        range, std::sqrt(surface.Area() / double(surface.Space().NumberOfFunctions(0))));
      deviationsOfMeans_ = field_->DeviationsOfMeans(surface.Threads());
      const auto isInfinite = [](double deviation) { return std::isinf(deviation); };
      deviationsOfMeans_.erase( // components without an area
        std::remove_if(deviationsOfMeans_.begin(), deviationsOfMeans_.end(), isInfinite),
        deviationsOfMeans_.end());
    });
}

void GaussianFieldSolver::TakeObservations(const Surface& surface, const Input& input)
{
  observed_ = {};
  if (input.observations)
  {
    const PointValues given = input.observations.find();
    RequireUsed("Observations", given.points, surface.Mesh());
    observed_ = Reached(given, surface.PointsWithFunctions());
    RequireObservations(observed_);
  }
  errors_ = NormalErrors(surface.Mesh(), observed_.points);
}

void GaussianFieldSolver::UpdateCovariances(const Surface& surface, const Job& job)
{
  Stages& stages = surface.GetStages();
  if (observed_.points.empty())
  {
    covariances_.reset();
    stages.Forget(RightHandSideStage);
    return;
  }
  StageKey key;
  key.Add(stages.Version(HierarchyStage)).Add(observed_.points);
  stages.Run(RightHandSideStage, key,
    [&]
    {
      covariances_.reset(); // frees their memory first
      surface.Require(NeedOfObservations(
        static_cast<Id>(observed_.points.size()), surface.Space().NumberOfFunctions(0)));
      covariances_ = std::make_unique<const PointCovariances>(
        *field_, surface.WholeSpace()->RowsAtPoints(observed_.points), job);
    });
}

void GaussianFieldSolver::Predict(const Surface& surface, const Options& options, const Job& job)
{
  const double variance = options.standardDeviation * options.standardDeviation;
  const double noise = NoiseOf(options);
  Eigen::MatrixXd covariance = variance * covariances_->BetweenPoints();
  covariance.diagonal().array() += noise * noise;
  weights_ = std::make_unique<const KrigingWeights>(std::move(covariance));
  const KrigingWeights::Prediction weights = weights_->Of(observed_.values);
  FieldSamples deviation = covariances_->ToCoefficients(variance * weights.weights, job);
  Prediction& prediction = result_.prediction;
  prediction.mean = surface.ValuesAtPoints(deviation.coefficients).col(0).array() + weights.mean[0];
  const KrigingWeights::LeaveOneOut others = weights_->Validate(observed_.values.col(0));
  prediction.leaveOneOutError = MeansAtPlaces(surface, observed_.points, others.error);
  prediction.leaveOneOutError =
    prediction.mean.array().isNaN().select(prediction.mean, prediction.leaveOneOutError);
  prediction.leaveOneOutRatio = others.ratio;
  prediction.logLikelihood = weights_->LogLikelihood(observed_.values.col(0));
  KeepWorse(covariances_->Report(), ofCovariances_);
  KeepWorse(std::move(deviation.report), ofCovariances_);
}

/// Returns samples of mean 0. With observations, they are samples of the error of the prediction: a
/// free sample minus its prediction from its own noisy values at the observed points. [Matheron:
/// The intrinsic random functions and their applications, 1973]
MultiVector GaussianFieldSolver::SomeSamples(
  const Surface& surface, const Options& options, Id first, Id count, const Job& job)
{
  const auto seed = static_cast<std::uint64_t>(options.seed);
  FieldSamples samples =
    field_->Sample(seed, first, count, job.Part(0.0, covariances_ ? 0.5 : 1.0));
  KeepWorse(std::move(samples.report), ofSamples_);
  MultiVector& coefficients = samples.coefficients;
  coefficients *= options.standardDeviation;
  if (!covariances_)
  {
    return surface.ValuesAtPoints(coefficients);
  }
  const KrigingWeights::Prediction weights =
    weights_->Of(covariances_->AtPoints(coefficients, job.threads) +
                 options.observationNoise * errors_.Sample(seed, first, count));
  const double variance = options.standardDeviation * options.standardDeviation;
  FieldSamples deviation =
    covariances_->ToCoefficients(variance * weights.weights, job.Part(0.5, 1.0));
  KeepWorse(std::move(deviation.report), ofCovariances_);
  coefficients -= deviation.coefficients;
  return surface.ValuesAtPoints(coefficients).rowwise() - weights.mean;
}

void GaussianFieldSolver::Sample(const Surface& surface, const Options& options, const Job& job)
{
  const Eigen::VectorXd& mean = result_.prediction.mean;
  Sums sums;
  const Id all = NumberOfSamples(options);
  for (Id first = 0; first < all; first += SamplesAtOnce)
  {
    const Id count = std::min(SamplesAtOnce, all - first);
    MultiVector values = this->SomeSamples(surface, options, first, count,
      job.Part(double(first) / double(all), double(first + count) / double(all)));
    if (options.statistics)
    {
      sums.Add(values);
      continue;
    }
    if (covariances_)
    {
      values.colwise() += mean;
    }
    if (first == 0)
    {
      result_.atPoints.resize(values.rows(), all);
    }
    result_.atPoints.middleCols(first, count) = values;
  }
  if (options.statistics && covariances_)
  {
    result_.atPoints.resize(mean.size(), 2);
    result_.atPoints << mean, sums.DeviationFromZero(all);
  }
  else if (options.statistics)
  {
    result_.atPoints = sums.Statistics(all);
  }
}

std::vector<std::string> GaussianFieldSolver::Warnings(const Options& options) const
{
  std::vector<std::string> warnings = resolutionWarnings_;
  for (const std::string& warning :
    WarningsOfSize(deviationsOfMeans_, static_cast<bool>(covariances_)))
  {
    warnings.push_back(warning);
  }
  if (!ofSamples_.converged)
  {
    warnings.push_back(WarningOf(ofSamples_, options.equation.solve.tolerance));
  }
  if (!ofCovariances_.converged)
  {
    warnings.push_back("Covariances of observations are solved to a Tolerance of 1e-9 or less. " +
                       WarningOf(ofCovariances_, field_->CovarianceTolerance()));
  }
  return warnings;
}

GaussianFieldSolver::Result GaussianFieldSolver::Solve(std::shared_ptr<const TriangleMesh> mesh,
  const Input& input, const Options& options, const SurfaceOptions& surfaceOptions, const Job& job)
{
  return SolveOnMesh(
    &GaussianFieldSolver::result_, std::move(mesh), surfaceOptions, job, input, options);
}

} // namespace gridfem
