#include "Solvers/PoissonSolver.h"

#include "Base/Errors.h"
#include "Solvers/SolveOnMesh.h"
#include "Solvers/SolveWarnings.h"

#include <algorithm>
#include <utility>

namespace gridfem
{
namespace
{

using Input = PoissonSolver::Input;
using Options = PoissonSolver::Options;

bool HoldsValues(const Input& input, const Options& options)
{
  return input.constraints || options.boundaryValues;
}

bool IsConstrained(const Input& input, const Options& options)
{
  return options.fillUnknown || input.weights || input.flux || HoldsValues(input, options);
}

void RequireOneComponent(const GivenField& field, const std::string& property)
{
  if (field && field.components != 1)
  {
    throw InvalidInput(property + " '" + field.name + "' must have one component.");
  }
}

void RequireGradients(const Input& input, const Options& options)
{
  const Id components = ComponentsOf(input.values);
  if (input.gradients && input.gradients.components != 3 * components)
  {
    throw InvalidInput("Gradient Array '" + input.gradients.name + "' has " +
                       std::to_string(input.gradients.components) +
                       " components. The values have " + std::to_string(components) + ", so " +
                       std::to_string(3 * components) + " are needed: three for each.");
  }
  if (options.useValueGradient && !input.gradients && !input.values.IsOnPoints())
  {
    throw InvalidInput("Use Value Gradient needs point data, but '" + input.values.name +
                       "' is a cell array. Convert it with Cell Data to Point Data.");
  }
}

void RequireInput(const Input& input, const Options& options)
{
  RequireGradients(input, options);
  RequireOneComponent(input.gradientScale, "Gradient Scale Array");
  RequireOptions(options);
  RequireOneComponent(input.weights, "Value Weight Array");
  RequireHoldable(input.values, input.constraints, options.boundaryValues);
  const Id components = ComponentsOf(input.values);
  if (input.flux && (!input.flux.IsOnPoints() || input.flux.components != components))
  {
    throw InvalidInput("Boundary Flux Array '" + input.flux.name +
                       "' must be a point array with as many components as the values, " +
                       std::to_string(components) + ".");
  }
}

/// The key of everything that affects the load, except the space.
StageKey KeyOfLoad(const Input& input, const Options& options)
{
  StageKey key;
  key.Add(options.useValueGradient).Add(KeyOf(input.values)).Add(KeyOf(input.gradients));
  key.Add(KeyOf(input.gradientScale));
  if (IsConstrained(input, options))
  {
    key.Add(KeyOf(input.weights)).Add(KeyOf(input.flux)).Add(KeyOf(input.constraints));
    key.Add(options.fillUnknown).Add(options.boundaryValues);
  }
  return key;
}

/// @param constants  receives the constants that the load lacks
PoissonLoad Integrate(const Surface& surface, const SurfaceSpace& space, const Input& input,
  const Options& options, Eigen::RowVectorXd& constants, const Job& job)
{
  Field values = ReadField(surface, input.values);
  constants = TakeConstantsOut(surface, values);
  const auto scale = ReadOptional(surface, input.gradientScale);
  PoissonLoad load;
  load.values = space.LoadOfValues(values, job.Part(0.0, 0.5));
  if (input.gradients)
  {
    load.gradients = space.LoadOfGradients(
      surface.OnReference(ReadField(surface, input.gradients)), scale.get(), job.Part(0.5, 1.0));
  }
  else if (options.useValueGradient)
  {
    const bool isField = input.values || &surface.CurrentMesh() != &surface.Mesh();
    load.gradients = isField ? space.LoadOfGradientsOf(values, scale.get(), job.Part(0.5, 1.0))
                             : space.LoadOfGradientsOfCoordinates(scale.get(), job.Part(0.5, 1.0));
  }
  return load;
}

void AddBoundary(const Surface& surface, const Field& values, const Input& input,
  const Options& options, ConstrainedLoad& load)
{
  const auto flux = ReadOptional(surface, input.flux);
  BoundaryTerms terms = surface.OnBoundary(
    flux ? &flux->values : nullptr, options.boundaryValues ? &values.values : nullptr);
  if (!terms.isThere)
  {
    load.warning =
      "The surface has no boundary, so Boundary Values and Boundary Flux Array have no effect.";
    return;
  }
  load.flux = std::move(terms.load);
  if (options.boundaryValues)
  {
    surface.Together([&] { load.held = Join(load.held, terms.held); });
  }
}

void AddGradients(const Surface& surface, const Input& input, const Options& options,
  ConstrainedLoad& load, const Job& job)
{
  const SurfaceSpace& space = surface.Space();
  const auto scale = ReadOptional(surface, input.gradientScale);
  if (input.gradients)
  {
    load.gradients = space.LoadOfGradients(
      surface.OnReference(ReadField(surface, input.gradients)), scale.get(), job);
  }
  else if (options.useValueGradient)
  {
    // A triangle with an unknown corner has no gradient.
    Field known;
    surface.Together([&] { known = ScaleOfKnown(load.field, scale.get(), surface.Mesh()); });
    load.gradients = space.LoadOfGradientsOf(load.field.values, &known, job);
  }
}

/// Throws InvalidInput if a value is NaN where it counts.
void RequireWeightedValues(
  const Input& input, const Field& values, const Field& weight, const TriangleMesh& mesh)
{
  RequireField(values, mesh);
  RequireScale(&weight, mesh);
  const auto isCounted = [&](Id row) { return weight.values(row, 0) != 0.0; };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const auto rows = values.RowsOf(static_cast<Id>(t), mesh.triangles[t]);
    const auto weights = weight.RowsOf(static_cast<Id>(t), mesh.triangles[t]);
    const bool sharesPoints = values.association == weight.association;
    for (std::size_t k = 0; k < rows.size(); ++k)
    {
      const bool counts = sharesPoints ? isCounted(weights[k])
                                       : std::any_of(weights.begin(), weights.end(), isCounted);
      if (counts && values.values.row(rows[k]).hasNaN())
      {
        throw InvalidInput("Array '" + input.values.name + "' has a NaN value " +
                           (input.values.IsOnPoints() ? "at point " + std::to_string(rows[k])
                                                      : std::string("on a cell")) +
                           ", where Value Weight Array '" + input.weights.name +
                           "' is not 0. Fill Unknown takes NaN for an unknown value.");
      }
    }
  }
}

/// Reads the values. Values of weight 0 may be NaN.
Field ReadWeightedValues(
  const Surface& surface, const Input& input, const Field* weight, const Options& options)
{
  Field values =
    ReadField(surface, input.values, options.fillUnknown || weight ? NaNs::Kept : NaNs::Refused);
  if (weight && !options.fillUnknown)
  {
    surface.Together([&] { RequireWeightedValues(input, values, *weight, surface.Mesh()); });
  }
  return values;
}

/// @param constants  receives the constants that the load lacks
ConstrainedLoad IntegrateConstrained(const Surface& surface, const Input& input,
  const Options& options, Eigen::RowVectorXd& constants, const Job& job)
{
  const auto weight = ReadOptional(surface, input.weights);
  Field values = ReadWeightedValues(surface, input, weight.get(), options);
  constants = TakeConstantsOut(surface, values);
  ConstrainedLoad load;
  load.isWeighted = weight || options.fillUnknown;
  surface.Together([&] { load.field = SplitField(values, weight.get(), surface.Mesh()); });
  if (weight && !(options.useValueGradient && !input.gradients))
  {
    LeaveOutWeightless(surface.Space(), *weight, surface.Mesh(), load.field);
  }
  load.field.numberOfIgnoredPoints =
    CountIgnoredPoints(surface.Space(), load.field, surface.Mesh());
  load.held = HoldConstraints(surface, input.values, input.constraints);
  load.held.values.rowwise() -= constants;
  if (options.boundaryValues || input.flux)
  {
    AddBoundary(surface, values, input, options, load);
  }
  AddGradients(surface, input, options, load, job);
  return load;
}

/// The error that a solution may have. On real meshes, errors that are not trusted were up to eight
/// times too small.
double PossibleError(const SolutionAccuracy& accuracy)
{
  return (accuracy.isTrusted ? 1.0 : 8.0) * accuracy.discretization;
}

/// Held values are met by steps of their own, which end by a tolerance.
EquationOptions EquationOf(const Input& input, const Options& options)
{
  constexpr double ConstrainedTolerance = 1e-6; // of the energy residual
  EquationOptions equation = options.equation;
  if (IsConstrained(input, options))
  {
    equation.accuracy = 0.0;
    if (equation.solve.tolerance == 0.0)
    {
      equation.solve.tolerance = ConstrainedTolerance;
    }
  }
  return equation;
}

} // namespace

