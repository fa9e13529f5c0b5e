#include "Problem.h"

#include "Base/Errors.h"
#include "Base/VectorRows.h"
#include "Problems/MovedSurface.h"
#include "Problems/SolveWarnings.h"

namespace gridfem
{
namespace
{

class FlowProblem : public Problem
{
public:
  explicit FlowProblem(Properties& properties)
    : options_(properties, { 5e-4, 100, 1e-12, CycleType::V }),
      timeStep_(properties.FiniteNumber("TimeStep", 5e-5)),
      steps_(properties.Integer("NumberOfSteps", 10, 1, 100000)),
      isConformalized_(properties.Switch("Conformalized", false)),
      tracksMetric_(properties.Switch("TrackMetric", true)),
      fixesBoundary_(properties.Switch("FixedBoundary", false)),
      rescaling_(RescalingOf(properties.Integer("Rescale", 0, 0, 3)))
  {
    this->Check();
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    const EngineSurface surface(given, options_, progress.Part(0.0, 0.2));
    MeanCurvatureFlow flow(surface.space, surface.mesh, this->OptionsOf(surface));
    FlowSummary summary;
    summary.wanted = steps_;
    while (summary.steps < steps_ && summary.end == FlowEnd::None)
    {
      const double share = 0.75 / steps_;
      const double done = 0.2 + share * summary.steps;
      const FlowStep step = flow.Advance(surface.MakeJob(progress.Part(done, done + share)));
      summary.end = step.end;
      if (step.end == FlowEnd::None)
      {
        ++summary.steps;
        summary.unconverged += step.converged ? 0 : 1;
      }
    }
    Results results;
    results.arrays["Points"] =
      RowsOf(summary.steps == 0 ? surface.Mesh().points : flow.Points(surface.MakeJob({})));
    results.Warn(WarningOf(summary, isConformalized_, surface.Mesh()));
    return results;
  }

private:
  /// By the number of the filter's property.
  Rescaling RescalingOf(int rescale) const
  {
    switch (rescale)
    {
      case 1:
        return Rescaling::None;
      case 2:
        return Rescaling::ConstantArea;
      case 3:
        return Rescaling::ConstantVolume;
      default:
        return isConformalized_ ? Rescaling::ConstantArea : Rescaling::None;
    }
  }

  void Check() const
  {
    if (!(timeStep_ > 0.0))
    {
      throw InvalidInput("TimeStep must be above 0 and finite.");
    }
    if (isConformalized_ && !tracksMetric_)
    {
      throw InvalidInput("Conformalized keeps the stiffness of the input on its functions, so "
                         "TrackMetric has to be on.");
    }
    if (fixesBoundary_ && (isConformalized_ || rescaling_ != Rescaling::None))
    {
      throw InvalidInput("FixedBoundary holds the boundary where it is, but Conformalized and "
                         "Rescale move all of the surface.");
    }
  }

  FlowOptions OptionsOf(const EngineSurface& surface) const
  {
    FlowOptions options;
    options.timeStep = timeStep_ / surface.WeightInSpaceUnits(1.0);
    options.conformalized = isConformalized_;
    options.rescaling = rescaling_;
    if (fixesBoundary_)
    {
      options.fixed = BoundaryOf(
        surface.Mesh(), options_.functions.weldCoincidentPoints, options_.functions.threads);
    }
    options.multigrid = options_.multigrid;
    options.solve = options_.solve;
    if (!tracksMetric_)
    {
      options.rebuild = [own = surface.options](const TriangleMesh& moved, const Job& job)
      { return BuildSpace(moved, own.functions, own.choice, job.progress); };
    }
    return options;
  }

  EngineOptions options_;
  double timeStep_;
  int steps_;
  bool isConformalized_;
  bool tracksMetric_;
  bool fixesBoundary_;
  Rescaling rescaling_;
};

} // namespace

std::unique_ptr<Problem> MakeFlow(Properties& properties)
{
  return std::make_unique<FlowProblem>(properties);
}

} // namespace gridfem
