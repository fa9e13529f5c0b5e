#include "Solvers/FlowSolver.h"

#include "Base/Errors.h"
#include "Shape/MovedSurface.h"
#include "Solvers/LocalSurface.h"
#include "Solvers/SolveWarnings.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

Rescaling RescalingOf(const FlowSolver::Options& options)
{
  switch (options.rescale)
  {
    case FlowSolver::Rescale::None:
      return Rescaling::None;
    case FlowSolver::Rescale::ConstantArea:
      return Rescaling::ConstantArea;
    case FlowSolver::Rescale::ConstantVolume:
      return Rescaling::ConstantVolume;
    case FlowSolver::Rescale::Automatic:
      break;
  }
  return options.conformalized ? Rescaling::ConstantArea : Rescaling::None;
}

void RequireFlow(const FlowSolver::Options& options)
{
  RequireNumber("Time Step", options.timeStep);
  if (!(options.timeStep > 0.0) || std::isinf(options.timeStep))
  {
    throw InvalidInput("Time Step must be above 0 and finite.");
  }
  RequireOptions(options);
  if (options.conformalized && !options.trackMetric)
  {
    throw InvalidInput("Conformalized needs the functions of the input in every step. Turn Track "
                       "Metric on.");
  }
  if (options.fixedBoundary && (options.conformalized || RescalingOf(options) != Rescaling::None))
  {
    throw InvalidInput("Fixed Boundary holds the boundary in place, but Conformalized and Rescale "
                       "move the whole surface. Turn one of them off.");
  }
}

} // namespace

EquationOptions FlowSolver::OfStep()
{
  const FlowOptions step;
  EquationOptions equation;
  equation.multigrid = step.multigrid;
  equation.solve = step.solve;
  return equation;
}

void FlowSolver::Restart(const Surface& surface, const Options& options)
{
  FlowOptions flow;
  flow.timeStep = options.timeStep / surface.WeightInSpaceUnits(1.0);
  flow.conformalized = options.conformalized;
  flow.rescaling = RescalingOf(options);
  if (options.fixedBoundary)
  {
    flow.fixed = BoundaryOf(surface.Mesh(), surface.AreCoincidentPointsWelded(), surface.Threads());
  }
  flow.multigrid = options.equation.multigrid;
  flow.multigrid.threads = surface.Threads();
  flow.solve = options.equation.solve;
  if (!options.trackMetric)
  {
    SurfaceOptions own = surface.UsedOptions();
    own.space.weldCoincidentPoints = surface.AreCoincidentPointsWelded();
    flow.rebuild = [own](const TriangleMesh& moved, const Job& job)
    { return BuildSpace(moved, own.space, own.choice, job.progress); };
  }
  flow_.reset(); // frees its memory first
  flow_ = std::make_unique<MeanCurvatureFlow>(surface.WholeSpace(), surface.SharedMesh(), flow);
  kept_.clear();
  stride_ = 1;
  end_ = FlowEnd::None;
  made_.assign(1, Step{ flow_->Start(surface.Threads()), 1.0, 0.0 });
}

void FlowSolver::ReturnTo(int step)
{
  if (step == 0)
  {
    flow_->GoToStart();
  }
  else if (flow_->Step() != step)
  {
    flow_->GoTo(step, kept_.at(step));
  }
}

FlowStep FlowSolver::Advance(const Surface& surface, const Progress& progress)
{
  FlowStep step;
  StageKey key;
  key.Add(++advances_);
  surface.GetStages().Run(
    StepStage, key, [&] { step = flow_->Advance(surface.MakeJob(progress)); });
  return step;
}

/// Keeps the step that the flow has reached, because it is the last.
void FlowSolver::Keep()
{
  if (!kept_.empty() && kept_.rbegin()->first % stride_ != 0)
  {
    kept_.erase(std::prev(kept_.end()));
  }
  kept_[flow_->Step()] = flow_->Shape();
  this->KeepBudget();
}

/// Doubles the stride of the steps that are kept until they fit.
void FlowSolver::KeepBudget()
{
  const auto fits = [this]
  {
    const double each = kept_.empty() ? 0.0 : 8.0 * double(kept_.begin()->second.size());
    return kept_.size() <= 1 || each * double(kept_.size()) <= cacheBytes_;
  };
  while (!fits())
  {
    stride_ *= 2;
    for (auto shape = kept_.begin(); shape != std::prev(kept_.end());)
    {
      shape = shape->first % stride_ == 0 ? std::next(shape) : kept_.erase(shape);
    }
  }
}

