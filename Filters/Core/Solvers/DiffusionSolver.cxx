#include "Solvers/DiffusionSolver.h"

#include "Base/Errors.h"
#include "Solvers/SolveOnMesh.h"
#include "Solvers/SolveWarnings.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

/// Columns that are solved together. They fill the lanes of a vector instruction. Solving 32 at
/// once took twice the time per column: their vectors leave the cache.
constexpr Id PanelColumns = 8;

/// Columns that are solved together by a factor, and the number of columns from which on it pays.
constexpr Id FactorColumns = 64;

/// Calls body(first column, columns, done, done after it) for all panels of a block.
template<class Body>
void ForEachPanel(Id columns, Body&& body, Id width = PanelColumns)
{
  for (Id first = 0; first < columns; first += width)
  {
    const Id count = std::min(width, columns - first);
    body(first, count, double(first) / double(columns), double(first + count) / double(columns));
  }
}

MultiVector LoadOfPanels(const Surface& surface, const Field& field, const Job& job)
{
  MultiVector load;
  ForEachPanel(field.values.cols(),
    [&](Id first, Id count, double done, double after)
    {
      const MultiVector part = surface.Space().LoadOfValues(
        { field.association, field.values.middleCols(first, count) }, job.Part(done, after));
      load.resize(part.rows(), field.values.cols());
      load.middleCols(first, count) = part;
    });
  return load;
}

bool AreSamePlaces(const HeldRows& one, const HeldRows& other)
{
  return one.rows == other.rows && one.pull == other.pull && one.rowBegin == other.rowBegin &&
         one.column == other.column && one.value == other.value;
}

/// Keeps the worse of two solves with the same places of held values.
void KeepWorse(const ConstrainedSolution& met, ConstrainedSolution& kept)
{
  kept.misfit = LargerOrUnknown(kept.misfit, met.misfit);
  kept.relativeMisfit = LargerOrUnknown(kept.relativeMisfit, met.relativeMisfit);
  kept.steps = std::max(kept.steps, met.steps);
  kept.isExact = kept.isExact && met.isExact;
  kept.isHeld = met.isHeld;
}

/// The option that states the amount.
struct Amount
{
  const char* name;
  double value;
};

Amount AmountOf(const DiffusionSolver::Options& options)
{
  switch (options.amount)
  {
    case DiffusionAmount::FullWidth:
      return { "FWHM", options.fullWidth };
    case DiffusionAmount::Sigma:
      return { "Sigma", options.sigma };
    case DiffusionAmount::Time:
      break;
  }
  return { "Diffusion Time", options.diffusionTime };
}

/// The length of a step in squared units of length of the space.
double StepInSpaceUnits(const Surface& surface, const DiffusionSolver::Options& options)
{
  const bool isTime = options.amount == DiffusionAmount::Time;
  const double time = isTime ? options.diffusionTime
                      : options.amount == DiffusionAmount::FullWidth
                        ? TimeOfFullWidth(options.fullWidth)
                        : TimeOfSigma(options.sigma);
  const double squaredUnit =
    isTime ? surface.WeightInSpaceUnits(1.0) : std::pow(surface.Space().UnitLength(), 2);
  return time / options.numberOfSteps / squaredUnit;
}

void RequireInput(const DiffusionSolver::Input& input, const DiffusionSolver::Options& options)
{
  RequireOptions(options);
  const Amount amount = AmountOf(options);
  if (amount.value == 0.0)
  {
    throw InvalidInput(std::string(amount.name) + " is 0, so nothing spreads. It must be above 0.");
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

double TimeOfFullWidth(double fullWidth)
{
  return fullWidth * fullWidth / (16.0 * std::log(2.0));
}

double TimeOfSigma(double sigma)
{
  return 0.5 * sigma * sigma;
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
      Field values = ReadField(surface, input.values);
      constants_ = TakeConstantsOut(surface, values);
      start_ = LoadOfPanels(surface, values, job.Part(0.0, 0.5));
      result_.warning.clear();
      HeldValues held; // replaces the held values once nothing can fail any more
      if (input.constraints || options.boundaryValues)
      {
        held = HoldConstraints(surface, input.values, input.constraints);
        held.values.rowwise() -= constants_;
      }
      if (options.boundaryValues)
      {
        const BoundaryTerms terms = surface.OnBoundary(nullptr, &values.values);
        if (terms.isThere)
        {
          surface.Together([&] { held = Join(held, terms.held); });
        }
        else
        {
          result_.warning = "The surface has no boundary, so Boundary Values has no effect.";
        }
      }
      heldPlaces_ += AreSamePlaces(held_.rows, held.rows) ? 0 : 1;
      held_ = std::move(held);
      sources_ = {};
      if (input.source)
      {
        // The source is per squared unit of length of the space.
        sources_ = LoadOfPanels(surface, ReadField(surface, input.source), job.Part(0.5, 1.0));
        sources_ *= std::pow(surface.Space().UnitLength(), 2);
      }
    });
}

