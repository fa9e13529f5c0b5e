#include "Solvers/SpectrumSolver.h"

#include "Solvers/DepthSearch.h"
#include "Solvers/LocalSurface.h"
#include "Solvers/SolveWarnings.h"
#include "Solvers/ZeroBoundary.h"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <utility>

namespace gridfem
{
namespace
{

/// Returns the number of unknowns in this process, on all levels whose vectors are held at the same
/// time.
Id NumberOfUnknowns(const SurfaceSpace& space)
{
  const std::size_t nested = space.NestedLevels() ? space.NestedLevels()->Integrals().size() : 0;
  return static_cast<Id>(space.Integrals().size() + nested);
}

void RequireMemoryOfModes(const Surface& surface, int modes)
{
  MemoryNeed need = NeedOfModes(NumberOfUnknowns(surface.Space()), modes, surface.Threads());
  if (surface.IsShared())
  {
    need.subject = "Number Of Modes " + std::to_string(modes); // functions differ
  }
  surface.Require(need);
}

/// Reports the cost of many modes before anything is computed.
void AnnounceCost(const Surface& surface, const SpectrumSolver::Input& input, Id modes)
{
  constexpr double Long = 30.0; // seconds
  constexpr double Minute = 60.0;
  constexpr double Hour = 3600.0;
  const Id functions = NumberOfUnknowns(surface.Space());
  const double seconds = EstimateSpectrumSeconds(functions, modes, surface.Threads());
  if (seconds < Long || !input.announce || surface.IsShared())
  {
    return;
  }
  const auto [unit, name] = seconds < Minute ? std::make_pair(1.0, " seconds")
                            : seconds < Hour ? std::make_pair(Minute, " minutes")
                                             : std::make_pair(Hour, " hours");
  std::ostringstream text;
  text << std::setprecision(2) << modes << " modes of " << functions << " functions: about "
       << seconds / unit << name;
  input.announce(text.str(), seconds >= Hour);
}

/// The share of the preparation in the progress, as measured on scans.
double ShareOfPreparation(int modes)
{
  return 1.0 / (2.3 + modes / 20.0 + double(modes) * double(modes) / 6000.0);
}

SpectrumOptions OptionsOfSpectrum(const Surface& surface, const SpectrumSolver::Input& input,
  const SpectrumSolver::Options& options)
{
  SpectrumOptions ofSpectrum;
  ofSpectrum.numberOfModes = options.numberOfModes;
  ofSpectrum.tolerance = options.equation.solve.tolerance;
  ofSpectrum.maximumIterations = options.equation.solve.maximumIterations;
  ofSpectrum.completeMultiplets = input.completesMultiplets;
  ofSpectrum.multigrid = options.equation.multigrid;
  ofSpectrum.multigrid.threads = surface.Threads();
  return ofSpectrum;
}

std::vector<double> InWorldUnits(std::vector<double> eigenvalues, double unitLength)
{
  for (double& eigenvalue : eigenvalues)
  {
    eigenvalue /= unitLength * unitLength;
  }
  return eigenvalues;
}

bool AreAllTrusted(const std::vector<char>& isTrusted)
{
  return std::all_of(isTrusted.begin(), isTrusted.end(), [](char trusted) { return trusted != 0; });
}

} // namespace

EquationOptions EquationOfModes()
{
  EquationOptions equation;
  equation.multigrid.cycle = CycleType::V;
  equation.solve.tolerance = 1e-6;
  equation.solve.maximumIterations = 100;
  return equation;
}

SurfaceOptions SpectrumSolver::SurfaceDefaults()
{
  SurfaceOptions options;
  options.functionsPerPoint = EnoughToEstimate;
  return options;
}

const SpectrumSolver::Result& SpectrumSolver::Update(
  Surface& surface, const Input& input, const Options& options, const Job& job)
{
  RequireOptions(options);
  const double accuracy = surface.AreFunctionsGiven() ? 0.0 : options.accuracy;
  const bool choose = accuracy > 0.0;
  now_ = choose ? this->FirstDepth(surface, options) : Choice();
  double done = 0.0;
  const double prepared = ShareOfPreparation(options.numberOfModes);
  while (true)
  {
    const double end = choose ? 0.5 + 0.5 * done : 1.0;
    const Progress progress = job.progress.Part(done, end);
    if (choose)
    {
      surface.PrepareAtDepth(now_.depth, progress.Part(0.0, prepared));
    }
    else
    {
      surface.Prepare(progress.Part(0.0, prepared));
    }
    progress.Check(prepared);
    this->UpdateModes(surface, input, options, progress.Part(prepared, 1.0));
    result_.depth = surface.UsedOptions().space.depth;
    const int next = this->NextDepth(surface, accuracy);
    if (next == result_.depth)
    {
      break;
    }
    now_ = { next, this->AreGridErrorsAtMost(accuracy) };
    done = end;
  }
  chosen_ = choose ? now_ : chosen_;
  this->Judge(surface, options);
  return result_;
}

/// Returns the depth that was found last time for the same mesh and options, else a first guess.
SpectrumSolver::Choice SpectrumSolver::FirstDepth(Surface& surface, const Options& options)
{
  StageKey key = surface.InputKey();
  key.Add(options.numberOfModes).Add(options.accuracy).Add(options.zeroBoundaryValues);
  if (key != depthKey_)
  {
    const std::shared_ptr<const TriangleMesh> mesh = surface.ReadMesh();
    RequireSurface(*mesh);
    chosen_ = { FirstDepthForModes(*mesh, options.numberOfModes, options.accuracy,
                  surface.UsedOptions().choice.kind),
      false };
    depthKey_ = key;
  }
  return chosen_;
}

/// Whether the errors on the grid are certain enough to end a search.
bool SpectrumSolver::IsConfirmed() const
{
  return areTrusted_ || now_.wasAccurate;
}

bool SpectrumSolver::AreGridErrorsAtMost(double accuracy) const
{
  return std::all_of(
    gridErrors_.begin(), gridErrors_.end(), [=](double error) { return error <= accuracy; });
}

/// Returns the depth at which the errors on the grid should be small enough, if that fits into
/// memory, else this depth. With accuracy 0 any error is small enough.
int SpectrumSolver::NextDepth(const Surface& surface, double accuracy) const
{
  const SurfaceOptions& used = surface.UsedOptions();
  return accuracy > 0.0 ? NextDepthForModes(surface.Mesh(), gridErrors_, this->IsConfirmed(),
                            used.space.depth, accuracy, used.choice.kind)
                        : used.space.depth;
}

void SpectrumSolver::UpdateModes(
  const Surface& surface, const Input& input, const Options& options, const Progress& progress)
{
  const SurfaceSpace& space = surface.Space();
  const bool isNested = !space.NestedLevels();
  Options ofModes = options;
  // Improvement after the nested levels waits for the depth that the accuracy asks for.
  const bool mayGoOn = !isNested && !surface.AreFunctionsGiven();
  ofModes.accuracy = mayGoOn ? options.accuracy : 0.0;
  StageKey key;
  key.Add(surface.GetStages().Version(SystemStage)).Add(input.completesMultiplets);
  key.Add(KeyOfOptions(ofModes)).Add(mayGoOn && now_.wasAccurate);
  surface.GetStages().Run(SolveStage, key,
    [&]
    {
      result_.spectrum = {}; // frees its memory first
      RequireMemoryOfModes(surface, options.numberOfModes);
      AnnounceCost(surface, input, options.numberOfModes);
      std::unique_ptr<const PenalizedLevels> held;
      if (options.zeroBoundaryValues)
      {
        held = ZeroOnBoundary(surface);
      }
      lacksBoundary_ = options.zeroBoundaryValues && !held;
      const SpaceLevels& levels = held ? static_cast<const SpaceLevels&>(*held) : space;
      const SpectrumOptions ofSpectrum = OptionsOfSpectrum(surface, input, options);
      const double split = isNested ? 1.0 : 0.3;
      Spectrum nested = ComputeNestedSpectrum(levels, ofSpectrum, progress.Part(0.0, split));
      this->TakeGridErrors(nested, options.numberOfModes);
      if (isNested ||
          this->NextDepth(surface, ofModes.accuracy) == surface.UsedOptions().space.depth)
      {
        result_.spectrum =
          FinishSpectrum(levels, std::move(nested), ofSpectrum, progress.Part(split, 1.0));
      }
      result_.eigenvalues = InWorldUnits(result_.spectrum.eigenvalues, space.UnitLength());
    });
}

/// @param nested  may have more modes than wanted: guards
void SpectrumSolver::TakeGridErrors(const Spectrum& nested, int wanted)
{
  gridErrors_ = nested.estimatedErrors;
  std::vector<char> isTrusted = nested.isErrorTrusted;
  const auto count = std::min<std::size_t>(gridErrors_.size(), wanted);
  gridErrors_.resize(count);
  isTrusted.resize(count);
  areTrusted_ = AreAllTrusted(isTrusted);
}

/// The warnings, and whether the eigenvalues are as accurate as wanted.
void SpectrumSolver::Judge(const Surface& surface, const Options& options)
{
  const FunctionKind kind = surface.UsedOptions().choice.kind;
  result_.warnings =
    WarningsOf(result_.spectrum, options.numberOfModes, PlaceOf(kind, result_.depth));
  if (lacksBoundary_)
  {
    result_.warnings.push_back(
      "The surface has no boundary, so Zero Boundary Values has no effect.");
  }
  const std::vector<double>& errors = result_.spectrum.estimatedErrors;
  const double error = errors.empty() ? 0.0 : *std::max_element(errors.begin(), errors.end());
  result_.isErrorTrusted = AreAllTrusted(result_.spectrum.isErrorTrusted);
  result_.isAccurate =
    options.accuracy == 0.0 ||
    (error <= options.accuracy && (this->IsConfirmed() || result_.isErrorTrusted));
  if (!result_.isAccurate)
  {
    result_.warnings.push_back(WarningOfAccuracy(options.accuracy, error, kind, result_.depth));
  }
}

MultiVector SpectrumSolver::ModesAtPoints(
  const Surface& surface, Id first, Id count, const Progress& progress) const
{
  // The integral in the units of the space is UnitLength² times smaller than the integral in world
  // units.
  const MultiVector coefficients =
    result_.spectrum.vectors.middleCols(first, count) / surface.Space().UnitLength();
  return surface.ValuesAtPoints(coefficients, progress);
}

SpectrumSolver::Result SpectrumSolver::Solve(std::shared_ptr<const TriangleMesh> mesh,
  const Input& input, const Options& options, const SurfaceOptions& surfaceOptions, const Job& job)
{
  Stages stages;
  LocalSurface surface(stages, std::move(mesh), surfaceOptions);
  SpectrumSolver solver;
  Result result = solver.Update(surface, input, options, job);
  result.atPoints = solver.ModesAtPoints(surface, 0, result.NumberOfModes());
  return result;
}

} // namespace gridfem
