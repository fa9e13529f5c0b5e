#include "Problem.h"

#include "Problems/DepthSearch.h"
#include "Problems/Requirements.h"
#include "Problems/SolveWarnings.h"
#include "Problems/Spectrum.h"

#include <algorithm>

namespace gridfem
{
namespace
{

class SpectrumProblem : public Problem
{
public:
  explicit SpectrumProblem(Properties& properties)
    : options_(properties, { 1e-6, 100, 1e-12, CycleType::V }),
      modes_(properties.Integer("NumberOfModes", 20, 1, 100000)),
      accuracy_(properties.Number("Accuracy", 0.0, 0.0, 0.5))
  {
    options_.functionsPerPoint = EnoughToEstimate;
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    EngineOptions options = options_;
    if (accuracy_ > 0.0)
    {
      RequireSurface(*given.mesh);
      options =
        options_.AtDepth(FirstDepthForModes(*given.mesh, modes_, accuracy_, options_.choice.kind));
    }
    for (double done = 0.0;; done = 0.5 + 0.5 * done)
    {
      const Progress part = progress.Part(done, accuracy_ > 0.0 ? 0.5 + 0.5 * done : 1.0);
      const EngineSurface surface(given, options, part.Part(0.0, 0.5));
      const SpectrumOptions solver = this->SolverOptions(surface.Space());
      Spectrum nested = ComputeNestedSpectrum(surface.Space(), solver, part.Part(0.5, 0.7));
      const int next = this->NextDepth(surface, nested);
      if (next == surface.options.functions.depth)
      {
        return this->ResultsOf(surface,
          FinishSpectrum(surface.Space(), std::move(nested), solver, part.Part(0.7, 0.95)));
      }
      options = options_.AtDepth(next);
    }
  }

private:
  SpectrumOptions SolverOptions(const FiniteElementSpace& space) const
  {
    const Index nested = space.NestedLevels() ? space.NumberOfFunctions(1) : 0;
    RequireMemoryForModes(space.NumberOfFunctions(0) + nested, modes_, options_.functions.threads);
    SpectrumOptions options;
    options.numberOfModes = modes_;
    options.tolerance = options_.solve.tolerance;
    options.maximumIterations = options_.solve.maximumIterations;
    options.multigrid = options_.multigrid;
    return options;
  }

  int NextDepth(const EngineSurface& surface, const Spectrum& nested) const
  {
    const int depth = surface.options.functions.depth;
    std::vector<double> errors = nested.estimatedErrors;
    if (surface.Space().NestedLevels()) // guards have been computed, too
    {
      errors.resize(std::min<std::size_t>(errors.size(), modes_));
    }
    return accuracy_ > 0.0
             ? NextDepthForModes(surface.Mesh(), errors, depth, accuracy_, options_.choice.kind)
             : depth;
  }

  Results ResultsOf(const EngineSurface& surface, const Spectrum& spectrum) const
  {
    // The integral over the space's units is UnitLength² times smaller than that over the world's.
    const FiniteElementSpace& space = surface.Space();
    const double unit = space.UnitLength();
    Results results;
    results.arrays["Modes"] =
      space.ValuesAtPoints(spectrum.vectors / unit, options_.functions.threads);
    results.arrays["Eigenvalues"] = Eigen::Map<const Eigen::VectorXd>(spectrum.eigenvalues.data(),
                                      static_cast<Id>(spectrum.eigenvalues.size())) /
                                    (unit * unit);
    const int depth = surface.options.functions.depth;
    const FunctionKind kind = options_.choice.kind;
    results.warnings = WarningsOf(spectrum, modes_, PlaceOf(kind, depth), true);
    const std::vector<double>& errors = spectrum.estimatedErrors;
    const double error = errors.empty() ? 0.0 : *std::max_element(errors.begin(), errors.end());
    if (accuracy_ > 0.0 && !(error <= accuracy_))
    {
      results.Warn(WarningOfAccuracy(accuracy_, error, kind, depth));
    }
    return results;
  }

  EngineOptions options_;
  int modes_;
  double accuracy_;
};

} // namespace

std::unique_ptr<Problem> MakeSpectrum(Properties& properties)
{
  return std::make_unique<SpectrumProblem>(properties);
}

} // namespace gridfem