void DiffusionSolver::UpdateHierarchy(
  const Surface& surface, const Options& options, const Job& job)
{
  const double step = StepInSpaceUnits(surface, options);
  const bool isFactored = !surface.IsShared() && start_.cols() >= FactorColumns;
  StageKey key;
  key.Add(surface.GetStages().Version(SystemStage)).Add(step).Add(heldPlaces_).Add(isFactored);
  key.Add(KeyOf(result_.equation));
  surface.GetStages().Run(HierarchyStage, key,
    [&]
    {
      const double unit = surface.Space().UnitLength();
      result_.stepLength = step * unit * unit;
      panels_.clear(); // frees its memory first
      watched_.reset();
      equation_.reset();
      DiffusionOptions ofSteps{ result_.equation, step };
      ofSteps.isFactored = isFactored;
      equation_ =
        std::make_shared<const HeatEquation>(surface.SharedSpace(), ofSteps, held_.rows, job);
    });
}

void DiffusionSolver::MakeSteps(const Surface& surface, const Options& options, const Job& job)
{
  std::vector<Step>& steps = result_.steps;
  StageKey key;
  key.Add(surface.GetStages().Version(RightHandSideStage));
  key.Add(surface.GetStages().Version(HierarchyStage));
  const auto wanted = static_cast<std::size_t>(options.numberOfSteps);
  if (key != ofSteps_ || (steps.size() < wanted && panels_.empty()))
  {
    steps.clear();
    panels_.clear();
    watched_.reset();
    ofSteps_ = key;
    surface.GetStages().Forget(SolveStage);
  }
  const std::size_t first = std::min(steps.size(), wanted);
  surface.Require({ double(wanted - first) * double(start_.cols()) *
                      double(surface.Mesh().points.size()) * sizeof(double),
    "Number Of Steps " + std::to_string(options.numberOfSteps), "Choose fewer steps." });
  const double share = 1.0 / std::max<double>(1.0, static_cast<double>(wanted - first));
  while (steps.size() < wanted)
  {
    const double done = share * static_cast<double>(steps.size() - first);
    StageKey ofStep = key;
    ofStep.Add(static_cast<std::int64_t>(steps.size()));
    surface.GetStages().Run(SolveStage, ofStep,
      [&] { steps.push_back(this->MakeStep(surface, wanted > 1, job.Part(done, done + share))); });
  }
}

HeatDiffusion DiffusionSolver::PanelAtStart(Id first, Id count, HeatSolves solves) const
{
  const auto part = [&](const MultiVector& block)
  { return block.cols() > 0 ? MultiVector(block.middleCols(first, count)) : MultiVector(); };
  return HeatDiffusion(equation_, part(start_), part(sources_), part(held_.values), solves);
}

/// Makes the next step of all panels.
/// @param goesOn  whether more steps may follow; a single panel is always kept
DiffusionSolver::Step DiffusionSolver::MakeStep(const Surface& surface, bool goesOn, const Job& job)
{
  const bool isFactored = equation_->IsFactored();
  const double watching = isFactored ? 0.1 : 0.0;
  Step step;
  step.report = SolveReport::Solved();
  step.accuracy = SolutionAccuracy::Exact();
  std::optional<HeatDiffusion> watched;
  if (isFactored)
  {
    watched = watched_ ? *watched_ : this->PanelAtStart(0, PanelColumns, HeatSolves::ByIteration);
    step.report = watched->Advance(job.Part(0.0, watching));
    step.accuracy = watched->Accuracy();
  }
  const Id width = isFactored ? FactorColumns : PanelColumns;
  std::vector<HeatDiffusion> after;
  ForEachPanel(
    start_.cols(),
    [&](Id first, Id count, double done, double doneAfter)
    {
      HeatDiffusion heat = panels_.empty()
                             ? this->PanelAtStart(first, count,
                                 isFactored ? HeatSolves::ByFactor : HeatSolves::ByIteration)
                             : panels_[static_cast<std::size_t>(first / width)];
      const auto share = [watching](double part) { return watching + (1.0 - watching) * part; };
      KeepWorse(heat.Advance(job.Part(share(done), share(doneAfter))), step.report);
      KeepWorse(heat.Accuracy(), step.accuracy);
      const MultiVector atPoints = surface.ValuesAtPoints(heat.Coefficients());
      if (first == 0)
      {
        step.met = heat.Held();
        step.atPoints.resize(atPoints.rows(), start_.cols());
      }
      KeepWorse(heat.Held(), step.met);
      step.atPoints.middleCols(first, count) =
        atPoints.rowwise() + constants_.segment(first, count);
      if (goesOn || start_.cols() <= width)
      {
        after.push_back(std::move(heat));
      }
    },
    width);
  step.accuracy.largest = surface.Largest(step.accuracy.largest);
  panels_ = std::move(after);
  watched_ = panels_.empty() ? std::nullopt : std::move(watched);
  return step;
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
  return SolveOnMesh(
    &DiffusionSolver::result_, std::move(mesh), surfaceOptions, job, input, options);
}

} // namespace gridfem