/// Describes a step in world units, with the numbers that the flow itself does not measure.
FlowSolver::Step FlowSolver::Measured(const FlowStep& made, const Surface& surface) const
{
  const TriangleMesh& mesh = surface.Mesh();
  const Job job = surface.MakeJob({});
  const MapDistortion map = DistortionOf(mesh, flow_->Points(job), job.threads);
  Step step{ made, MeanOverSurface(mesh, map.stretchRatio, job.threads),
    surface.GetStages().Seconds(StepStage) };
  const double unit = surface.Space().UnitLength();
  step.time = made.time * unit * unit;
  return step;
}

/// @return  whether a step was made or the flow has ended
bool FlowSolver::MakeSteps(const Surface& surface, const Progress& progress)
{
  const int first = static_cast<int>(made_.size()) - 1;
  const bool goesOn = first < wanted_ && end_ == FlowEnd::None;
  for (int step = first; step < wanted_ && end_ == FlowEnd::None; ++step)
  {
    const double share = 1.0 / (wanted_ - first);
    const Progress part = progress.Part((step - first) * share, (step - first + 1) * share);
    this->ReturnTo(step);
    const FlowStep next = this->Advance(surface, part);
    end_ = next.end;
    if (end_ == FlowEnd::None)
    {
      made_.push_back(this->Measured(next, surface));
      this->Keep();
    }
    part.Check(1.0);
  }
  return goesOn;
}

const FlowSolver::Result& FlowSolver::Update(
  Surface& surface, const Options& options, const Job& job)
{
  RequireFlow(options);
  surface.Prepare(job.progress.Part(0.0, 0.2));
  Options ofStep = options; // a number of steps or another name of the rescaling changes no step
  ofStep.numberOfSteps = 0;
  ofStep.rescale = Rescale::Automatic;
  StageKey key;
  key.Add(surface.GetStages().Version(SystemStage)).Add(surface.WeightInSpaceUnits(1.0));
  key.Add(KeyOfOptions(ofStep)).Add(RescalingOf(options));
  wanted_ = options.numberOfSteps;
  surface.GetStages().Run(HierarchyStage, key, [&] { this->Restart(surface, options); });
  const bool isNew = this->MakeSteps(surface, job.progress.Part(0.2, 1.0));
  const auto count = std::min(made_.size(), static_cast<std::size_t>(wanted_) + 1);
  result_.steps.assign(made_.begin(), made_.begin() + static_cast<std::ptrdiff_t>(count));
  result_.warnings.clear();
  const std::string warning = isNew ? this->Warning(surface, options.conformalized) : "";
  if (!warning.empty())
  {
    result_.warnings.push_back(warning);
  }
  return result_;
}

std::vector<Vec3> FlowSolver::PointsAt(int step, const Surface& surface, const Progress& progress)
{
  if (step == 0)
  {
    return surface.Mesh().points;
  }
  const auto after = kept_.upper_bound(step);
  const int nearest = after == kept_.begin() ? 0 : std::prev(after)->first;
  if (flow_->Step() < nearest || flow_->Step() > step)
  {
    this->ReturnTo(nearest);
  }
  const int first = flow_->Step();
  FlowEnd end = FlowEnd::None;
  while (flow_->Step() < step && end == FlowEnd::None)
  {
    const double share = 1.0 / (step - first);
    const int done = flow_->Step() - first;
    end = this->Advance(surface, progress.Part(done * share, (done + 1) * share)).end;
  }
  return flow_->Points(surface.MakeJob(progress));
}

bool FlowSolver::HasConverged(int step) const
{
  const std::vector<Step>& steps = result_.steps;
  return static_cast<int>(steps.size()) > wanted_ &&
         std::all_of(steps.begin(), steps.begin() + step + 1,
           [](const Step& made) { return made.converged; });
}

std::string FlowSolver::Warning(const Surface& surface, bool conformalized) const
{
  FlowSummary flow;
  flow.steps = static_cast<int>(result_.steps.size()) - 1;
  flow.wanted = wanted_;
  flow.end = end_;
  flow.unconverged = static_cast<int>(std::count_if(
    result_.steps.begin(), result_.steps.end(), [](const Step& step) { return !step.converged; }));
  return WarningOf(flow, conformalized, surface.Mesh());
}

FlowSolver::Result FlowSolver::Solve(std::shared_ptr<const TriangleMesh> mesh,
  const Options& options, std::vector<Vec3>& points, const SurfaceOptions& surfaceOptions,
  const Job& job)
{
  Stages stages;
  LocalSurface surface(stages, std::move(mesh), surfaceOptions);
  FlowSolver solver;
  const Result result = solver.Update(surface, options, job);
  points = solver.PointsAt(static_cast<int>(result.steps.size()) - 1, surface);
  return result;
}

} // namespace gridfem
