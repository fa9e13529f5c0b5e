#include "Solvers/GaussianFieldSolver.h"

#include "Base/Errors.h"
#include "Solvers/LocalSurface.h"
#include "Solvers/SolveWarnings.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace gridfem
{
namespace
{

/// Samples that are solved together. They fill the lanes of a vector instruction.
constexpr Id SamplesAtOnce = 8;

void RequireSampling(const GaussianFieldSolver::Options& options)
{
  RequireOptions(options);
  if (options.range == 0.0)
  {
    throw InvalidInput("Range is 0. It must be above 0.");
  }
  if (options.statistics && options.numberOfSamples < 2)
  {
    throw InvalidInput("Statistics needs a Number Of Samples of 2 or more.");
  }
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
  MultiVector Statistics(int samples) const
  {
    MultiVector result(first.size(), 2);
    result.col(0) = first / samples;
    const Eigen::ArrayXd squares = second.array() - first.array() * result.col(0).array();
    result.col(1) = (squares.isNaN().select(squares, squares.max(0.0)) / (samples - 1)).sqrt();
    return result;
  }
};

} // namespace

SurfaceOptions GaussianFieldSolver::SurfaceDefaults()
{
  SurfaceOptions options;
  options.choice.normalStabilization = 1e-2;
  return options;
}

const GaussianFieldSolver::Result& GaussianFieldSolver::Update(
  Surface& surface, const Options& options, const Job& job)
{
  RequireSampling(options);
  surface.Prepare(job.progress.Part(0.0, 0.3));
  RequireFirstDegree(surface.UsedOptions().choice.kind, "Random fields");
  this->UpdateField(surface, options, { surface.Threads(), job.progress.Part(0.3, 0.4) });
  StageKey key = KeyOfOptions(options);
  key.Add(surface.GetStages().Version(HierarchyStage));
  surface.GetStages().Run(SolveStage, key,
    [&] {
      this->Sample(surface, options, { surface.Threads(), job.progress.Part(0.4, 1.0) });
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
      field_.reset(); // frees its memory first
      field_ = std::make_unique<const MaternField>(surface.WholeSpace(), ofField, job);
      warnings_ = WarningsOfResolution(
        range, std::sqrt(surface.Area() / double(surface.Space().NumberOfFunctions(0))));
    });
}

void GaussianFieldSolver::Sample(const Surface& surface, const Options& options, const Job& job)
{
  result_ = {};
  Sums sums;
  const Id all = options.numberOfSamples;
  for (Id first = 0; first < all; first += SamplesAtOnce)
  {
    const Id count = std::min(SamplesAtOnce, all - first);
    FieldSamples samples = field_->Sample(static_cast<std::uint64_t>(options.seed), first, count,
      job.Part(double(first) / double(all), double(first + count) / double(all)));
    const MultiVector values =
      options.standardDeviation * surface.ValuesAtPoints(samples.coefficients);
    if (first == 0)
    {
      result_.report = std::move(samples.report);
      result_.atPoints.resize(values.rows(), options.statistics ? 0 : all);
    }
    else
    {
      KeepWorse(std::move(samples.report), result_.report);
    }
    if (options.statistics)
    {
      sums.Add(values);
    }
    else
    {
      result_.atPoints.middleCols(first, count) = values;
    }
  }
  if (options.statistics)
  {
    result_.atPoints = sums.Statistics(options.numberOfSamples);
  }
  result_.warnings = warnings_;
  if (!result_.report.converged)
  {
    result_.warnings.push_back(WarningOf(result_.report, options.equation.solve.tolerance));
  }
}

GaussianFieldSolver::Result GaussianFieldSolver::Solve(std::shared_ptr<const TriangleMesh> mesh,
  const Options& options, const SurfaceOptions& surfaceOptions, const Job& job)
{
  Stages stages;
  LocalSurface surface(stages, std::move(mesh), surfaceOptions);
  GaussianFieldSolver solver;
  solver.Update(surface, options, job);
  return std::move(solver.result_);
}

} // namespace gridfem
