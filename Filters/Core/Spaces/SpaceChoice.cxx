#include "Spaces/SpaceChoice.h"

#include "Spaces/HatSpace.h"
#include "Spaces/SmoothSpace.h"

namespace gridfem
{

std::unique_ptr<FiniteElementSpace> BuildSpace(const TriangleMesh& mesh,
  const SpaceOptions& functions, const SpaceChoice& choice, const Progress& progress)
{
  const GridSpaceOptions options{ choice, functions };
  if (choice.kind == FunctionKind::Grid)
  {
    return std::make_unique<GridSpace>(BuildGridSpace(mesh, options, progress));
  }
  if (choice.kind == FunctionKind::SmoothGrid)
  {
    return std::make_unique<SmoothSpace>(BuildSmoothSpace(mesh, options, progress));
  }
  return std::make_unique<HatSpace>(
    BuildHatSpace(mesh, options, HatTransfer::Evaluation, progress));
}

} // namespace gridfem
