// Random equations.
#include "RandomProblem.h"

#include "Algebra/ComponentMeans.h"
#include "Distance/GeodesicDistance.h"
#include "Distance/NearestSource.h"
#include "Equations/EdgeConditions.h"
#include "Equations/HarmonicInterpolation.h"
#include "Equations/HeatDiffusion.h"
#include "Spectrum/SpectralDescriptors.h"
#include "Spectrum/Spectrum.h"

#include <algorithm>
#include <cmath>

namespace gridfem::testing
{
namespace
{

/// Requires that the solution has the means of its field.
void RequireMeans(const FiniteElementSpace& space, const MultiVector& load,
  const MultiVector& coefficients, Outcome& outcome)
{
  const Components components = space.ComponentsOf(0);
  const ComponentMeans means(components.ofFunction, space.Integrals(), components.count, 1);
  const MultiVector wanted = means.OfIntegrals(load);
  const MultiVector found = means.OfFunction(coefficients);
  const double size =
    coefficients.size() > 0 ? coefficients.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() : 0.0;
  // Means of components without area are undefined. Rounding grows with the number of functions.
  const bool isKept = wanted.size() == 0 || !outcome.converged ||
                      (wanted - found).cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= 1e-9 * size;
  outcome.Require(isKept, "the mean is not kept");
}

MultiVector RandomGradients(Choice& choice, const RandomSurface& surface, const Field& f)
{
  const FiniteElementSpace& space = *surface.space;
  switch (choice.Integer(0, 3))
  {
    case 0:
      return f.association == FieldAssociation::Points ? space.LoadOfGradientsOf(f, nullptr)
                                                       : MultiVector();
    case 1:
      return space.LoadOfGradients(
        OrdinaryField(choice, *surface.mesh, 3 * f.values.cols(), FieldAssociation::Triangles),
        nullptr);
    default:
      return {};
  }
}

FieldAssociation RandomPlace(Choice& choice)
{
  return choice.Of(
    { FieldAssociation::Points, FieldAssociation::Triangles, FieldAssociation::Corners });
}

} // namespace

void SolveDefaultPoisson(Choice& choice, RandomSurface& surface, Outcome& outcome)
{
  surface.Build();
  const FiniteElementSpace& space = *surface.space;
  PoissonOptions options;
  options.screeningWeight = RandomWeight(choice);
  options.solve.tolerance = 1e-6;
  options.solve.maximumIterations = 200;
  options.multigrid.threads = 1;
  const Field f = OrdinaryField(choice, *surface.mesh, choice.Integer(1, 3), RandomPlace(choice));
  const MultiVector load = space.LoadOfValues(f);
  const MultiVector gradients = RandomGradients(choice, surface, f);
  const Multigrid multigrid =
    BuildMultigrid(space, options.screeningWeight, 1.0, options.multigrid);
  const PoissonSolution solution = SolvePoisson(space, multigrid, load, gradients, options);
  outcome.Add(solution.report);
  outcome.isDataLimited = solution.isAtRounding;
  outcome.RequireFinite(solution.coefficients, "the solution");
  RequireMeans(space, load, solution.coefficients, outcome);
}

void SolveAnyPoisson(Choice& choice, RandomSurface& surface, Outcome& outcome)
{
  surface.Build();
  const FiniteElementSpace& space = *surface.space;
  PoissonOptions options;
  options.screeningWeight =
    choice.OneIn(20) ? choice.Of({ -1.0, 1e150, 1e300, std::nan("") }) : RandomWeight(choice);
  options.multigrid = RandomCycle(choice);
  options.solve = RandomSolve(choice);
  options.iteration = choice.Of({ IterationType::ConjugateGradients, IterationType::Cycles });
  options.accuracy = choice.OneIn(2) ? 0.0 : choice.Real(0.0, 1.0);
  options.estimateErrors = choice.OneIn(2);
  const Field f = RandomField(choice, *surface.mesh, choice.Integer(0, 4), RandomPlace(choice));
  const MultiVector load = space.LoadOfValues(f);
  const Multigrid multigrid = BuildMultigrid(space,
    std::isnan(options.screeningWeight) ? 1.0 : options.screeningWeight, 1.0, options.multigrid);
  const PoissonSolution solution =
    SolvePoisson(space, multigrid, load, RandomGradients(choice, surface, f), options);
  outcome.Add(solution.report);
  outcome.RequireFinite(solution.coefficients, "the solution");
  outcome.RequireEstimate(solution.accuracy);
}

void SolveWithConstraints(Choice& choice, RandomSurface& surface, Outcome& outcome)
{
  surface.Build();
  const FiniteElementSpace& space = *surface.space;
  const TriangleMesh& mesh = *surface.mesh;
  const std::vector<Id> points = RandomPoints(choice, mesh, 10);
  const Field f = RandomField(choice, mesh, choice.Integer(1, 2), FieldAssociation::Points);
  MultiVector values(points.size(), f.values.cols());
  for (Id k = 0; k < values.rows(); ++k)
  {
    values.row(k) = MultiVector::Constant(1, values.cols(), choice.Real(-1.0, 1.0));
  }
  HeldValues held = HoldPoints(space, points, values);
  if (choice.OneIn(2))
  {
    const SurfaceEdges edges =
      FindSurfaceEdges(mesh, surface.options.functions.weldCoincidentPoints);
    held = Join(held, HoldEdges(space, mesh, edges.boundary, f.values));
    LoadOnEdges(space, mesh, edges.branching, f.values);
  }
  const double weight = RandomWeight(choice);
  ConstraintOptions constraints;
  constraints.penalty = choice.PowerOfTen(0.0, 6.0);
  constraints.maximumSteps = static_cast<int>(choice.Integer(1, 12));
  constraints.estimateOn = &space;
  const ConstrainedHierarchy hierarchy(
    space, weight, 1.0, held.rows, constraints.penalty, RandomCycle(choice));
  MultiVector load = weight * space.LoadOfValues(f);
  ConstrainedSolution solution =
    SolveConstrained(space, weight, hierarchy, load, held.values, constraints, RandomSolve(choice));
  outcome.Add(solution.report);
  const Components components = space.ComponentsOf(0);
  SetMeans(space, solution.isHeld, MultiVector::Zero(components.count, values.cols()),
    solution.coefficients);
  outcome.RequireFinite(solution.coefficients, "the solution with constraints");
  outcome.RequireEstimate(solution.accuracy);
}

void FindSpectrum(Choice& choice, RandomSurface& surface, Outcome& outcome)
{
  surface.Build();
  const FiniteElementSpace& space = *surface.space;
  SpectrumOptions options;
  options.numberOfModes = static_cast<int>(choice.Integer(1, 12));
  options.tolerance = choice.PowerOfTen(-12.0, -1.0);
  options.maximumIterations = static_cast<int>(choice.Of({ 0, 5, 50 }));
  options.completeMultiplets = choice.OneIn(2);
  options.multigrid.threads = 1;
  if (choice.OneIn(3))
  {
    options.multigrid = RandomCycle(choice);
  }
  const Spectrum spectrum = ComputeSpectrum(space, options);
  outcome.isIterative = true;
  outcome.converged = spectrum.converged;
  outcome.RequireFinite(spectrum.vectors, "an eigenfunction");
  outcome.Require(std::is_sorted(spectrum.eigenvalues.begin(), spectrum.eigenvalues.end()),
    "eigenvalues are not sorted");
  outcome.Require(spectrum.eigenvalues.empty() || spectrum.eigenvalues.front() >= 0.0,
    "an eigenvalue is negative");
  if (!spectrum.converged || spectrum.vectors.cols() == 0)
  {
    return;
  }
  MultiVector massX;
  Multiply(space.Matrix(0, 1.0, 0.0), spectrum.vectors, massX);
  const Eigen::MatrixXd gram = spectrum.vectors.transpose() * massX;
  outcome.Require((gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols()))
                      .cwiseAbs()
                      .maxCoeff<Eigen::PropagateNaN>() < 1e-3,
    "eigenfunctions are not orthonormal");
  PointModes modes{ spectrum.eigenvalues, space.ValuesAtPoints(spectrum.vectors), 1.0 };
  const std::vector<Id> sources = RandomPoints(choice, *surface.mesh, 3);
  HeatKernelSignature(modes, HeatTimes(modes, 3));
  WaveKernelSignature(modes, WaveEnergies(modes, 3));
  DiffusionDistance(modes, sources, 1.0);
  for (const double distance : BiharmonicDistance(modes, sources))
  {
    outcome.Require(!(distance < 0.0), "a biharmonic distance is negative");
  }
  const Field f = OrdinaryField(choice, *surface.mesh, 1, FieldAssociation::Points);
  outcome.RequireFinite(
    SumOfModes(modes, ExpandInModes(*surface.mesh, modes, f.values).shares, 0, 100),
    "a sum of modes");
}

