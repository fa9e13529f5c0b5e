// The eigenproblem of a space on one of its levels, and the constants there.
#ifndef GridFEM_LevelProblem_h
#define GridFEM_LevelProblem_h

#include "Krylov/SpectralProblem.h"
#include "Spaces/SpaceLevels.h"

#include <utility>

namespace gridfem
{

/// Lower limit on the allowed steps of a block that has fewer start vectors than wanted pairs.
constexpr int RandomStartIterations = 40;

/// The constants of a level.
/// @param mass  of this level
inline Constants ConstantsOnLevel(
  const SpaceLevels& space, std::size_t level, const SparseMatrix& mass, int threads)
{
  Components components = space.ComponentsOf(level, threads);
  return Constants(mass, std::move(components.ofFunction), components.count, threads,
    space.Distributed(level), std::move(components.isHeld));
}

/// The eigenproblem of a level, without a preconditioner. Lists that end among the constants need
/// none.
/// @param constants  of this level; they have to outlive the problem
template<class Real>
SpectralProblem<Real> ProblemOnLevel(const SpaceLevels& space, std::size_t level,
  const Constants& constants, SparseMatrix mass, int threads)
{
  SpectralProblem<Real> problem;
  problem.stiffness = space.Matrix(level, 0.0, 1.0, threads);
  problem.mass = std::move(mass);
  problem.constants = &constants;
  problem.distributed = space.Distributed(level);
  problem.threads = threads;
  return problem;
}

} // namespace gridfem

#endif
