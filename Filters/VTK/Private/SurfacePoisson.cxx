#include "SurfacePoisson.h"

#include <algorithm>

namespace gridfem
{
namespace
{

const SurfaceSpace& SpaceOf(const SurfaceSolverState& state, const PoissonRequest& request)
{
  return request.space ? *request.space : *state.SolverSpace();
}

} // namespace

void SurfacePoisson::Update(SurfaceSolverState& state, StageKey fields, const Integrate& integrate,
  const PoissonRequest& request, const Progress& progress)
{
  fields.Add(state.stages.Version(SystemStage)).Add(request.numbers);
  state.stages.Run(RightHandSideStage, fields,
    [&] { load_ = integrate(SpaceOf(state, request), state.MakeJob(progress.Part(0.0, 0.2))); });
  progress.Check(0.2);
  this->UpdateHierarchy(state, request, progress.Part(0.2, 0.4));
  progress.Check(0.4);
  this->Solve(state, request, progress.Part(0.4, 1.0));
}

void SurfacePoisson::UpdateHierarchy(
  SurfaceSolverState& state, const PoissonRequest& request, const Progress& progress)
{
  const SurfaceSpace& space = SpaceOf(state, request);
  const double weight = state.WeightInGridUnits(request.weight);
  StageKey shape;
  shape.Add(state.StructureVersion());
  AddMultigrid(shape, state.options.multigrid);
  StageKey key = shape;
  key.Add(state.stages.Version(SystemStage)).Add(request.numbers).Add(weight);
  state.stages.Run(HierarchyStage, key,
    [&]
    {
      // Other threads give the same bits: no reason to run, but used where it runs.
      if (multigrid_ && shape_ == shape && !state.together.IsUsed() &&
          multigrid_->Options().threads == state.options.multigrid.threads)
      {
        UpdateMultigrid(space, weight, 1.0, *multigrid_);
        return;
      }
      multigrid_.reset(); // frees its memory first
      multigrid_ = std::make_unique<Multigrid>(
        BuildMultigrid(space, weight, 1.0, state.options.multigrid, progress));
      shape_ = shape;
    });
}

/// Null where there is none to start from.
/// @param resized  holds it where it has other columns than the last one
const MultiVector* SurfacePoisson::Start(
  const PoissonRequest& request, bool isSameSolver, MultiVector& resized) const
{
  const MultiVector& last = solution_.coefficients;
  const Id columns = load_.values.cols();
  if (last.cols() == columns)
  {
    return isSameSolver || request.goesOn ? &last : nullptr;
  }
  if (!request.goesOn || last.cols() == 0)
  {
    return nullptr;
  }
  resized = last;
  resized.conservativeResize(Eigen::NoChange, columns);
  resized.rightCols(std::max<Id>(columns - last.cols(), 0)).setZero();
  return &resized;
}

void SurfacePoisson::Solve(
  SurfaceSolverState& state, const PoissonRequest& request, const Progress& progress)
{
  StageKey key;
  key.Add(state.stages.Version(HierarchyStage)).Add(state.stages.Version(RightHandSideStage));
  key.Add(request.gradientScale);
  AddSolver(key, state.options);
  state.stages.Run(SolveStage, key,
    [&]
    {
      PoissonOptions options{ state.options };
      options.screeningWeight = state.WeightInGridUnits(request.weight);
      options.estimateErrors = true;
      StageKey solver = shape_; // other options show their own iterations, from the usual start
      solver.Add(state.stages.Version(SystemStage)).Add(request.numbers);
      AddSolver(solver, state.options);
      MultiVector resized;
      options.start =
        state.together.IsUsed() ? nullptr : this->Start(request, solvedWith_ == solver, resized);
      MultiVector scaled;
      if (request.gradientScale != 1.0)
      {
        scaled = request.gradientScale * load_.gradients;
      }
      solvedWith_ = {};
      solution_ = SolvePoisson(SpaceOf(state, request), *multigrid_, load_.values,
        request.gradientScale != 1.0 ? scaled : load_.gradients, options, progress);
      if (state.together.IsUsed())
      {
        solution_.accuracy.largest = state.together.Largest(solution_.accuracy.largest);
      }
      solvedWith_ = solver;
    });
}

MultiVector SurfacePoisson::Values(const SurfaceSolverState& state) const
{
  return state.ValuesAtPoints(solution_.coefficients);
}

} // namespace gridfem