void FindDistance(Choice& choice, RandomSurface& surface, Outcome& outcome)
{
  surface.options.normalStabilization = choice.Of({ 0.1, 0.1, 1e-2, 1e-12 });
  surface.Build();
  DistanceOptions options;
  options.smoothing = choice.OneIn(4) ? choice.PowerOfTen(-3.0, 5.0) : 1.75;
  options.multigrid.threads = 1;
  options.estimateErrors = true;
  SolveOptions solve;
  solve.tolerance = 1e-4;
  const std::vector<Id> sources = RandomPoints(choice, *surface.mesh, 4);
  const GeodesicDistance distance(surface.space, surface.mesh, options);
  const DistanceField field = distance.From(sources, solve);
  outcome.Add(field.report);
  outcome.RequireEstimate(field.accuracy);
  const std::vector<Id> nearest = NearestSources(
    *surface.mesh, field.atPoints, sources, surface.options.functions.weldCoincidentPoints);
  for (std::size_t point = 0; point < field.atPoints.size(); ++point)
  {
    const double d = field.atPoints[point];
    outcome.Require(!(d < 0.0) && !std::isinf(d), "a distance is negative or infinite");
    const bool isNone = nearest[point] == -1;
    // Plain functions have distances across gaps, where triangles lead to no source.
    const bool isAcross = isNone && !surface.options.functions.connectivityAware;
    outcome.Require(
      std::isnan(d) == isNone || isAcross, "a nearest source without a distance, or none");
    outcome.Require(
      isNone || std::count(sources.begin(), sources.end(), nearest[point]) > 0, "no source");
  }
  for (const Id source : sources)
  {
    const double d = field.atPoints[source];
    outcome.Require(d == 0.0 || std::isnan(d), "a source has a distance");
  }
}

