#include "Solvers/DiffusionSolver.h"

#include "Base/Errors.h"
#include "Solvers/LocalSurface.h"
#include "Solvers/SolveWarnings.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

void RequireInput(const DiffusionSolver::Input& input, const DiffusionSolver::Options& options)
{
  RequireOptions(options);
  if (options.diffusionTime == 0.0)
  {
    throw InvalidInput("Diffusion Time is 0, so nothing spreads. It must be above 0.");
  }
  const Id components = ComponentsOf(input.values);
  if (input.source && input.source.components != components)
  {
    throw InvalidInput("Heat Source Array '" + input.source.name + "' has " +
                       std::to_string(input.source.components) + " components instead of the " +
                       std::to_string(components) + " of the Array.");
  }
  RequireHoldable(input.values, input.constraints, options.boundaryValues);
}

/// The errors of several steps add up, and held values are met by steps of their own. Neither
/// therefore ends by an estimated error.
EquationOptions EquationOfSteps(
  const DiffusionSolver::Options& options, bool holdsValues, int threads)
{
  EquationOptions equation = options.equation;
  equation.multigrid.threads = threads;
  if ((options.numberOfSteps > 1 || holdsValues) && equation.solve.tolerance == 0.0)
  {
    equation.accuracy = 0.0;
    equation.solve.tolerance = ToleranceOfSteps;
  }
  return equation;
}

} // namespace

SurfaceOptions DiffusionSolver::SurfaceDefaults()
{
  SurfaceOptions options;
  options.choice.normalStabilization = 1e-2;
  return options;
}

const DiffusionSolver::Result& DiffusionSolver::Update(
  Surface& surface, const Input& input, const Options& options, const Job& job)
{
  RequireInput(input, options);
  surface.Prepare(job.progress.Part(0.0, 0.3));
  job.Check(0.3);
  const bool holdsValues = input.constraints || options.boundaryValues;
  result_.equation = EquationOfSteps(options, holdsValues, surface.Threads());
  this->UpdateLoads(surface, input, options, { surface.Threads(), job.progress.Part(0.3, 0.4) });
  job.Check(0.4);
  this->UpdateHierarchy(surface, options, { surface.Threads(), job.progress.Part(0.4, 0.5) });
  this->MakeSteps(surface, options, { surface.Threads(), job.progress.Part(0.5, 1.0) });
  return result_;
}

void DiffusionSolver::UpdateLoads(
  const Surface& surface, const Input& input, const Options& options, const Job& job)
{
  StageKey key;
  key.Add(surface.GetStages().Version(SystemStage)).Add(KeyOf(input.values));
  key.Add(KeyOf(input.source)).Add(KeyOf(input.constraints)).Add(options.boundaryValues);
  surface.GetStages().Run(RightHandSideStage, key,
    [&]
    {
      const SurfaceSpace& space = surface.Space();
      Field values = ReadField(surface, input.values);
      constants_ = TakeConstantsOut(surface, values);
      start_ = space.LoadOfValues(values, job.Part(0.0, 0.5));
      result_.warning.clear();
      held_ = {};
      if (input.constraints || options.boundaryValues)
      {
        held_ = HoldConstraints(surface, input.values, input.constraints);
        held_.values.rowwise() -= constants_;
      }
      if (options.boundaryValues)
      {
        const BoundaryTerms terms = surface.OnBoundary(nullptr, &values.values);
        if (terms.isThere)
        {
          surface.Together([&] { held_ = Join(held_, terms.held); });
        }
        else
        {
          result_.warning = "The surface has no boundary, so Boundary Values has no effect.";
        }
      }
      sources_ = {};
      if (input.source)
      {
        // The source is per squared unit of length of the space.
        sources_ = std::pow(space.UnitLength(), 2) *
                   space.LoadOfValues(ReadField(surface, input.source), job.Part(0.5, 1.0));
      }
    });
}

void DiffusionSolver::UpdateHierarchy(
  const Surface& surface, const Options& options, const Job& job)
{
  const double step =
    options.diffusionTime / options.numberOfSteps / surface.WeightInSpaceUnits(1.0);
  StageKey key;
  key.Add(surface.GetStages().Version(RightHandSideStage)).Add(step);
  key.Add(KeyOf(result_.equation));
  surface.GetStages().Run(HierarchyStage, key,
    [&]
    {
      const double unit = surface.Space().UnitLength();
      result_.stepLength = step * unit * unit;
      result_.steps.clear();
      diffusion_.reset(); // frees its memory first
      DiffusionOptions ofSteps{ result_.equation, step, TimeScheme::SecondOrder, held_ };
      diffusion_ = std::make_unique<HeatDiffusion>(
        surface.SharedSpace(), start_, sources_, std::move(ofSteps), job);
    });
}

void DiffusionSolver::MakeSteps(const Surface& surface, const Options& options, const Job& job)
{
  std::vector<Step>& steps = result_.steps;
  const auto wanted = static_cast<std::size_t>(options.numberOfSteps);
  const std::size_t first = std::min(steps.size(), wanted);
  const double share = 1.0 / std::max<double>(1.0, static_cast<double>(wanted - first));
  while (steps.size() < wanted)
  {
    const double done = share * static_cast<double>(steps.size() - first);
    StageKey key;
    key.Add(surface.GetStages().Version(HierarchyStage));
    key.Add(static_cast<std::int64_t>(steps.size()));
    surface.GetStages().Run(SolveStage, key,
      [&]
      {
        SolveReport report = diffusion_->Advance(job.Part(done, done + share));
        SolutionAccuracy accuracy = diffusion_->Accuracy();
        accuracy.largest = surface.Largest(accuracy.largest);
        MultiVector atPoints = surface.ValuesAtPoints(diffusion_->Coefficients());
        atPoints.rowwise() += constants_;
        steps.push_back({ std::move(atPoints), std::move(report), accuracy, diffusion_->Held() });
      });
  }
}

std::vector<std::string> DiffusionSolver::Warnings(int step) const
{
  const Step& shown = result_.steps.at(static_cast<std::size_t>(step) - 1);
  std::vector<std::string> warnings = { result_.warning,
    WarningOf(shown.report, shown.accuracy, result_.equation.solve.tolerance) };
  if (!shown.met.isHeld.empty())
  {
    warnings.push_back(WarningOfConstraints(shown.met));
  }
  return NotEmpty(std::move(warnings));
}

DiffusionSolver::Result DiffusionSolver::Solve(std::shared_ptr<const TriangleMesh> mesh,
  const Input& input, const Options& options, const SurfaceOptions& surfaceOptions, const Job& job)
{
  Stages stages;
  LocalSurface surface(stages, std::move(mesh), surfaceOptions);
  DiffusionSolver solver;
  return solver.Update(surface, input, options, job);
}

} // namespace gridfem