const PoissonSolver::Result& PoissonSolver::Update(
  Surface& surface, const Input& input, const Options& options, const Job& job)
{
  RequireInput(input, options);
  const bool choosesDepth = options.wantedError > 0.0 && !surface.AreFunctionsGiven() &&
                            IsRefinedByDepth(surface.UsedOptions().choice.kind);
  if (choosesDepth)
  {
    this->SolveAtWantedError(surface, input, options, job.progress);
  }
  else
  {
    surface.Prepare(job.progress.Part(0.0, 0.5));
    job.Check(0.5);
    this->SolvePrepared(surface, input, options, job.progress.Part(0.5, 1.0));
  }
  this->Report(surface, input, options, choosesDepth);
  return result_;
}

void PoissonSolver::SolveAtWantedError(
  Surface& surface, const Input& input, const Options& options, const Progress& progress)
{
  StageKey asked = surface.InputKey();
  asked.Add(KeyOfOptions(options)).Add(KeyOfLoad(input, options));
  if (!search_.IsFound() || asked != searched_)
  {
    search_ = {};
    searched_ = asked;
  }
  int solved = 0;
  for (double done = 0.0; solved != search_.Depth(); done = 0.5 + 0.5 * done)
  {
    solved = search_.Depth();
    const Progress part = progress.Part(done, 0.5 + 0.5 * done);
    surface.PrepareAtDepth(solved, part.Part(0.0, 0.5));
    part.Check(0.5);
    this->SolvePrepared(surface, input, options, part.Part(0.5, 1.0));
    search_.Judge(
      surface.Mesh(), result_.accuracy, options.wantedError, surface.UsedOptions().choice.kind);
  }
}

