#include "Held.h"

#include "Base/Errors.h"
#include "Problems/HeatDiffusion.h"
#include "Problems/SolveWarnings.h"

namespace gridfem
{
namespace
{

class DiffusionProblem : public Problem
{
public:
  explicit DiffusionProblem(Properties& properties)
    : options_(properties, { 0.0, 200, 1e-2 }),
      time_(properties.NumberFrom("DiffusionTime", 0.001, 0.0)),
      steps_(properties.Integer("NumberOfSteps", 1, 1, 10000)),
      holdsBoundary_(properties.Switch("BoundaryValues", false))
  {
    if (time_ == 0.0)
    {
      throw InvalidInput("DiffusionTime is 0: nothing spreads. It must be above 0.");
    }
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    CheckHeld(given, holdsBoundary_);
    const Surface surface(given, options_, progress.Part(0.0, 0.3));
    const Field start = given.FieldOf("values");
    Results results;
    DiffusionOptions options{ options_, time_ / steps_ / surface.WeightInSpaceUnits(1.0),
      TimeScheme::SecondOrder, {} };
    if (given.Find("held") || holdsBoundary_)
    {
      options.held = FindHeld(given, surface, options_, start, holdsBoundary_, results);
    }
    if ((steps_ > 1 || options.held.values.rows() > 0) && options.solve.tolerance == 0.0)
    {
      options.accuracy = 0.0;
      options.solve.tolerance = ToleranceOfSteps;
    }
    HeatDiffusion diffusion(surface.space,
      surface.space->LoadOfValues(start, surface.MakeJob(progress.Part(0.3, 0.4))), {}, options,
      surface.MakeJob(progress.Part(0.4, 0.5)));
    SolveReport last;
    for (int step = 0; step < steps_; ++step)
    {
      const double share = 0.45 / steps_;
      last = diffusion.Advance(
        surface.MakeJob(progress.Part(0.5 + step * share, 0.5 + (step + 1) * share)));
    }
    results.arrays["Diffused"] =
      surface.AtPoints(diffusion.Coefficients(), given.RowsAtPoints("values"));
    results.Warn(WarningOf(last, diffusion.Accuracy(), options.solve.tolerance));
    results.Warn(WarningOfConstraints(diffusion.Held()));
    return results;
  }

private:
  SurfaceOptions options_;
  double time_;
  int steps_;
  bool holdsBoundary_;
};

} // namespace

std::unique_ptr<Problem> MakeDiffusion(Properties& properties)
{
  return std::make_unique<DiffusionProblem>(properties);
}

} // namespace gridfem
