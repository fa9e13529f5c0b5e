#include "RandomProblem.h"

#include "Base/Errors.h"

namespace gridfem::testing
{
namespace
{

struct NamedProblem
{
  const char* name;
  RandomProblem run;
  bool isDefault = false;
};

constexpr NamedProblem Problems[] = { { "clip", CheckClip }, { "spaces", CheckSpaces },
  { "metric", CheckMetric }, { "Poisson by default", SolveDefaultPoisson, true },
  { "Poisson by default", SolveDefaultPoisson, true }, { "Poisson", SolveAnyPoisson },
  { "constraints", SolveWithConstraints }, { "spectrum", FindSpectrum },
  { "distance", FindDistance }, { "heat", Diffuse }, { "interpolation", Interpolate },
  { "stitching", Stitch }, { "flow", Flow }, { "detail", ChangeDetail },
  { "curvatures", FindCurvatures }, { "Hodge", Decompose }, { "derivatives", Derive } };

} // namespace

Outcome RunCase(std::uint64_t seed)
{
  Choice choice(seed);
  const NamedProblem& problem = Problems[choice.Integer(0, std::size(Problems) - 1)];
  RandomSurface surface = MakeRandomSurface(choice, problem.isDefault);
  Outcome outcome;
  outcome.problem = problem.name;
  outcome.description = surface.Describe();
  outcome.isDefault = problem.isDefault;
  try
  {
    problem.run(choice, surface, outcome);
    if (!surface.isChecked)
    {
      outcome.broken.clear(); // results on an invalid surface need not be meaningful
    }
  }
  catch (const InvalidInput& error)
  {
    outcome.refusal = error.what();
  }
  catch (const std::exception& error)
  {
    outcome.broken = { std::string("exception: ") + error.what() };
  }
  return outcome;
}

} // namespace gridfem::testing
