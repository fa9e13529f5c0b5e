#include "SurfacePoisson.h"

namespace gridfem
{
void SurfacePoisson::Update(SurfaceSolverState& state, StageKey fields, const Integrate& integrate,
  const PoissonRequest& request, const Progress& progress)
{
  fields.Add(state.stages.Version(SystemStage));
  state.stages.Run(RightHandSideStage, fields,
    [&] { load_ = integrate(*state.SolverSpace(), state.MakeJob(progress.Part(0.0, 0.2))); });
  progress.Check(0.2);
  const double weight = state.WeightInGridUnits(request.weight);
  this->UpdateHierarchy(state, weight, progress.Part(0.2, 0.4));
  progress.Check(0.4);
  this->Solve(state, request, progress.Part(0.4, 1.0));
}

void SurfacePoisson::UpdateHierarchy(
  SurfaceSolverState& state, double weight, const Progress& progress)
{
  StageKey shape;
  shape.Add(state.StructureVersion());
  AddMultigrid(shape, state.options.multigrid);
  StageKey key = shape;
  key.Add(state.stages.Version(SystemStage)).Add(weight);
  state.stages.Run(HierarchyStage, key,
    [&]
    {
      // Other threads give the same bits: no reason to run, but used where it runs.
      if (multigrid_ && shape_ == shape && !state.together.IsUsed() &&
          multigrid_->Options().threads == state.options.multigrid.threads)
      {
        UpdateMultigrid(*state.space, weight, 1.0, *multigrid_);
        return;
      }
      multigrid_.reset(); // frees its memory first
      multigrid_ = std::make_unique<Multigrid>(
        BuildMultigrid(*state.SolverSpace(), weight, 1.0, state.options.multigrid, progress));
      shape_ = shape;
    });
}

void SurfacePoisson::Solve(
  SurfaceSolverState& state, const PoissonRequest& request, const Progress& progress)
{
  StageKey key;
  key.Add(state.stages.Version(HierarchyStage)).Add(state.stages.Version(RightHandSideStage));
  key.Add(request.gradientScale).Add(static_cast<int>(request.iteration));
  AddSolver(key, state.options);
  state.stages.Run(SolveStage, key,
    [&]
    {
      PoissonOptions options;
      options.screeningWeight = state.WeightInGridUnits(request.weight);
      options.multigrid = state.options.multigrid;
      options.iteration = request.iteration;
      options.solve = state.options.solve;
      options.accuracy = state.options.accuracy;
      options.estimateErrors = true;
      StageKey solver = shape_; // other options show their own iterations, from the usual start
      solver.Add(state.stages.Version(SystemStage)).Add(static_cast<int>(request.iteration));
      AddSolver(solver, state.options);
      const bool hasStart = solvedWith_ == solver && !state.together.IsUsed();
      const MultiVector last = hasStart ? std::move(solution_.coefficients) : MultiVector();
      options.start = hasStart ? &last : nullptr;
      solvedWith_ = {};
      const MultiVector gradients = request.gradientScale * load_.gradients;
      solution_ =
        SolvePoisson(*state.SolverSpace(), *multigrid_, load_.values, gradients, options, progress);
      if (state.together.IsUsed())
      {
        solution_.accuracy.largest = state.together.Largest(solution_.accuracy.largest);
      }
      solvedWith_ = solver;
    });
}

MultiVector SurfacePoisson::Gradients(const SurfaceSolverState& state) const
{
  return state.OnCurrent(
    state.SolverSpace()->GradientsOnTriangles(solution_.coefficients, state.options.space.threads));
}

MultiVector SurfacePoisson::Values(const SurfaceSolverState& state) const
{
  return state.ValuesAtPoints(solution_.coefficients);
}

} // namespace gridfem
