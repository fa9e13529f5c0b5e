#include "SurfaceFlow.h"

#include "Base/Errors.h"
#include "Problems/MovedSurface.h"
#include "Problems/SolveWarnings.h"

#include <algorithm>

namespace gridfem
{

void SurfaceFlow::Restart(SurfaceSolverState& state)
{
  FlowOptions options;
  options.timeStep = request_.timeStep / state.WeightInSpaceUnits(1.0);
  options.conformalized = request_.conformalized;
  options.rescaling = request_.rescaling;
  if (request_.fixedBoundary)
  {
    options.fixed = BoundaryOf(
      *state.mesh.triangles, state.basis.weldCoincidentPoints, state.Threads());
  }
  options.multigrid = state.options.multigrid;
  options.solve = state.options.solve;
  if (!request_.trackMetric)
  {
    SpaceOptions functions = state.options.space;
    functions.depth = state.Functions().GetGrid().depth;
    functions.connectivityAware = state.Functions().support == FunctionSupport::ConnectivityAware;
    functions.weldCoincidentPoints = state.basis.weldCoincidentPoints;
    options.rebuild = [functions, choice = state.options.choice](
                        const TriangleMesh& moved, const Job& job)
    { return BuildSpace(moved, functions, choice, job.progress); };
  }
  flow_.reset(); // frees its memory first
  flow_ = std::make_unique<MeanCurvatureFlow>(state.space, state.mesh.triangles, options);
  kept_.clear();
  stride_ = 1;
  end_ = FlowEnd::None;
  rows_.assign(1, FlowRow{ flow_->Start(state.Threads()), 1.0, 0.0 });
}

void SurfaceFlow::ReturnTo(int step)
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

FlowStep SurfaceFlow::Advance(SurfaceSolverState& state, const Progress& progress)
{
  FlowStep step;
  StageKey key;
  key.Add(++advances_);
  state.stages.Run(StepStage, key, [&] { step = flow_->Advance(state.MakeJob(progress)); });
  return step;
}

/// Keeps the step that the flow has come to, for it is the last.
void SurfaceFlow::Keep()
{
  if (!kept_.empty() && kept_.rbegin()->first % stride_ != 0)
  {
    kept_.erase(std::prev(kept_.end()));
  }
  kept_[flow_->Step()] = flow_->Shape();
  this->KeepBudget();
}

/// Doubles the stride of the steps that are kept until they fit.
void SurfaceFlow::KeepBudget()
{
  const auto fits = [this]
  {
    const double each = kept_.empty() ? 0.0 : 8.0 * double(kept_.begin()->second.size());
    return kept_.size() <= 1 || each * double(kept_.size()) <= request_.keptBytes;
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

bool SurfaceFlow::Update(
  SurfaceSolverState& state, const FlowRequest& request, const Progress& progress)
{
  StageKey key;
  key.Add(state.stages.Version(SystemStage)).Add(state.WeightInSpaceUnits(1.0));
  key.Add(request.timeStep).Add(request.conformalized).Add(request.trackMetric);
  key.Add(request.fixedBoundary);
  key.Add(static_cast<int>(request.rescaling));
  key.Add(state.options.solve.tolerance).Add(state.options.solve.maximumIterations);
  AddMultigrid(key, state.options.multigrid);
  request_ = request;
  state.stages.Run(HierarchyStage, key, [&] { this->Restart(state); });
  this->KeepBudget();

  const int made = static_cast<int>(rows_.size()) - 1;
  const bool goesOn = made < request.numberOfSteps && end_ == FlowEnd::None;
  for (int step = made; step < request.numberOfSteps && end_ == FlowEnd::None; ++step)
  {
    const double share = 1.0 / (request.numberOfSteps - made);
    const Progress part = progress.Part((step - made) * share, (step - made + 1) * share);
    this->ReturnTo(step);
    const FlowStep next = this->Advance(state, part);
    end_ = next.end;
    if (end_ == FlowEnd::None)
    {
      const Job job = state.MakeJob({});
      const MapDistortion map =
        DistortionOf(*state.mesh.triangles, flow_->Points(job), job.threads);
      rows_.push_back({ next, MeanOverSurface(*state.mesh.triangles, map.stretchRatio, job.threads),
        state.stages.Seconds(StepStage) });
      this->Keep();
    }
    part.Check(1.0);
  }
  return goesOn;
}

std::vector<FlowRow> SurfaceFlow::Rows() const
{
  const auto count = std::min(rows_.size(), static_cast<std::size_t>(request_.numberOfSteps) + 1);
  return { rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(count) };
}

std::vector<Vec3> SurfaceFlow::PointsAt(
  int step, SurfaceSolverState& state, const Progress& progress)
{
  if (step == 0)
  {
    return state.mesh.triangles->points;
  }
  const auto after = kept_.upper_bound(step);
  const int nearest = after == kept_.begin() ? 0 : std::prev(after)->first;
  if (flow_->Step() < nearest || flow_->Step() > step)
  {
    this->ReturnTo(nearest);
  }
  const int first = flow_->Step();
  while (flow_->Step() < step)
  {
    const double share = 1.0 / (step - first);
    const int done = flow_->Step() - first;
    this->Advance(state, progress.Part(done * share, (done + 1) * share));
  }
  return flow_->Points(state.MakeJob(progress));
}

std::string SurfaceFlow::Warning(const SurfaceSolverState& state) const
{
  const std::vector<FlowRow> rows = this->Rows();
  FlowSummary flow;
  flow.steps = static_cast<int>(rows.size()) - 1;
  flow.wanted = request_.numberOfSteps;
  flow.end = end_;
  flow.unconverged = static_cast<int>(
    std::count_if(rows.begin(), rows.end(), [](const FlowRow& row) { return !row.converged; }));
  return WarningOf(flow, request_.conformalized, *state.mesh.triangles);
}

} // namespace gridfem