void Diffuse(Choice& choice, RandomSurface& surface, Outcome& outcome)
{
  surface.Build();
  const FiniteElementSpace& space = *surface.space;
  DiffusionOptions options;
  options.timeStep = choice.PowerOfTen(-6.0, 8.0);
  options.scheme = choice.Of({ TimeScheme::BackwardEuler, TimeScheme::SecondOrder });
  options.multigrid = RandomCycle(choice);
  options.solve = RandomSolve(choice);
  const MultiVector start =
    space.LoadOfValues(RandomField(choice, *surface.mesh, 2, FieldAssociation::Points));
  const MultiVector sources =
    choice.OneIn(2)
      ? MultiVector()
      : space.LoadOfValues(OrdinaryField(choice, *surface.mesh, 2, FieldAssociation::Triangles));
  HeatDiffusion diffusion(
    std::make_shared<const HeatEquation>(surface.space, options), start, sources);
  for (Id step = choice.Integer(1, 3); step > 0; --step)
  {
    outcome.Add(diffusion.Advance());
  }
  outcome.RequireFinite(diffusion.Coefficients(), "the heat");
  outcome.RequireEstimate(diffusion.Accuracy());
  if (sources.rows() == 0)
  {
    RequireMeans(space, start, diffusion.Coefficients(), outcome);
  }
}

void Interpolate(Choice& choice, RandomSurface& surface, Outcome& outcome)
{
  surface.Build();
  const FiniteElementSpace& space = *surface.space;
  const std::vector<Id> points = RandomPoints(choice, *surface.mesh, 10);
  MultiVector values(points.size(), 2);
  for (Id k = 0; k < values.size(); ++k)
  {
    values.data()[k] = choice.Real(-1.0, 1.0);
  }
  InterpolationOptions options;
  options.smoothness = choice.Of({ Smoothness::Harmonic, Smoothness::Biharmonic });
  options.multigrid = RandomCycle(choice);
  options.solve = RandomSolve(choice);
  const SparseMatrix rows = space.RowsAtPoints(points);
  const ConstrainedSolution solution = InterpolateHarmonically(space, rows, values, options);
  outcome.RequireEstimate(solution.accuracy);
  outcome.Add(solution.report);
  const std::vector<char> isHeld = HeldComponents(space, 0.0, rows, space.ComponentsOf(0));
  if (std::find(isHeld.begin(), isHeld.end(), 0) == isHeld.end())
  {
    outcome.RequireFinite(solution.coefficients, "the interpolation");
  }
}

} // namespace gridfem::testing
