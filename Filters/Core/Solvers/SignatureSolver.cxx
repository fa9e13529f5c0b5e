#include "Solvers/SignatureSolver.h"

#include "Base/Errors.h"
#include "Base/UnsolvedRows.h"
#include "Grid/Grid.h"
#include "Solvers/SolveOnMesh.h"
#include "Solvers/SolveWarnings.h"
#include "Solvers/SurfaceFields.h"
#include "Spectrum/SpectralSurrogates.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace gridfem
{
namespace
{

///@{ Stages.
constexpr const char* SignaturesStage = "Signatures";
constexpr const char* DistancesStage = "Distances";
constexpr const char* ExpansionStage = "Expansion"; // of the values in the modes
constexpr const char* FilterStage = "Filter";
///@}

/// Surrogates that are added up together.
constexpr Id SurrogatesAtOnce = 16;

/// The square of the parameter unit, in world units.
double SquaredUnit(ParameterUnits units, const TriangleMesh& mesh, double area)
{
  if (units == ParameterUnits::UnitArea)
  {
    return area;
  }
  if (units == ParameterUnits::UnitCube)
  {
    const Grid grid = EmbedInGrid(mesh.points, UsedPoints(mesh), MinimumDepth);
    return std::pow(grid.spacing * grid.CellsPerSide(), 2);
  }
  return 1.0;
}

void RequireOnPoints(const GivenField& values)
{
  if (values && !values.IsOnPoints())
  {
    throw InvalidInput("Value Array '" + values.name +
                       "' must be a point array. Convert it with Cell Data to Point Data.");
  }
}

/// Whether a constant is a sum of the modes. It is not where modes are 0 on the boundary.
bool DescribeConstants(const Surface& surface, const TriangleMesh& mesh, const PointModes& modes)
{
  constexpr double Rounding = 1e-6;
  const ModeExpansion ofOne = ExpandInModes(mesh, modes, MultiVector::Ones(modes.values.rows(), 1),
    surface.Threads(), surface.SumsOverProcesses());
  return ofOne.remaining.bottomRows(1)(0, 0) <= Rounding * ofOne.norms[0];
}

/// Divides each column of errors by its number. An error of 0 stays 0.
MultiVector RelativeTo(const Eigen::RowVectorXd& whole, MultiVector errors)
{
  for (Id c = 0; c < errors.cols(); ++c)
  {
    errors.col(c) *= whole[c] > 0.0 ? 1.0 / whole[c] : 0.0;
  }
  return errors;
}

/// Throws InvalidInput for a band that no mode is in.
/// @return  the warning about modes that the filter asks for and that do not exist; empty: none
std::string WarningOfBand(const SignatureSolver::Options& options, int modes)
{
  const bool isBand = options.filterType == ModeFilter::BandPass;
  if (isBand && options.firstMode >= modes)
  {
    throw InvalidInput("First Mode is " + std::to_string(options.firstMode) +
                       ", but the last mode is " + std::to_string(modes - 1) +
                       ". Choose a smaller First Mode or a larger Number Of Modes.");
  }
  const bool isHigh = options.filterType == ModeFilter::HighPass;
  const int last = isHigh ? options.firstMode - 1 : options.lastMode;
  const bool hasBand =
    options.filterType != ModeFilter::None && options.filterType != ModeFilter::Surrogates;
  if (!hasBand || last < modes)
  {
    return {};
  }
  return std::string(isHigh ? "First Mode" : "Last Mode") + " is beyond the last mode, " +
         std::to_string(modes - 1) + ": the filter " + (isHigh ? "removes" : "keeps") +
         " the modes that exist. A larger Number Of Modes adds more.";
}

/// @param remaining  SignatureSolver::Result::remaining
/// @return  the warning about surrogates of values that the modes hardly describe; empty: none
std::string WarningOfSurrogates(
  const SignatureSolver::Options& options, const MultiVector& remaining)
{
  constexpr double Enough = 0.9; // of the variance
  if (options.filterType != ModeFilter::Surrogates)
  {
    return {};
  }
  const double described = 1.0 - std::pow(remaining.bottomRows(1).maxCoeff(), 2);
  if (described >= Enough)
  {
    return {};
  }
  return "The modes describe only " + std::to_string(std::lround(100.0 * described)) +
         " % of the variance of the values. The surrogates lack the rest, and are smoother than " +
         "the values. Choose a larger Number Of Modes.";
}

} // namespace

const SignatureSolver::Result& SignatureSolver::Update(
  Surface& surface, const Input& input, const Options& options, const Job& job)
{
  RequireOptions(options);
  if (options.filterType != ModeFilter::None)
  {
    RequireOnPoints(input.values);
  }
  if (options.filterType == ModeFilter::Surrogates && !input.values)
  {
    throw InvalidInput("Surrogates are made of values. Choose a Value Array.");
  }
  if (options.filterType == ModeFilter::BandPass && options.firstMode > options.lastMode)
  {
    throw InvalidInput("First Mode " + std::to_string(options.firstMode) + " is above Last Mode " +
                       std::to_string(options.lastMode) + ": no mode passes.");
  }
  job.Check(0.0);
  modes_.Update(surface, input.modes, { options.equation, options.numberOfModes }, input.announce,
    job.progress.Part(0.0, 0.97));
  modes_.RequireNonConstant();
  result_.modes = modes_.SharedModes();
  result_.isConverged = modes_.IsConverged();
  result_.where = modes_.Device();
  result_.warnings = modes_.Warnings();
  job.Check(0.97);
  const auto modes = static_cast<int>(result_.modes->eigenvalues.size());
  result_.warnings.push_back(WarningOfBand(options, modes));
  this->UpdateSums(surface, input, options, OfOwnPoints(surface, job.progress.Part(0.97, 1.0)));
  result_.warnings.push_back(WarningOfSurrogates(options, result_.remaining));
  result_.warnings = NotEmpty(std::move(result_.warnings));
  return result_;
}

void SignatureSolver::UpdateSums(
  const Surface& surface, const Input& input, const Options& options, const Progress& progress)
{
  const PointModes& modes = *result_.modes;
  const TriangleMesh& mesh = modes_.Mesh();
  const int threads = surface.Threads();
  StageKey key;
  key.Add(surface.GetStages().Version(ModesStage)).Add(options.numberOfScales);
  surface.GetStages().Run(SignaturesStage, key,
    [&]
    {
      surface.Require({ 2.0 * sizeof(double) * double(modes.values.rows()) * options.numberOfScales,
        "Number Of Scales " + std::to_string(options.numberOfScales), "Choose fewer scales." });
      result_.waveBands = WaveEnergies(modes, options.numberOfScales);
      result_.waveKernel =
        WaveKernelSignature(modes, result_.waveBands, { threads, progress.Part(0.0, 0.4) });
      result_.heatTimes = HeatTimes(modes, options.numberOfScales);
      result_.heatKernel =
        HeatKernelSignature(modes, result_.heatTimes, { threads, progress.Part(0.4, 0.8) });
      ClearRows(modes_.IsReached(), result_.waveKernel);
      ClearRows(modes_.IsReached(), result_.heatKernel);
    });
  const ParameterUnits units = surface.UsedOptions().parameterUnits;
  key = {};
  key.Add(surface.GetStages().Version(ModesStage)).Add(input.sources);
  key.Add(options.diffusionTime).Add(units);
  surface.GetStages().Run(DistancesStage, key,
    [&]
    {
      result_.diffusionDistance.clear();
      result_.biharmonicDistance.clear();
      if (!input.sources.empty())
      {
        const double time = options.diffusionTime * SquaredUnit(units, mesh, modes.area);
        result_.diffusionDistance = DiffusionDistance(modes, input.sources, time, threads);
        result_.biharmonicDistance = BiharmonicDistance(modes, input.sources, threads);
        ClearRows(modes_.IsReached(), result_.diffusionDistance);
        ClearRows(modes_.IsReached(), result_.biharmonicDistance);
      }
    });
  const bool isFiltered = options.filterType != ModeFilter::None;
  key = {};
  key.Add(surface.GetStages().Version(ModesStage)).Add(KeyOf(input.values)).Add(isFiltered);
  surface.GetStages().Run(ExpansionStage, key,
    [&]
    {
      for (MultiVector* block : { &result_.coefficients, &result_.remaining, &values_, &shares_ })
      {
        block->resize(0, 0);
      }
      if (isFiltered)
      {
        this->Expand(surface, mesh, input);
      }
    });
  key = {};
  key.Add(surface.GetStages().Version(ExpansionStage));
  key.Add(options.filterType).Add(options.firstMode).Add(options.lastMode);
  key.Add(options.numberOfSurrogates).Add(options.seed);
  surface.GetStages().Run(
    FilterStage, key, [&] { this->Filter(surface, options, progress.Part(0.8, 1.0)); });
}

/// Expands the values in the modes. Large constants would round the rest away, and are left out if
/// modes describe them.
void SignatureSolver::Expand(const Surface& surface, const TriangleMesh& mesh, const Input& input)
{
  const PointModes& modes = *result_.modes;
  values_ = input.values ? ReadField(surface, input.values).values : UsedCoordinates(mesh).values;
  constants_ = LargeConstants(surface, values_, UsedPoints(mesh));
  if (!constants_.isZero(0.0) && !DescribeConstants(surface, mesh, modes))
  {
    constants_.setZero();
  }
  values_.rowwise() -= constants_;
  // The last column is the constant 1.
  MultiVector columns(values_.rows(), values_.cols() + 1);
  columns << values_, MultiVector::Ones(values_.rows(), 1);
  const ModeExpansion expansion =
    ExpandInModes(mesh, modes, columns, surface.Threads(), surface.SumsOverProcesses());
  shares_ = expansion.shares.leftCols(values_.cols());
  result_.coefficients = shares_ + expansion.shares.rightCols(1) * constants_;
  // No mode is constant with zero boundary values.
  const Eigen::RowVectorXd whole = expansion.RemainingAfter(CountZeroModes(modes));
  result_.remaining =
    RelativeTo(whole.head(values_.cols()), expansion.remaining.leftCols(values_.cols()));
}

/// Adds up the modes that pass, or random shares of all modes.
void SignatureSolver::Filter(
  const Surface& surface, const Options& options, const Progress& progress)
{
  result_.filtered.resize(0, 0);
  result_.surrogates.resize(0, 0);
  if (options.filterType == ModeFilter::None)
  {
    return;
  }
  if (options.filterType == ModeFilter::Surrogates)
  {
    result_.surrogates = this->Surrogates(surface, options, progress);
    return;
  }
  const PointModes& modes = *result_.modes;
  const bool isHigh = options.filterType == ModeFilter::HighPass;
  const int first = options.filterType == ModeFilter::BandPass ? options.firstMode : 0;
  const int last = isHigh ? options.firstMode - 1 : options.lastMode;
  // The constants belong to the sum as a whole, or only their parts in some modes do.
  const bool areWhole = first == 0 && last >= CountZeroModes(modes) - 1;
  MultiVector sum =
    SumOfModes(modes, areWhole ? shares_ : result_.coefficients, first, last, surface.Threads());
  result_.filtered = isHigh ? MultiVector(values_ - sum) : std::move(sum);
  if (areWhole != isHigh)
  {
    result_.filtered.rowwise() += constants_;
  }
  ClearRows(modes_.IsReached(), result_.filtered);
}

MultiVector SignatureSolver::Surrogates(
  const Surface& surface, const Options& options, const Progress& progress) const
{
  const PointModes& modes = *result_.modes;
  const Id columns = shares_.cols();
  const Id count = options.numberOfSurrogates;
  surface.Require({ 2.0 * sizeof(double) * double(values_.rows()) * double(columns * count),
    "Number Of Surrogates " + std::to_string(count) + " at " + std::to_string(values_.rows()) +
      " points",
    "Choose fewer surrogates." }); // the caller copies them
  const Index constants = CountZeroModes(modes);
  MultiVector surrogates(values_.rows(), columns * count);
  for (Id first = 0; first < count; first += SurrogatesAtOnce)
  {
    progress.Check(double(first) / double(count));
    const Id some = std::min(SurrogatesAtOnce, count - first);
    MultiVector shares(shares_.rows(), columns * some);
    for (Id k = 0; k < some; ++k)
    {
      shares.middleCols(k * columns, columns) =
        RotateWithinGroups(shares_, constants, static_cast<std::uint64_t>(options.seed), first + k);
    }
    surrogates.middleCols(first * columns, some * columns) =
      SumOfModes(modes, shares, 0, static_cast<Index>(shares.rows()), surface.Threads());
  }
  const Eigen::RowVectorXd constantsOfAll = constants_.replicate(1, count);
  surrogates.rowwise() += constantsOfAll;
  ClearRows(modes_.IsReached(), surrogates);
  return surrogates;
}

SignatureSolver::Result SignatureSolver::Solve(std::shared_ptr<const TriangleMesh> mesh,
  const Input& input, const Options& options, const SurfaceOptions& surfaceOptions, const Job& job)
{
  return SolveOnMesh(
    &SignatureSolver::result_, std::move(mesh), surfaceOptions, job, input, options);
}

} // namespace gridfem
