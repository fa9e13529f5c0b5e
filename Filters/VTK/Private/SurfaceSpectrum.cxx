#include "SurfaceSpectrum.h"

#include "ClippedArrays.h"
#include "InputValidation.h"
#include "vtkSurfaceFEMAlgorithm.h"

#include "Integrals/Evaluation.h"
#include "Problems/HatSpectrum.h"
#include "Problems/MemoryEstimate.h"
#include "Problems/SpectrumAccuracy.h"

#include "vtkPolyData.h"

#include <algorithm>

namespace gridfem
{
namespace
{

double Largest(const std::vector<double>& values)
{
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

bool FitsMemory(const TriangleMesh& mesh, int depth, bool hatFunctions)
{
  const double available = AvailableMemory();
  const MemoryEstimate estimate = EstimateMemory(mesh, depth);
  const double hats = hatFunctions ? EstimateHatMemory(mesh, estimate.functions) : 0.0;
  return available <= 0.0 || estimate.bytes + hats <= available;
}

SpectrumOptions SolverOptions(const SurfaceSolverState& state, int numberOfModes)
{
  SpectrumOptions options;
  options.numberOfModes = numberOfModes;
  options.tolerance = state.options.solve.tolerance;
  options.maximumIterations = state.options.solve.maximumIterations;
  options.multigrid = state.options.multigrid;
  return options;
}

std::vector<double> InWorldUnits(std::vector<double> eigenvalues, const Grid& grid)
{
  for (double& eigenvalue : eigenvalues)
  {
    eigenvalue /= grid.spacing * grid.spacing;
  }
  return eigenvalues;
}

} // namespace

double SurfaceSpectrum::LargestResidual() const
{
  return Largest(spectrum.residuals);
}

double SurfaceSpectrum::LargestEstimatedError() const
{
  return Largest(spectrum.estimatedErrors);
}

void SurfaceSpectrum::Solve(
  SurfaceSolverState& state, const SpectrumRequest& request, const Progress& progress)
{
  StageKey key;
  key.Add(state.stages.Version(vtkSurfaceFEMAlgorithm::SystemStage)).Add(request.numberOfModes);
  key.Add(request.completeMultiplets).Add(state.options.solve.tolerance);
  // Hats are solved only at the depth that the accuracy asks for.
  key.Add(state.hats ? request.accuracy : 0.0);
  key.Add(state.options.solve.maximumIterations);
  AddMultigrid(key, state.options.multigrid);
  const auto solve = [&]
  {
    const GridFunctions& space = state.Space();
    RequireMemoryForModes(
      space.Finest().numberOfFunctions + (state.hats ? state.hats->functions.Count() : 0),
      request.numberOfModes, state.options.multigrid.threads);
    SpectrumOptions options = SolverOptions(state, request.numberOfModes);
    options.completeMultiplets = request.completeMultiplets;
    spectrum = {}; // frees its memory first
    if (state.hats)
    {
      const Spectrum grid =
        ComputeSpectrum(space, *state.system, HatStartOptions(options), progress.Part(0.0, 0.3));
      gridErrors_ = grid.estimatedErrors;
      gridErrors_.resize(std::min<std::size_t>(gridErrors_.size(), request.numberOfModes));
      nextDepth_ = this->NextDepth(state, request.accuracy);
      if (nextDepth_ == space.GetGrid().depth)
      {
        spectrum = ComputeHatSpectrum(
          *state.hats, space, *state.system, grid, options, progress.Part(0.3, 1.0));
      }
    }
    else
    {
      spectrum = ComputeSpectrum(space, *state.system, options, progress);
      gridErrors_ = spectrum.estimatedErrors;
    }
    eigenvalues = InWorldUnits(spectrum.eigenvalues, space.GetGrid());
  };
  state.stages.Run(vtkSurfaceFEMAlgorithm::SolveStage, key, solve);
  if (!state.hats)
  {
    nextDepth_ = this->NextDepth(state, request.accuracy);
  }
}

/// The depth at which the errors on the grid should be small enough, if that fits into memory; else
/// this one. With accuracy 0 any error is.
int SurfaceSpectrum::NextDepth(const SurfaceSolverState& state, double accuracy) const
{
  const int now = state.Space().GetGrid().depth;
  const int next = accuracy > 0.0 ? DepthForAccuracy(gridErrors_, now, accuracy) : now;
  return next == now || FitsMemory(*state.mesh.triangles, next, state.options.hatFunctions) ? next
                                                                                            : now;
}

/// As many eigenvalues as there are modes, in the function space that was not chosen.
void SurfaceSpectrum::Compare(SurfaceSolverState& state, const Progress& progress)
{
  StageKey key;
  key.Add(state.stages.Version(vtkSurfaceFEMAlgorithm::SolveStage));
  if (key == compared_)
  {
    return;
  }
  compared_ = {};
  const GridFunctions& space = state.Space();
  const SpectrumOptions options = SolverOptions(state, this->NumberOfModes());
  Spectrum other;
  if (state.hats)
  {
    other = ComputeSpectrum(space, *state.system, options, progress);
  }
  else
  {
    const HatHierarchy hats = state.BuildHats(progress.Part(0.0, 0.1));
    RequireMemoryForModes(space.Finest().numberOfFunctions + hats.functions.Count(),
      options.numberOfModes, options.multigrid.threads);
    other = ComputeHatSpectrum(hats, space, *state.system, options, progress.Part(0.1, 1.0));
  }
  otherEigenvalues = InWorldUnits(other.eigenvalues, space.GetGrid());
  otherConverged = other.converged;
  compared_ = key;
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
    const InputMesh mesh = ReadInputMesh(input, state.options.space.threads);
    RequireSurface(*mesh.triangles);
    depth = FirstDepthForAccuracy(
      EstimateMemory(*mesh.triangles, 5).functions, request.numberOfModes, request.accuracy);
    while (depth > MinimumDepth && !FitsMemory(*mesh.triangles, depth, state.options.hatFunctions))
    {
      --depth;
    }
  }
  state.options.space.depth = depth;
}

void SurfaceSpectrum::Update(SurfaceSolverState& state, vtkPolyData* input, vtkPolyData* basisData,
  const SpectrumRequest& request)
{
  const Progress all = state.bridge.GetProgress().Part(0.0, request.compare ? 0.5 : 1.0);
  SpectrumRequest wanted = request;
  if (basisData || CarriesBasis(input))
  {
    wanted.accuracy = 0.0;
  }
  const bool choose = wanted.accuracy > 0.0;
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
    depth = state.Space().GetGrid().depth;
    if (nextDepth_ == depth)
    {
      break;
    }
    done = 0.5 + 0.45 * done;
    state.options.space.depth = nextDepth_;
  }
  if (request.compare)
  {
    this->Compare(state, state.bridge.GetProgress().Part(0.5, 0.95));
  }
}

MultiVector EvaluateModes(
  const SurfaceSolverState& state, const Spectrum& spectrum, Id first, Id count, int threads)
{
  // The integral over grid units is spacing² times smaller than the one over world units.
  const MultiVector coefficients =
    spectrum.vectors.middleCols(first, count) / state.Space().GetGrid().spacing;
  return state.hats ? ValuesAtPoints(state.hats->functions, coefficients, threads)
                    : EvaluateAtPoints(state.Space(), coefficients, threads);
}

} // namespace gridfem
