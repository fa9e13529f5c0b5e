#include "Solvers/ConstrainedEquation.h"

#include "Base/Errors.h"
#include "Solvers/OptionFields.h"
#include "Solvers/SolveWarnings.h"

#include <algorithm>
#include <limits>
#include <sstream>

namespace gridfem
{
namespace
{

std::string Shown(double number)
{
  std::ostringstream text;
  text << number;
  return text.str();
}

} // namespace

void ConstrainedEquation::Update(const Surface& surface, const StageKey& fields,
  const Integrate& integrate, const PoissonRequest& request, EquationOptions options,
  const Progress& progress)
{
  options.multigrid.threads = surface.Threads();
  this->UpdateSystem(surface, fields, integrate, progress.Part(0.0, 0.3));
  progress.Check(0.3);
  const double weight = surface.WeightInSpaceUnits(request.weight);
  this->RequireResolvable(weight);
  StageKey key;
  key.Add(surface.GetStages().Version(RightHandSideStage)).Add(weight);
  EquationOptions ofHierarchy;
  ofHierarchy.multigrid = options.multigrid;
  key.Add(KeyOf(ofHierarchy));
  const ConstraintOptions constraints;
  surface.GetStages().Run(HierarchyStage, key,
    [&]
    {
      hierarchy_.reset(); // frees its memory first
      hierarchy_ = std::make_unique<ConstrainedHierarchy>(*weighted_, weight, 1.0, load_.held.rows,
        constraints.penalty, options.multigrid, progress.Part(0.3, 0.5));
    });
  progress.Check(0.5);
  this->Solve(surface, request, options, progress.Part(0.5, 1.0));
}

void ConstrainedEquation::UpdateSystem(
  const Surface& surface, StageKey fields, const Integrate& integrate, const Progress& progress)
{
  fields.Add(surface.GetStages().Version(SystemStage)).Add(true); // unlike PoissonEquation's key
  surface.GetStages().Run(RightHandSideStage, fields,
    [&]
    {
      hierarchy_.reset();
      weighted_.reset();
      load_ = integrate(surface.MakeJob(progress.Part(0.0, 0.4)));
      const Job job = surface.MakeJob(progress.Part(0.4, 1.0));
      const std::shared_ptr<const SurfaceSpace> space = surface.SharedSpace();
      const PartialField& field = load_.field;
      const auto range = std::minmax_element(field.weight.begin(), field.weight.end());
      const bool isEmpty = field.weight.empty(); // as a process may be
      largestWeight_ = surface.Largest(isEmpty ? 0.0 : *range.second);
      leastWeight_ =
        -surface.Largest(isEmpty ? -std::numeric_limits<double>::infinity() : -*range.first);
      values_ = space->LoadOfWeightedValues(
        field.counted ? *field.counted : field.values, field.weight, job.Part(0.0, 0.2));
      meanOfField_ = MeansOfKnown(*space, load_.field, job.Part(0.2, 0.5));
      weighted_ =
        load_.isWeighted ? space->WithWeightedMass(load_.field.weight, job.Part(0.5, 1.0)) : space;
    });
}

/// A tolerance is relative to the energy of the whole solution. If a few weights are far larger
/// than the others, their energy hides the rest of the solution. The stiffness of a cell is about
/// 1.
void ConstrainedEquation::RequireResolvable(double weight) const
{
  constexpr double MostTimes = 1e9;
  if (weight * largestWeight_ > MostTimes * std::max(1.0, weight * leastWeight_))
  {
    throw InvalidInput("The largest weight of the values, " + Shown(largestWeight_) +
                       ", is too large beside the smallest, " + Shown(leastWeight_) +
                       ", or beside the gradients. The solver would lose the solution there. Use "
                       "smaller weights, a smaller Screening Weight, or a Constraint Array for "
                       "values that hold exactly.");
  }
}

void ConstrainedEquation::Solve(const Surface& surface, const PoissonRequest& request,
  const EquationOptions& options, const Progress& progress)
{
  StageKey key;
  key.Add(surface.GetStages().Version(HierarchyStage)).Add(request.gradientScale);
  key.Add(KeyOf(options));
  surface.GetStages().Run(SolveStage, key,
    [&]
    {
      const double weight = surface.WeightInSpaceUnits(request.weight);
      MultiVector load = weight * values_;
      unbalanced_ = 0;
      if (load_.gradients.rows() > 0)
      {
        load += request.gradientScale * load_.gradients;
      }
      if (load_.flux.cols() > 0) // also on a rank without functions
      {
        load += this->BalancedFlux(surface, weight);
      }
      ConstraintOptions constraints;
      const std::shared_ptr<const SurfaceSpace> space = surface.SharedSpace();
      constraints.estimateOn = space.get();
      solution_ = SolveConstrained(*weighted_, weight, *hierarchy_, load, load_.held.values,
        constraints, options.solve, progress);
      solution_.accuracy.largest = surface.Largest(solution_.accuracy.largest);
      SetMeans(*space, solution_.isHeld, meanOfField_, solution_.coefficients, surface.Threads());
    });
}

/// If nothing holds the solution, as much has to flow out as flows in. The surplus flows out
/// evenly.
MultiVector ConstrainedEquation::BalancedFlux(const Surface& surface, double weight)
{
  constexpr double Visible = 1e-3;
  const std::shared_ptr<const SurfaceSpace> space = surface.SharedSpace();
  const int threads = surface.Threads();
  const DistributedRows* const distributed = space->Distributed(0);
  const Components components = space->ComponentsOf(0, threads);
  const std::vector<char> isHeld = HeldComponents(*weighted_, weight, load_.held.rows, components);
  MultiVector sum = MultiVector::Zero(components.count, load_.flux.cols());
  MultiVector size = sum;
  for (Id i = GhostRows(distributed); i < load_.flux.rows(); ++i)
  {
    const Index own = components.ofFunction[i];
    sum.row(own) += load_.flux.row(i);
    size.row(own) += load_.flux.row(i).cwiseAbs();
  }
  SumOverProcesses(distributed, sum);
  SumOverProcesses(distributed, size);
  const ComponentMeans means(
    components.ofFunction, space->Integrals(), components.count, threads, distributed);
  MultiVector balanced = load_.flux;
  means.SubtractIntegrals(MeansOfFree(isHeld, means.OfIntegrals(load_.flux)), balanced);
  for (Index c = 0; c < components.count; ++c)
  {
    const bool isOff = (sum.row(c).cwiseAbs().array() > Visible * size.row(c).array()).any();
    unbalanced_ += !isHeld[c] && isOff ? 1 : 0;
  }
  return balanced;
}

std::string ConstrainedEquation::Warning(double tolerance) const
{
  std::vector<std::string> sentences = WarningsOf(solution_, tolerance);
  if (unbalanced_ > 0)
  {
    sentences.push_back("On " + std::to_string(unbalanced_) +
                        " of them the flux across the boundary does not add up to 0. The surplus "
                        "is removed evenly from the surface.");
  }
  sentences.push_back(load_.warning);
  sentences.push_back(WarningOf(load_.field));
  return Joined(sentences);
}

} // namespace gridfem
