#include "Problem.h"

#include "Problems/Requirements.h"
#include "Problems/SolveWarnings.h"
#include "Problems/Spectrum.h"

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
      completes_(properties.Switch("CompleteMultiplets", true))
  {
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    const Surface surface(given, options_, progress.Part(0.0, 0.5));
    const FiniteElementSpace& space = surface.Space();
    const int threads = options_.functions.threads;
    const Index nested = space.NestedLevels() ? space.NumberOfFunctions(1) : 0;
    RequireMemoryForModes(space.NumberOfFunctions(0) + nested, modes_, threads);
    SpectrumOptions options;
    options.numberOfModes = modes_;
    options.tolerance = options_.solve.tolerance;
    options.maximumIterations = options_.solve.maximumIterations;
    options.multigrid = options_.multigrid;
    options.completeMultiplets = completes_;
    const Spectrum spectrum = ComputeSpectrum(space, options, progress.Part(0.5, 0.95));

    // The integral over the space's units is UnitLength² times smaller than that over the world's.
    const double unit = space.UnitLength();
    Results results;
    results.arrays["Modes"] = space.ValuesAtPoints(spectrum.vectors / unit, threads);
    results.arrays["Eigenvalues"] = Eigen::Map<const Eigen::VectorXd>(spectrum.eigenvalues.data(),
                                      static_cast<Id>(spectrum.eigenvalues.size())) /
                                    (unit * unit);
    const std::string where = options_.IsOnHats()
                                ? "with the hat functions of this mesh"
                                : "at Depth " + std::to_string(surface.options.functions.depth);
    results.warnings = WarningsOf(spectrum, modes_, where, true);
    return results;
  }

private:
  SurfaceOptions options_;
  int modes_;
  bool completes_;
};

} // namespace

std::unique_ptr<Problem> MakeSpectrum(Properties& properties)
{
  return std::make_unique<SpectrumProblem>(properties);
}

} // namespace gridfem
