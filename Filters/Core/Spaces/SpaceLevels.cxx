#include "Spaces/SpaceLevels.h"

#include "Base/LargeMemory.h"

namespace gridfem
{

SparseMatrix SpaceLevels::Matrix(std::size_t level, double a, double b, const Job& job) const
{
  SparseMatrix matrix;
  this->FillMatrix(level, a, b, matrix, job);
  return matrix;
}

std::vector<MultigridLevel> BuildMultigridLevels(const SpaceLevels& space, double a, double b,
  const MultigridOptions& options, const Progress& progress)
{
  std::vector<MultigridLevel> levels(space.NumberOfLevels());
  for (std::size_t l = 0; l < levels.size(); ++l)
  {
    levels[l].A = space.Matrix(l, a, b, options.threads);
    LevelRelaxation relaxation = space.Relaxation(l, options);
    levels[l].order = std::move(relaxation.order);
    levels[l].groups = std::move(relaxation.groups);
    levels[l].smoothing = relaxation.smoothing;
    levels[l].distributed = space.Divide(l, levels[l].A, options);
    if (l + 1 < levels.size())
    {
      levels[l].prolongation = space.Prolongation(l);
      levels[l].restriction = space.Restriction(l);
    }
    progress.Check(double(l + 1) / double(levels.size()));
  }
  return levels;
}

Multigrid BuildMultigrid(const SpaceLevels& space, double a, double b,
  const MultigridOptions& options, const Progress& progress)
{
  Multigrid multigrid(BuildMultigridLevels(space, a, b, options, progress.Part(0.0, 0.5)), options);
  progress.Check(1.0);
  return multigrid;
}

void UpdateMultigrid(const SpaceLevels& space, double a, double b, Multigrid& multigrid)
{
  const MemoryReuse reuse; // the new factors reuse the memory of the old ones
  multigrid.Update([&](std::size_t level, SparseMatrix& matrix)
    { space.FillMatrix(level, a, b, matrix, multigrid.Options().threads); });
}

} // namespace gridfem
