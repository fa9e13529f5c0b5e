#include "Held.h"

#include "Base/Errors.h"
#include "Problems/DepthSearch.h"
#include "Problems/PartialField.h"
#include "Problems/SolveWarnings.h"

#include <optional>

namespace gridfem
{
namespace
{

class PoissonProblem : public Problem
{
public:
  explicit PoissonProblem(Properties& properties)
    : options_(properties, { 0.0, 200 }),
      weight_(properties.NumberFrom("ScreeningWeight", 100.0, 0.0)),
      gradientScale_(properties.FiniteNumber("GradientScale", 1.0)),
      usesValueGradient_(properties.Switch("UseValueGradient", false)),
      fillsUnknown_(properties.Switch("FillUnknown", false)),
      holdsBoundary_(properties.Switch("BoundaryValues", false)),
      wantedError_(properties.Number("WantedError", 0.0, 0.0, 0.5))
  {
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    this->Check(given);
    Results results;
    if (wantedError_ > 0.0 && IsRefinedByDepth(options_.choice.kind))
    {
      this->SolveAccurately(given, results, progress);
    }
    else
    {
      this->SolveOn(
        Surface(given, options_, progress.Part(0.0, 0.5)), given, results, progress.Part(0.5, 1.0));
    }
    return results;
  }

private:
  void SolveAccurately(const Given& given, Results& results, const Progress& progress) const;
  SolutionAccuracy SolveOn(
    const Surface& surface, const Given& given, Results& results, const Progress& progress) const;
  bool IsConstrained(const Given& given) const
  {
    return fillsUnknown_ || holdsBoundary_ || given.Find("weights") || given.Find("held");
  }

  void Check(const Given& given) const;
  Field ValuesOf(const Given& given) const;
  MultiVector Gradients(
    const Given& given, const Surface& surface, const Field& value, const Job& job) const;
  PoissonSolution SolveEquation(
    const Given& given, const Surface& surface, Results& results, const Progress& progress) const;
  PoissonSolution SolveConstrainedEquation(
    const Given& given, const Surface& surface, Results& results, const Progress& progress) const;

