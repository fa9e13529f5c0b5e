#include "Solvers/DynamicsEquation.h"

#include "Base/Errors.h"
#include "Equations/DampedWave.h"
#include "Equations/ReactionDiffusion.h"
#include "Solvers/SurfaceFields.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gridfem
{
namespace
{

using Model = DynamicsModel;

/// A frame in steps of one length.
struct Pace
{
  double frame;
  int substeps;

  double Step() const { return frame / substeps; }
};

Pace PaceOf(
  const DynamicsSolver::Options& options, double usualFrame, double longestStep, int refinement)
{
  const double frame = options.timeStep > 0.0 ? options.timeStep : usualFrame;
  const double needed = std::ceil(frame / longestStep * (1.0 - 1e-12));
  if (!(needed <= 1e6))
  {
    throw InvalidInput(
      "The Time Step needs more than a million steps of the solver. It must be shorter.");
  }
  return { frame, refinement * std::max(1, int(needed)) };
}

/// The longest step in which transport is explicit: a quarter of a cell, and short enough that the
/// diffusion damps the waves that extrapolation amplifies by (wk step)⁴ / 4 per step.
double LongestStepOfTransport(double speed, double diffusion)
{
  constexpr double Shortest = 3.0; // squared wave number of the shortest waves, per cell
  return std::min(0.25 / speed, std::cbrt(diffusion / (Shortest * std::pow(speed, 4))));
}

MadeEquation MakeTransport(const Surface& surface, const DynamicsSolver::Input& input,
  const DynamicsSolver::Options& options, const EquationOptions& equation, int refinement,
  const Job& job)
{
  const double unit = surface.Space().UnitLength();
  const double worldUnit = surface.LengthInWorldUnits(1.0);
  const Field velocity = ReadField(surface, input.velocity);
  const double fastest = velocity.values.rowwise().norm().maxCoeff();
  const double speed = fastest > 0.0 ? fastest : worldUnit; // of still air: any
  ReactionTerms terms;
  terms.diffusion = { options.diffusivity * std::pow(worldUnit / unit, 2) };
  terms.carry = [space = surface.SharedSpace(), velocity, unit](
                  const MultiVector& coefficients, const Job& ofCarry)
  {
    const Field u{ FieldAssociation::Points, space->ValuesAtPoints(coefficients, ofCarry) };
    return MultiVector(space->LoadOfGradients(velocity, &u, ofCarry) / (unit * unit));
  };
  const Pace pace = PaceOf(options, 0.5 * surface.LengthInWorldUnits(options.patternLength) / speed,
    LongestStepOfTransport(speed / unit, terms.diffusion[0]), refinement);
  return { std::make_unique<ReactionDiffusion>(
             surface.WholeSpace(), std::move(terms), equation, pace.Step(), job),
    pace.frame, pace.substeps };
}

/// The given reactions in the units of the parameters. They start between 0 and 1.
ReactionSystem CustomSystem(const DynamicsSolver::Options& options, const GivenReactions& reactions)
{
  ReactionSystem system;
  system.diffusion = { options.diffusivity, options.diffusivityV };
  system.diffusion.resize(static_cast<std::size_t>(reactions.species));
  system.patternLength = options.patternLength;
  system.frame = 1.0;
  system.rest.assign(static_cast<std::size_t>(reactions.species), 0.0);
  system.react = reactions.rates;
  system.startOfNoise = [species = reactions.species](const double* normal, double* u)
  {
    for (int s = 0; s < species; ++s)
    {
      u[s] = 0.5 + std::clamp(normal[s], -3.0, 3.0) / 6.0;
    }
  };
  system.startOfDisturbance = [species = reactions.species](double amount, double* u)
  {
    std::fill_n(u, species, 0.0);
    u[0] = amount;
  };
  return system;
}

/// A step that resolves given reactions at the values of the start.
double StepOfReactions(const Surface& surface, const DynamicsSolver::Input& input)
{
  const auto species = static_cast<std::size_t>(input.reactions.species);
  std::vector<double> low(species, 0.0);
  std::vector<double> high(species, input.start ? 0.0 : 1.0);
  if (input.start)
  {
    const Field start = ReadField(surface, input.start);
    const std::vector<char> isUsed = UsedPoints(surface.Mesh(), surface.Threads());
    for (Id c = 0; c < start.values.cols(); ++c)
    {
      const auto s = static_cast<std::size_t>(c);
      low[s] = std::numeric_limits<double>::infinity();
      high[s] = -low[s];
      for (Id row = 0; row < start.values.rows(); ++row)
      {
        if (!input.start.IsOnPoints() || isUsed[static_cast<std::size_t>(row)])
        {
          low[s] = std::min(low[s], start.values(row, c));
          high[s] = std::max(high[s], start.values(row, c));
        }
      }
    }
  }
  return 0.2 / FastestResponse(input.reactions.rates, low, high);
}

} // namespace

ReactionSystem SystemOf(const DynamicsSolver::Options& options, const GivenReactions& reactions)
{
  switch (options.model)
  {
    case Model::GrayScott:
      return GrayScott(options.feed, options.kill);
    case Model::FitzHughNagumo:
      return FitzHughNagumo();
    case Model::AllenCahn:
      return AllenCahn();
    case Model::Custom:
      return CustomSystem(options, reactions);
    default:
      return SpotsOfTuring();
  }
}

Id NumberOfUnknowns(const DynamicsSolver::Options& options, const GivenReactions& reactions)
{
  return options.model == Model::Wave ? 2
         : options.model == Model::Transport
           ? 1
           : static_cast<Id>(SystemOf(options, reactions).Species());
}

double FunctionsOfPattern(const DynamicsSolver::Options& options, const GivenReactions& reactions)
{
  constexpr double Usual = 6.0;
  return IsReaction(options.model) ? SystemOf(options, reactions).functions : Usual;
}

MadeEquation MakeEquation(const Surface& surface, const DynamicsSolver::Input& input,
  const DynamicsSolver::Options& options, int refinement, const Job& job)
{
  EquationOptions equation = options.equation;
  equation.multigrid.threads = surface.Threads();
  equation.multigrid.cycle = CycleType::V; // takes less time; a step needs few cycles
  const double unit = surface.Space().UnitLength();
  if (options.model == Model::Transport)
  {
    return MakeTransport(surface, input, options, equation, refinement, job);
  }
  if (options.model == Model::Wave)
  {
    const Pace pace =
      PaceOf(options, 0.5 * options.patternLength, 0.05 * options.patternLength, refinement);
    const WaveTerms terms{ surface.LengthInWorldUnits(1.0) / unit, options.damping };
    return { std::make_unique<DampedWave>(surface.SharedSpace(), terms, equation, pace.Step(), job),
      pace.frame, pace.substeps };
  }
  ReactionSystem system = SystemOf(options, input.reactions);
  if (options.model == Model::Custom)
  {
    system.step = StepOfReactions(surface, input);
    system.frame = std::min(system.frame, 100.0 * system.step);
  }
  const double scale =
    surface.LengthInWorldUnits(options.patternLength) / system.patternLength / unit;
  ReactionTerms terms{ system.diffusion, system.react, nullptr };
  for (double& diffusion : terms.diffusion)
  {
    diffusion *= scale * scale;
  }
  const Pace pace = PaceOf(options, system.frame, system.step, refinement);
  return { std::make_unique<ReactionDiffusion>(
             surface.WholeSpace(), std::move(terms), equation, pace.Step(), job),
    pace.frame, pace.substeps };
}

} // namespace gridfem
