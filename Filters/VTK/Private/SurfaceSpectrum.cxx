#include "SurfaceSpectrum.h"

#include "ClippedArrays.h"
#include "InputValidation.h"
#include "vtkSurfaceFEMAlgorithm.h"

#include "Problems/DepthSearch.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace gridfem
{
namespace
{

double Largest(const std::vector<double>& values)
{
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

/// On this rank; for which vectors are held at the same time.
Id NumberOfUnknowns(const SurfaceSpace& space)
{
  const std::size_t nested = space.NestedLevels() ? space.NestedLevels()->Integrals().size() : 0;
  return static_cast<Id>(space.Integrals().size() + nested);
}

/// Says the cost of many modes before anything is computed.
void AnnounceCost(SurfaceSolverState& state, Id functions, Id modes)
{
  constexpr double Minute = 60.0;
  constexpr double Hour = 3600.0;
  const double seconds = EstimateSpectrumSeconds(functions, modes, state.Threads());
  if (seconds < Minute)
  {
    return;
  }
  std::ostringstream text;
  text << std::setprecision(2) << modes << " modes of " << functions << " functions: about "
       << (seconds < Hour ? seconds / Minute : seconds / Hour)
       << (seconds < Hour ? " minutes" : " hours");
  state.bridge.Say(text.str());
  if (seconds >= Hour)
  {
    state.bridge.Warn(text.str() + ". An abort ends it at any time.");
  }
}

} // namespace

SpectrumOptions SolverOptions(const FilterOptions& options, int numberOfModes)
{
  SpectrumOptions ofSolver;
  ofSolver.numberOfModes = numberOfModes;
  ofSolver.tolerance = options.solve.tolerance;
  ofSolver.maximumIterations = options.solve.maximumIterations;
  ofSolver.multigrid = options.multigrid;
  return ofSolver;
}

std::vector<double> InWorldUnits(std::vector<double> eigenvalues, double unitLength)
{
  for (double& eigenvalue : eigenvalues)
  {
    eigenvalue /= unitLength * unitLength;
  }
  return eigenvalues;
}

double SurfaceSpectrum::LargestResidual() const
{
  return Largest(spectrum.residuals);
}

double SurfaceSpectrum::LargestEstimatedError() const
{
  return Largest(spectrum.estimatedErrors);
}

StageKey SurfaceSpectrum::KeyOf(
  const SurfaceSolverState& state, const SpectrumRequest& request) const
{
  StageKey key;
  key.Add(state.stages.Version(SystemStage)).Add(request.numberOfModes);
  key.Add(request.completeMultiplets).Add(state.options.solve.tolerance);
  // What is improved after the nested levels waits for the depth that the accuracy asks for.
  key.Add(state.SharedSpace()->NestedLevels() ? request.accuracy : 0.0);
  key.Add(state.options.solve.maximumIterations);
  AddMultigrid(key, state.options.multigrid);
  return key;
}

void SurfaceSpectrum::UpdateTogether(
  SurfaceSolverState& state, const SpectrumRequest& request, const Progress& progress)
{
  state.stages.Run(SolveStage, this->KeyOf(state, request),
    [&]
    {
      const SurfaceSpace& space = *state.SharedSpace();
      SpectrumOptions options = SolverOptions(state.options, request.numberOfModes);
      options.completeMultiplets = request.completeMultiplets;
      spectrum = {}; // frees its memory first
      atPoints.resize(0, 0);
      MemoryNeed need =
        NeedOfModes(NumberOfUnknowns(space), options.numberOfModes, options.multigrid.threads);
      need.subject = "NumberOfModes " + std::to_string(options.numberOfModes); // functions differ
      state.together.Require(need);
      spectrum = ComputeSpectrum(space, options, progress);
      eigenvalues = InWorldUnits(spectrum.eigenvalues, space.UnitLength());
      atPoints = EvaluateModes(state, spectrum, 0, this->NumberOfModes());
      spectrum.vectors.resize(0, 0);
      depth = state.together.Depth();
    });
}

void SurfaceSpectrum::Solve(
  SurfaceSolverState& state, const SpectrumRequest& request, const Progress& progress)
{
  const auto solve = [&]
  {
    const FiniteElementSpace& space = *state.space;
    RequireMemoryForModes(
      NumberOfUnknowns(space), request.numberOfModes, state.options.multigrid.threads);
    AnnounceCost(state, NumberOfUnknowns(space), request.numberOfModes);
    SpectrumOptions options = SolverOptions(state.options, request.numberOfModes);
    options.completeMultiplets = request.completeMultiplets;
    spectrum = {}; // frees its memory first
    atPoints.resize(0, 0);
    const double split = space.NestedLevels() ? 0.3 : 1.0;
    Spectrum nested = ComputeNestedSpectrum(space, options, progress.Part(0.0, split));
    gridErrors_ = nested.estimatedErrors;
    if (space.NestedLevels()) // guards have been computed, too
    {
      gridErrors_.resize(std::min<std::size_t>(gridErrors_.size(), request.numberOfModes));
    }
    if (!space.NestedLevels() ||
        this->NextDepth(state, request.accuracy) == state.Functions().GetGrid().depth)
    {
      spectrum = FinishSpectrum(space, std::move(nested), options, progress.Part(split, 1.0));
    }
    eigenvalues = InWorldUnits(spectrum.eigenvalues, space.UnitLength());
  };
  state.stages.Run(SolveStage, this->KeyOf(state, request), solve);
  nextDepth_ = this->NextDepth(state, request.accuracy);
}

/// The depth at which the errors on the grid should be small enough, if that fits into memory; else
/// this one. With accuracy 0 any error is.
int SurfaceSpectrum::NextDepth(const SurfaceSolverState& state, double accuracy) const
{
  const int now = state.Functions().GetGrid().depth;
  return accuracy > 0.0 ? NextDepthForModes(*state.mesh.triangles, gridErrors_, now, accuracy,
                            state.options.choice.kind)
                        : now;
}

/// The depth that was found last time for the same mesh and wishes, else a first guess.
void SurfaceSpectrum::ChooseDepth(
  SurfaceSolverState& state, vtkPolyData* input, const SpectrumRequest& request)
{
  StageKey asked;
  AddMesh(asked, input);
  asked.Add(request.numberOfModes).Add(request.accuracy);
  asked.Add(state.options.space.connectivityAware).Add(state.options.space.weldCoincidentPoints);
  if (!(asked == asked_))
  {
    asked_ = asked;
    const InputMesh mesh = ReadInputMesh(input, state.Threads());
    RequireSurface(*mesh.triangles);
    depth = FirstDepthForModes(
      *mesh.triangles, request.numberOfModes, request.accuracy, state.options.choice.kind);
  }
  state.options.space.depth = depth;
}

void SurfaceSpectrum::Update(SurfaceSolverState& state, vtkPolyData* input, vtkPolyData* basisData,
  const SpectrumRequest& request)
{
  const Progress all = state.bridge.GetProgress();
  SpectrumRequest wanted = request;
  if (basisData || CarriesBasis(input))
  {
    wanted.accuracy = 0.0;
  }
  const bool choose = wanted.accuracy > 0.0;
  state.options.functionsPerPoint = choose ? AsManyAsWanted : EnoughToEstimate;
  if (choose)
  {
    this->ChooseDepth(state, input, wanted);
  }
  double done = 0.0;
  while (true)
  {
    const Progress progress = all.Part(done, choose ? 0.5 + 0.45 * done : 0.95);
    state.UpdateSpace(input, basisData, progress.Part(0.0, 0.3));
    progress.Check(0.3);
    state.UpdateSystem(progress.Part(0.3, 0.5));
    progress.Check(0.5);
    this->Solve(state, wanted, progress.Part(0.5, 1.0));
    depth = state.Functions().GetGrid().depth;
    if (nextDepth_ == depth)
    {
      break;
    }
    done = 0.5 + 0.45 * done;
    state.options.space.depth = nextDepth_;
  }
}

MultiVector EvaluateModes(const SurfaceSolverState& state, const Spectrum& spectrum, Id first,
  Id count, const Progress& progress)
{
  // The integral over the space's units is UnitLength² times smaller than the one over world units.
  const MultiVector coefficients =
    spectrum.vectors.middleCols(first, count) / state.SharedSpace()->UnitLength();
  return state.ValuesAtPoints(coefficients, progress);
}

} // namespace gridfem
