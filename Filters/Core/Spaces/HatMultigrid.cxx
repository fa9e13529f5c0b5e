#include "Spaces/HatMultigrid.h"

#include "Multigrid/MatrixOrdering.h"

#include <iterator>

namespace gridfem
{

HatHierarchy BuildHatHierarchy(const TriangleMesh& mesh, const GridFunctions& space,
  bool weldCoincidentPoints, HatTransfer transfer, int threads, const Progress& progress)
{
  HatOptions options;
  options.weldCoincidentPoints = weldCoincidentPoints;
  options.unitLength = space.GetGrid().spacing;
  options.threads = threads;
  HatHierarchy hats;
  hats.functions = NumberHatFunctions(mesh, options);
  if (hats.functions.Count() == 0)
  {
    throw InvalidInput("No triangle has an area, so there are no hat functions.");
  }
  progress.Check(0.3);
  hats.matrices = AssembleHatMatrices(mesh, hats.functions, threads);
  hats.order = OrderInBlocks(hats.matrices.stiffness);
  hats.groups = GroupByCoupling(hats.matrices.stiffness, threads);
  progress.Check(0.6);
  hats.prolongation = BuildHatProlongation(hats.functions, space, mesh, transfer, threads);
  progress.Check(1.0);
  return hats;
}

HatMultigridOptions HatCycle(const MultigridOptions& grid)
{
  HatMultigridOptions options;
  options.grid = grid;
  options.hats.preSweeps = 2 * grid.preSweeps;
  options.hats.postSweeps = 2 * grid.postSweeps;
  return options;
}

Multigrid BuildHatMultigrid(const HatHierarchy& hats, const GridFunctions& space,
  const LevelOperators& system, double a, double b, const HatMultigridOptions& options,
  const Progress& progress)
{
  std::vector<MultigridLevel> levels(1);
  levels[0].A = Combine(hats.matrices, a, b, options.grid.threads);
  levels[0].prolongation = hats.prolongation;
  levels[0].order = hats.order;
  if (options.relaxGroups)
  {
    levels[0].groups = hats.groups;
  }
  levels[0].smoothing = options.hats;
  std::vector<MultigridLevel> grid =
    BuildMultigridLevels(space, system, a, b, options.grid.threads, progress.Part(0.0, 0.5));
  std::move(grid.begin(), grid.end(), std::back_inserter(levels));
  Multigrid multigrid(std::move(levels), options.grid);
  progress.Check(1.0);
  return multigrid;
}

void UpdateHatMultigrid(const HatHierarchy& hats, const GridFunctions& space,
  const LevelOperators& system, double a, double b, Multigrid& multigrid)
{
  const int threads = multigrid.Options().threads;
  std::vector<SparseMatrix> matrices = LevelMatrices(space, system, a, b, threads);
  matrices.insert(matrices.begin(), Combine(hats.matrices, a, b, threads));
  multigrid.Update(std::move(matrices));
}

} // namespace gridfem
