// The multigrid cycle on several ranks: PETSc's on the divided levels, with the patch smoother of
// each rank on its own patches, and Core's on the levels that all ranks share.
#ifndef GridFEM_RankCycle_h
#define GridFEM_RankCycle_h

#include "Krylov/ConjugateGradients.h"
#include "Multigrid/Multigrid.h"
#include "Parallel/RankMatrices.h"
#include "Parallel/RankSmoother.h"
#include "Parallel/RankSpace.h"

#include <exception>
#include <functional>
#include <memory>
#include <vector>

namespace gridfem
{

/// A symmetric preconditioner for a M + b L on a divided level, and conjugate gradients with it.
class RankCycle
{
public:
  /// Collective.
  /// @param finest  the divided level that it begins at
  RankCycle(const RankSpace& space, double a, double b, const MultigridOptions& options,
    std::size_t finest = 0);
  ~RankCycle();
  RankCycle(const RankCycle&) = delete;
  RankCycle& operator=(const RankCycle&) = delete;

  /// Of the level that it begins at.
  const LevelVectors& Vectors() const { return levels_.front().vectors; }

  /// Takes what is solved otherwise out of vectors, as Projection does; collective.
  using Projection = std::function<void(Vec)>;

  /// Collective. z = one cycle from zero for the residual r. Throws on all ranks when it throws on
  /// one.
  void Apply(Vec r, Vec z);

  /// Collective. Conjugate gradients for one right-hand side; `x` gets the solution.
  /// The tolerance is one of the energy residual. Throws Aborted on all ranks when the progress of
  /// one asks for it.
  SolveReport Solve(Vec b, Vec x, const SolveOptions& options, const Projection& ofSolution,
    const Projection& ofResidual, const Progress& progress);

private:
  struct Level
  {
    PetscMatrix matrix;
    PetscMatrix prolongation; // from the next level
    LevelVectors vectors;
    std::unique_ptr<RankSmoother> smoother;
  };
  /// What a sweep of PETSc's cycle is told.
  struct Sweep
  {
    RankCycle* cycle;
    RankSmoother* smoother;
    SweepDirection direction;
  };
  struct Coarse;
  struct Watch;

  void BuildLevels(const RankSpace& space, double a, double b, const MultigridOptions& options,
    std::size_t finest);
  void ThrowTogether();
  void BuildCycle(const MultigridOptions& options);
  double Start(Vec b, Vec x);
  double RelativeResidual(Vec b, Vec x) const;
  void SetSmoother(KSP solver, Mat matrix, int sweeps, Sweep& sweep);
  template<class Body>
  PetscErrorCode Keep(Vec result, Body&& body);

  static PetscErrorCode RunSweeps(PC pc, Vec b, Vec x, Vec, PetscReal, PetscReal, PetscReal,
    PetscInt sweeps, PetscBool, PetscInt* done, PCRichardsonConvergedReason* reason);
  static PetscErrorCode RunCoarse(PC pc, Vec r, Vec z);
  static PetscErrorCode Precondition(PC pc, Vec r, Vec z);
  static PetscErrorCode IsDone(
    KSP solver, PetscInt iteration, PetscReal norm, KSPConvergedReason* reason, void* context);

  Communicator ranks_;
  std::vector<Level> levels_; // divided ones, finest first
  std::vector<Sweep> sweeps_;
  std::unique_ptr<Coarse> coarse_;
  PetscCycle cycle_;
  PetscVector projected_; // what the cycle is applied to
  double residual_ = 0.0; // its size
  const Projection* ofSolution_ = nullptr;
  const Projection* ofResidual_ = nullptr;
  std::exception_ptr failure_; // of this rank, within PETSc
};

} // namespace gridfem

#endif