  SurfaceOptions options_;
  double weight_;
  double gradientScale_;
  bool usesValueGradient_;
  bool fillsUnknown_;
  bool holdsBoundary_;
  double wantedError_; // 0: the depth is given
};

void PoissonProblem::Check(const Given& given) const
{
  const GivenArray* values = given.Find("values");
  const GivenArray* gradients = given.Find("gradients");
  const GivenArray* weights = given.Find("weights");
  const Id components = values ? values->values.cols() : 3;
  if (gradients && gradients->values.cols() != 3 * components)
  {
    throw InvalidInput("GradientArray 'gradients' has " + std::to_string(gradients->values.cols()) +
                       " components. The values have " + std::to_string(components) + ", so " +
                       std::to_string(3 * components) + " are needed: a vector for each.");
  }
  if (weights && weights->values.cols() != 1)
  {
    throw InvalidInput("ValueWeightArray 'weights' must have one component.");
  }
  if (usesValueGradient_ && !gradients)
  {
    RequirePointValues("UseValueGradient", values);
  }
  CheckHeld(given, holdsBoundary_);
}

/// Results at one depth replace those of the one before.
void PoissonProblem::SolveAccurately(
  const Given& given, Results& results, const Progress& progress) const
{
  DepthSearch search;
  int solved = 0;
  for (double done = 0.0; solved != search.Depth(); done = 0.5 + 0.5 * done)
  {
    solved = search.Depth();
    results = {};
    const Progress part = progress.Part(done, 0.5 + 0.5 * done);
    const Surface surface(given, options_.AtDepth(solved), part.Part(0.0, 0.5));
    search.Judge(
      *given.mesh, this->SolveOn(surface, given, results, part.Part(0.5, 1.0)), wantedError_);
  }
}

SolutionAccuracy PoissonProblem::SolveOn(
  const Surface& surface, const Given& given, Results& results, const Progress& progress) const
{
  PoissonSolution solution;
  if (this->IsConstrained(given))
  {
    solution = this->SolveConstrainedEquation(given, surface, results, progress.Part(0.0, 0.9));
  }
  else
  {
    solution = this->SolveEquation(given, surface, results, progress.Part(0.0, 0.9));
  }
  const double error = solution.accuracy.discretization;
  if (wantedError_ > 0.0 && !(error <= wantedError_))
  {
    results.Warn(WarningOfWantedError(wantedError_, error, options_.choice.kind));
  }
  results.arrays["Solution"] =
    surface.AtPoints(solution.coefficients, given.RowsAtPoints("values"));
  return solution.accuracy;
}

Field PoissonProblem::ValuesOf(const Given& given) const
{
  return given.Find("values") ? given.FieldOf("values", fillsUnknown_) : CoordinatesOf(*given.mesh);
}

PoissonSolution PoissonProblem::SolveEquation(
  const Given& given, const Surface& surface, Results& results, const Progress& progress) const
{
  const FiniteElementSpace& space = surface.Space();
  const Job job = surface.MakeJob(progress.Part(0.0, 0.2));
  const Field value = this->ValuesOf(given);
  const MultiVector load = space.LoadOfValues(value, job);
  MultiVector gradients;
  if (given.Find("gradients"))
  {
    gradients = space.LoadOfGradients(given.FieldOf("gradients"), nullptr, job);
  }
  else if (usesValueGradient_)
  {
    gradients = given.Find("values") ? space.LoadOfGradientsOf(value, nullptr, job)
                                     : space.LoadOfGradientsOfCoordinates(nullptr, job);
  }
  PoissonOptions options{ options_ };
  options.screeningWeight = surface.WeightInSpaceUnits(weight_);
  options.estimateErrors = true;
  const Multigrid multigrid =
    BuildMultigrid(space, options.screeningWeight, 1.0, options.multigrid, progress.Part(0.2, 0.4));
  PoissonSolution solution = SolvePoisson(
    space, multigrid, load, gradientScale_ * gradients, options, progress.Part(0.4, 1.0));
  results.Warn(WarningOf(solution.report, solution.accuracy, options.solve.tolerance));
  return solution;
}

PoissonSolution PoissonProblem::SolveConstrainedEquation(
  const Given& given, const Surface& surface, Results& results, const Progress& progress) const
{
  constexpr double ConstrainedTolerance = 1e-6; // where no Tolerance is given
  const FiniteElementSpace& space = surface.Space();
  const TriangleMesh& mesh = surface.Mesh();
  const Job job = surface.MakeJob(progress.Part(0.0, 0.3));
  const Field value = this->ValuesOf(given);
  const auto weight =
    given.Find("weights") ? std::make_optional(given.FieldOf("weights")) : std::nullopt;
  PartialField field = SplitField(value, weight ? &*weight : nullptr, mesh);
  field.numberOfIgnoredPoints = CountIgnoredPoints(space, field, mesh);
  const HeldValues held = FindHeld(given, surface, options_, value, holdsBoundary_, results);
  const double screening = surface.WeightInSpaceUnits(weight_);
  MultiVector load = screening * space.LoadOfWeightedValues(field.values, field.weight, job);
  if (given.Find("gradients"))
  {
    load += gradientScale_ * space.LoadOfGradients(given.FieldOf("gradients"), nullptr, job);
  }
  else if (usesValueGradient_)
  {
    // Where a corner is unknown there is no gradient.
    const Field known = ScaleOfKnown(field, nullptr, mesh);
    load += gradientScale_ * space.LoadOfGradientsOf(field.values, &known, job);
  }
  const MultiVector means = MeansOfKnown(space, field, job);
  const std::unique_ptr<FiniteElementSpace> weighted = space.Copy();
  weighted->WeighMass(field.weight, job);
  ConstraintOptions constraints;
  constraints.estimateOn = &space;
  const ConstrainedHierarchy hierarchy(*weighted, screening, 1.0, held.rows, constraints.penalty,
    options_.multigrid, progress.Part(0.3, 0.5));
  SolveOptions solve = options_.solve;
  solve.tolerance = solve.tolerance > 0.0 ? solve.tolerance : ConstrainedTolerance;
  ConstrainedSolution solution = SolveConstrained(*weighted, screening, hierarchy, load,
    held.values, constraints, solve, progress.Part(0.5, 1.0));
  SetMeans(space, solution.isHeld, means, solution.coefficients, options_.functions.threads);
  std::vector<std::string> sentences = WarningsOf(solution, solve.tolerance);
  sentences.push_back(WarningOf(field));
  results.Warn(Joined(sentences));
  PoissonSolution result;
  result.coefficients = std::move(solution.coefficients);
  result.accuracy = solution.accuracy;
  return result;
}

} // namespace

std::unique_ptr<Problem> MakePoisson(Properties& properties)
{
  return std::make_unique<PoissonProblem>(properties);
}

} // namespace gridfem
