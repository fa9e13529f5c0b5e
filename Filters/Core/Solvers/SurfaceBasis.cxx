#include "Solvers/SurfaceBasis.h"

#include "Integrals/QuadratureRule.h"
#include "Solvers/Requirements.h"

namespace gridfem
{
namespace
{

OperatorKey OperatorKeyOf(const SpaceChoice& choice)
{
  return { choice.quadratureDegree, choice.coarsestSize, choice.normalStabilization };
}

std::shared_ptr<const FiniteElementSpace> OnSmoothGrid(
  const SurfaceBasis& basis, std::shared_ptr<const SmoothOperators> operators)
{
  return operators
           ? std::make_shared<const SmoothSpace>(basis.mesh, basis.space, std::move(operators))
           : nullptr;
}

/// Null unless its parts are there.
std::shared_ptr<const FiniteElementSpace> Compose(const SurfaceBasis& basis,
  std::shared_ptr<const LevelOperators> operators, FunctionKind kind,
  std::shared_ptr<const HatLevel> hats)
{
  if (!operators || (kind == FunctionKind::Hats && !hats))
  {
    return nullptr;
  }
  GridSpace grid(basis.mesh, basis.space, std::move(operators));
  if (kind == FunctionKind::Grid)
  {
    return std::make_shared<const GridSpace>(std::move(grid));
  }
  return std::make_shared<const HatSpace>(std::move(hats), std::move(grid));
}

} // namespace

SurfaceBasis MakeSurfaceBasis(
  std::shared_ptr<const TriangleMesh> mesh, GridFunctions space, bool weldCoincidentPoints)
{
  SurfaceBasis basis;
  basis.mesh = std::move(mesh);
  basis.space = std::make_shared<const GridFunctions>(std::move(space));
  basis.operators = std::make_shared<OperatorStore>();
  basis.smooth = std::make_shared<SmoothStore>();
  basis.hats = std::make_shared<HatStore>();
  basis.weldCoincidentPoints = weldCoincidentPoints;
  return basis;
}

std::shared_ptr<const FiniteElementSpace> FindSpace(
  const SurfaceBasis& basis, const SpaceChoice& choice)
{
  if (choice.kind == FunctionKind::SmoothGrid)
  {
    return OnSmoothGrid(basis, basis.smooth->Find(OperatorKeyOf(choice)));
  }
  return Compose(basis, basis.operators->Find(OperatorKeyOf(choice)), choice.kind,
    choice.kind == FunctionKind::Hats
      ? basis.hats->Find({ basis.weldCoincidentPoints, OperatorKeyOf(choice) })
      : nullptr);
}

std::shared_ptr<const FiniteElementSpace> MakeSpace(
  const SurfaceBasis& basis, const SpaceChoice& choice, const Job& job)
{
  const QuadratureRule& rule = TriangleRule(choice.quadratureDegree);
  if (choice.kind == FunctionKind::SmoothGrid)
  {
    return OnSmoothGrid(basis, basis.smooth->Get(OperatorKeyOf(choice),
                                 [&]
                                 {
                                   return BuildSmoothOperators(*basis.space,
                                     choice.quadratureDegree, choice.normalStabilization,
                                     choice.coarsestSize, job);
                                 }));
  }
  auto operators = basis.operators->Get(OperatorKeyOf(choice),
    [&]
    {
      return BuildLevelOperators(
        *basis.space, rule, job.Part(0.0, 0.7), choice.coarsestSize, choice.normalStabilization);
    });
  std::shared_ptr<const HatLevel> hats;
  if (choice.kind == FunctionKind::Hats)
  {
    hats = basis.hats->Get({ basis.weldCoincidentPoints, OperatorKeyOf(choice) },
      [&]
      {
        RequireMemoryForHats(*basis.mesh, basis.space->Finest().numberOfFunctions);
        return BuildHatLevel(*basis.mesh, *basis.space, choice, basis.weldCoincidentPoints,
          HatTransfer::Evaluation, job.Part(0.7, 1.0));
      });
  }
  return Compose(basis, std::move(operators), choice.kind, std::move(hats));
}

} // namespace gridfem