void PoissonSolver::SolvePrepared(
  const Surface& surface, const Input& input, const Options& options, const Progress& progress)
{
  PoissonRequest request;
  request.weight = options.screeningWeight;
  request.gradientScale = options.gradientScale;
  const StageKey fields = KeyOfLoad(input, options);
  const EquationOptions equation = EquationOf(input, options);
  if (IsConstrained(input, options))
  {
    constrained_.Update(
      surface, fields,
      [&](const Job& job)
      { return IntegrateConstrained(surface, input, options, constants_, job); },
      request, equation, progress);
    result_.report = constrained_.Report();
    result_.accuracy = constrained_.Accuracy();
    return;
  }
  equation_.Update(
    surface, fields,
    [&](const SurfaceSpace& space, const Job& job)
    { return Integrate(surface, space, input, options, constants_, job); },
    request, equation, progress);
  result_.report = equation_.Report();
  result_.accuracy = equation_.Accuracy();
}

/// @param isSearched  whether the depth was chosen for the wanted error
void PoissonSolver::Report(
  const Surface& surface, const Input& input, const Options& options, bool isSearched)
{
  const bool isConstrained = IsConstrained(input, options);
  const double tolerance = EquationOf(input, options).solve.tolerance;
  result_.atPoints = surface.ValuesAtPoints(
    isConstrained ? constrained_.Coefficients() : equation_.Solution().coefficients);
  result_.atPoints.rowwise() += constants_;
  result_.holdsValues = HoldsValues(input, options);
  result_.misfit = result_.holdsValues ? constrained_.Misfit() : 0.0;
  result_.warnings = { isConstrained ? constrained_.Warning(tolerance)
                                     : WarningOf(result_.report, result_.accuracy, tolerance) };
  const double error = result_.accuracy.discretization;
  result_.isAccurate =
    !(options.wantedError > 0.0) ||
    (isSearched ? search_.IsReached() : PossibleError(result_.accuracy) <= options.wantedError);
  if (!result_.isAccurate)
  {
    result_.warnings.push_back(
      WarningOfWantedError(options.wantedError, error, surface.UsedOptions().choice.kind));
  }
  result_.warnings = NotEmpty(std::move(result_.warnings));
}

PoissonSolver::Result PoissonSolver::Solve(std::shared_ptr<const TriangleMesh> mesh,
  const Input& input, const Options& options, const SurfaceOptions& surfaceOptions, const Job& job)
{
  return SolveOnMesh(&PoissonSolver::result_, std::move(mesh), surfaceOptions, job, input, options);
}

} // namespace gridfem
