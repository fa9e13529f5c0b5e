#include "Solvers/GradientSolver.h"

#include "Base/Errors.h"
#include "Solvers/SolveOnMesh.h"
#include "Solvers/SolveWarnings.h"

#include <utility>

namespace gridfem
{
namespace
{

std::string WarningOfOneSided(const HodgeDecomposition& parts)
{
  return parts.numberOfOneSided == 0 ? std::string()
                                     : std::to_string(parts.numberOfOneSided) + " of " +
                                         std::to_string(parts.numberOfComponents) +
                                         " connected components have only one side, so rotation "
                                         "has no direction there. Their "
                                         "rotating flow is in the HarmonicPart.";
}

} // namespace

const GradientSolver::Result& GradientSolver::Update(
  Surface& surface, const Input& input, const Options& options, const Job& job)
{
  RequireOptions(options);
  if (options.hodgeDecomposition && input.values.components != 3)
  {
    throw InvalidInput(
      "Hodge Decomposition needs vectors. Choose an Array with three components, or "
      "turn Hodge Decomposition off.");
  }
  surface.Prepare(job.progress.Part(0.0, 0.5));
  EquationOptions equation = options.equation;
  equation.multigrid.threads = surface.Threads();
  StageKey key;
  key.Add(surface.GetStages().Version(SystemStage)).Add(KeyOf(input.values)).Add(KeyOf(equation));
  const double share = options.hodgeDecomposition ? 0.7 : 1.0;
  this->Derive(surface, input, key, equation, { surface.Threads(), job.progress.Part(0.5, share) });
  result_.report = ofDerivatives_.report;
  result_.accuracy = ofDerivatives_.accuracy;
  result_.warnings.clear();
  if (options.hodgeDecomposition == result_.parts.empty())
  {
    result_.parts.swap(hiddenParts_);
  }
  if (options.hodgeDecomposition)
  {
    this->Decompose(
      surface, input, key, equation, { surface.Threads(), job.progress.Part(share, 1.0) });
    KeepWorse(ofParts_.report, result_.report);
    KeepWorse(ofParts_.accuracy, result_.accuracy);
    if (!ofParts_.warning.empty())
    {
      result_.warnings.push_back(ofParts_.warning);
    }
  }
  const std::string unconverged =
    WarningOf(result_.report, result_.accuracy, equation.solve.tolerance);
  if (!unconverged.empty())
  {
    result_.warnings.push_back(unconverged);
  }
  return result_;
}

void GradientSolver::Derive(const Surface& surface, const Input& input, const StageKey& key,
  const EquationOptions& equation, const Job& job)
{
  surface.GetStages().Run(SolveStage, key,
    [&]
    {
      const MultiVector one = MultiVector::Ones(static_cast<Id>(surface.Mesh().points.size()), 1);
      const BoundaryTerms boundary = surface.OnBoundary(&one, nullptr);
      Field values = ReadField(surface, input.values);
      TakeConstantsOut(surface, values);
      SurfaceDerivatives found = ComputeDerivatives(surface.Space(), surface.Mesh(), values,
        boundary.isThere ? &boundary.load : nullptr, equation, job);
      std::vector<Derived>& derived = result_.derivatives;
      derived.clear();
      derived.push_back(
        { "Gradient", std::move(found.gradientAtPoints), std::move(found.gradientOnTriangles) });
      derived.push_back(
        { "Laplacian", std::move(found.laplacianAtPoints), std::move(found.laplacianOnTriangles) });
      if (input.values && found.divergenceAtPoints.cols() == 1)
      {
        derived.push_back({ "Divergence", std::move(found.divergenceAtPoints),
          std::move(found.divergenceOnTriangles) });
        derived.push_back(
          { "Curl", std::move(found.curlAtPoints), std::move(found.curlOnTriangles) });
      }
      for (Derived& field : derived)
      {
        surface.CompleteAtPoints(field.atPoints);
      }
      ofDerivatives_ = { std::move(found.report), found.accuracy, {} };
      ofDerivatives_.accuracy.largest = surface.Largest(found.accuracy.largest);
    });
}

void GradientSolver::Decompose(const Surface& surface, const Input& input, const StageKey& key,
  const EquationOptions& equation, const Job& job)
{
  surface.GetStages().Run(HodgeStage, key,
    [&]
    {
      HodgeDecomposition found = DecomposeField(*surface.WholeSpace(), surface.Mesh(),
        ReadField(surface, input.values), { equation, surface.AreCoincidentPointsWelded() }, job);
      std::vector<Derived>& parts = result_.parts;
      parts.clear();
      parts.push_back({ "GradientPart", std::move(found.gradientAtPoints),
        std::move(found.gradientOnTriangles) });
      parts.push_back({ "RotationPart", std::move(found.rotationAtPoints),
        std::move(found.rotationOnTriangles) });
      parts.push_back(
        { "HarmonicPart", std::move(found.restAtPoints), std::move(found.restOnTriangles) });
      parts.push_back({ "Potential", std::move(found.potentialAtPoints), {} });
      parts.push_back({ "StreamFunction", std::move(found.streamAtPoints), {} });
      for (Derived& part : parts)
      {
        surface.CompleteAtPoints(part.atPoints);
      }
      ofParts_ = { std::move(found.report), found.accuracy, WarningOfOneSided(found) };
    });
}

GradientSolver::Result GradientSolver::Solve(std::shared_ptr<const TriangleMesh> mesh,
  const Input& input, const Options& options, const SurfaceOptions& surfaceOptions, const Job& job)
{
  return SolveOnMesh(
    &GradientSolver::result_, std::move(mesh), surfaceOptions, job, input, options);
}

} // namespace gridfem
