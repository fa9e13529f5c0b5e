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

struct NamedDefects
{
  const char* name;
  Defects defects;
};

constexpr NamedDefects DefectRows[] = { { "near seams", { true, false, false, false, false } },
  { "hanging nodes", { false, true, false, false, false } },
  { "turned faces", { false, false, true, false, false } },
  { "copied faces", { false, false, false, true, false } },
  { "masks", { false, false, false, false, true } },
  { "all defects", { true, true, true, true, true } } };

template<class Run>
void RunGuarded(Outcome& outcome, const Run& run)
{
  try
  {
    run();
  }
  catch (const InvalidInput& error)
  {
    outcome.refusal = error.what();
  }
  catch (const std::exception& error)
  {
    outcome.broken = { std::string("exception: ") + error.what() };
  }
}

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
  RunGuarded(outcome,
    [&]
    {
      problem.run(choice, surface, outcome);
      if (!surface.isChecked)
      {
        outcome.broken.clear(); // results on an invalid surface need not be meaningful
      }
    });
  return outcome;
}

Outcome RunDefectCase(std::uint64_t seed)
{
  Choice choice(seed);
  const NamedDefects& row = DefectRows[choice.Integer(0, std::size(DefectRows) - 1)];
  Outcome outcome;
  outcome.problem = row.name;
  outcome.isDefault = true;
  RunGuarded(outcome, [&] { CompareWithClean(choice, row.defects, outcome); });
  outcome.Require(outcome.refusal.empty(), "a surface with defects is refused");
  return outcome;
}

} // namespace gridfem::testing
