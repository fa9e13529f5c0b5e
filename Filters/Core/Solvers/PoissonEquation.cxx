#include "Solvers/PoissonEquation.h"

#include "Solvers/OptionFields.h"

#include <algorithm>
#include <utility>

namespace gridfem
{
namespace
{

const SurfaceSpace& SpaceOf(const Surface& surface, const PoissonRequest& request)
{
  return request.space ? *request.space : surface.Space();
}

} // namespace

void PoissonEquation::Update(const Surface& surface, StageKey fields, const Integrate& integrate,
  const PoissonRequest& request, EquationOptions options, const Progress& progress)
{
  options.multigrid.threads = surface.Threads();
  fields.Add(surface.GetStages().Version(SystemStage)).Add(request.numbers);
  surface.GetStages().Run(RightHandSideStage, fields,
    [&]
    { load_ = integrate(SpaceOf(surface, request), surface.MakeJob(progress.Part(0.0, 0.2))); });
  progress.Check(0.2);
  this->UpdateHierarchy(surface, request, options, progress.Part(0.2, 0.4));
  progress.Check(0.4);
  this->Solve(surface, request, options, progress.Part(0.4, 1.0));
}

void PoissonEquation::UpdateHierarchy(const Surface& surface, const PoissonRequest& request,
  const EquationOptions& options, const Progress& progress)
{
  const SurfaceSpace& space = SpaceOf(surface, request);
  const double weight = surface.WeightInSpaceUnits(request.weight);
  EquationOptions ofHierarchy;
  ofHierarchy.multigrid = options.multigrid;
  StageKey shape;
  shape.Add(surface.StructureVersion()).Add(KeyOf(ofHierarchy));
  StageKey key = shape;
  key.Add(surface.GetStages().Version(SystemStage)).Add(request.numbers).Add(weight);
  surface.GetStages().Run(HierarchyStage, key,
    [&]
    {
      // The number of threads changes no bit. It alone does not repeat the stage.
      if (multigrid_ && shape_ == shape && !surface.IsShared() &&
          multigrid_->Options().threads == options.multigrid.threads)
      {
        UpdateMultigrid(space, weight, 1.0, *multigrid_);
        return;
      }
      multigrid_.reset(); // frees its memory first
      multigrid_ = std::make_unique<Multigrid>(
        BuildMultigrid(space, weight, 1.0, options.multigrid, progress));
      shape_ = shape;
    });
}

/// Null if there is no solution to start from.
/// @param resized  holds the start when the last solution has another number of columns
const MultiVector* PoissonEquation::Start(
  const PoissonRequest& request, bool isSameSolver, MultiVector& resized) const
{
  const MultiVector& last = solution_.coefficients;
  const Id columns = load_.values.cols();
  if (last.cols() == columns)
  {
    return isSameSolver || request.startsFromLast ? &last : nullptr;
  }
  if (!request.startsFromLast || last.cols() == 0)
  {
    return nullptr;
  }
  resized = last;
  resized.conservativeResize(Eigen::NoChange, columns);
  resized.rightCols(std::max<Id>(columns - last.cols(), 0)).setZero();
  return &resized;
}

void PoissonEquation::Solve(const Surface& surface, const PoissonRequest& request,
  const EquationOptions& options, const Progress& progress)
{
  const Stages& stages = surface.GetStages();
  StageKey key;
  key.Add(stages.Version(HierarchyStage)).Add(stages.Version(RightHandSideStage));
  key.Add(request.gradientScale).Add(KeyOf(options));
  surface.GetStages().Run(SolveStage, key,
    [&]
    {
      PoissonOptions ofSolve;
      static_cast<EquationOptions&>(ofSolve) = options;
      ofSolve.screeningWeight = surface.WeightInSpaceUnits(request.weight);
      ofSolve.estimateErrors = true;
      StageKey solver = shape_; // other options show their own iterations, from the usual start
      solver.Add(stages.Version(SystemStage)).Add(request.numbers).Add(KeyOf(options));
      MultiVector resized;
      ofSolve.start =
        surface.IsShared() ? nullptr : this->Start(request, solvedWith_ == solver, resized);
      MultiVector scaled;
      if (request.gradientScale != 1.0)
      {
        scaled = request.gradientScale * load_.gradients;
      }
      solvedWith_ = {};
      solution_ = SolvePoisson(SpaceOf(surface, request), *multigrid_, load_.values,
        request.gradientScale != 1.0 ? scaled : load_.gradients, ofSolve, progress);
      solution_.accuracy.largest = surface.Largest(solution_.accuracy.largest);
      solvedWith_ = solver;
    });
}

} // namespace gridfem
