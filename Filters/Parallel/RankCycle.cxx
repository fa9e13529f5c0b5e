#include "Parallel/RankCycle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridfem
{

/// The first shared level, solved by one cycle on every rank.
struct RankCycle::Coarse
{
  Coarse(const GridSpace& shared, double a, double b, const MultigridOptions& options)
    : cycle(BuildMultigrid(shared, a, b, options)), times(options.cycle == CycleType::W ? 2 : 1),
      functions(shared.NumberOfFunctions(0))
  {
  }

  void Apply(Vec r, Vec z);

  Multigrid cycle;
  int times; // that it is visited from the level above
  Index functions;
  PetscMatrix matrix; // of its size, without entries
  PetscScatter toAll;
  PetscVector all; // of this process alone
  MultiVector load;
  MultiVector solution;
};

void RankCycle::Coarse::Apply(Vec r, Vec z)
{
  Check(VecScatterBegin(toAll, r, all, INSERT_VALUES, SCATTER_FORWARD));
  Check(VecScatterEnd(toAll, r, all, INSERT_VALUES, SCATTER_FORWARD));
  load.resize(functions, 1);
  {
    VectorEntries entries(all);
    for (Index k = 0; k < functions; ++k)
    {
      load(k, 0) = entries[k];
    }
  }
  cycle.Precondition(load, solution);
  for (int time = 1; time < times; ++time)
  {
    cycle.Cycle(load, solution);
  }
  PetscInt begin = 0;
  PetscInt end = 0;
  Check(VecGetOwnershipRange(z, &begin, &end));
  VectorEntries entries(z);
  for (PetscInt k = begin; k < end; ++k)
  {
    entries[k - begin] = solution(k, 0);
  }
}

RankCycle::RankCycle(
  const RankSpace& space, double a, double b, const MultigridOptions& options, std::size_t finest)
  : ranks_(space.Ranks())
{
  StartPetsc(ranks_);
  this->BuildLevels(space, a, b, options, finest);
  this->BuildCycle(options);
}

RankCycle::~RankCycle() = default;

void RankCycle::BuildLevels(
  const RankSpace& space, double a, double b, const MultigridOptions& options, std::size_t finest)
{
  const auto& numberings = space.Numberings();
  const Index shared = space.Shared().NumberOfFunctions(0);
  const Id ownShared = shared / ranks_.Size() + (ranks_.Rank() < shared % ranks_.Size() ? 1 : 0);
  ranks_.Together([&] { coarse_ = std::make_unique<Coarse>(space.Shared(), a, b, options); });
  Check(MatCreateShell(ranks_.Handle(), static_cast<PetscInt>(ownShared),
    static_cast<PetscInt>(ownShared), shared, shared, nullptr, coarse_->matrix.Receive()));
  Check(MatSetUp(coarse_->matrix));
  levels_.reserve(numberings.size() - finest);
  const std::vector<Id> sameNumbers;
  for (std::size_t l = finest; l < numberings.size(); ++l)
  {
    SparseMatrix own;
    ranks_.Together([&] { space.Own().FillMatrix(l, a, b, own, options.threads); });
    const bool isLast = l + 1 == numberings.size();
    levels_.push_back({ SumOverRanks(ranks_, numberings[l], own),
      RowsOfOwners(ranks_, numberings[l], space.Own().Prolongation(l),
        isLast ? sameNumbers : numberings[l + 1].number,
        isLast ? ownShared : Id{ numberings[l + 1].OwnFunctions() }),
      LevelVectors(ranks_, numberings[l]), nullptr });
    Level& level = levels_.back();
    level.smoother = std::make_unique<RankSmoother>(
      ranks_, level.matrix, own, numberings[l], space.Own().Functions().levels[l], options);
  }
}

void RankCycle::BuildCycle(const MultigridOptions& options)
{
  const auto levels = static_cast<PetscInt>(levels_.size()) + 1; // PETSc counts from the coarsest
  Check(PCCreate(ranks_.Handle(), cycle_.Receive()));
  Check(PCSetType(cycle_, PCMG));
  Check(PCMGSetLevels(cycle_, levels, nullptr));
  Check(PCMGSetDistinctSmoothUp(cycle_));
  Check(PCMGSetGalerkin(cycle_, PC_MG_GALERKIN_NONE));
  Check(PCMGSetCycleType(cycle_, options.cycle == CycleType::W ? PC_MG_CYCLE_W : PC_MG_CYCLE_V));
  Check(PCSetOperators(cycle_, levels_.front().matrix, levels_.front().matrix));
  sweeps_.reserve(2 * levels_.size());
  for (std::size_t l = 0; l < levels_.size(); ++l)
  {
    const auto number = levels - 1 - static_cast<PetscInt>(l);
    Level& level = levels_[l];
    Check(PCMGSetInterpolation(cycle_, number, level.prolongation));
    KSP down = nullptr;
    KSP up = nullptr;
    Check(PCMGGetSmootherDown(cycle_, number, &down));
    Check(PCMGGetSmootherUp(cycle_, number, &up));
    sweeps_.push_back({ this, level.smoother.get(), SweepDirection::Forward });
    this->SetSmoother(down, level.matrix, options.preSweeps, sweeps_.back());
    sweeps_.push_back({ this, level.smoother.get(), SweepDirection::Backward });
    this->SetSmoother(up, level.matrix, options.postSweeps, sweeps_.back());
  }
  KSP solver = nullptr;
  PC pc = nullptr;
  Check(PCMGGetCoarseSolve(cycle_, &solver));
  Check(KSPSetType(solver, KSPPREONLY));
  Check(KSPSetOperators(solver, coarse_->matrix, coarse_->matrix));
  Check(KSPGetPC(solver, &pc));
  Check(PCSetType(pc, PCSHELL));
  Check(PCShellSetContext(pc, this));
  Check(PCShellSetApply(pc, RunCoarse));
  PetscVector coarse;
  Check(MatCreateVecs(levels_.back().prolongation, coarse.Receive(), nullptr));
  Check(VecScatterCreateToAll(coarse, coarse_->toAll.Receive(), coarse_->all.Receive()));
  Check(PCSetUp(cycle_));
}

void RankCycle::SetSmoother(KSP solver, Mat matrix, int sweeps, Sweep& sweep)
{
  PC pc = nullptr;
  Check(KSPSetType(solver, KSPRICHARDSON));
  Check(KSPSetNormType(solver, KSP_NORM_NONE));
  // PETSc would begin anew where a W cycle comes to a level for the second time.
  Check(KSPSetInitialGuessNonzero(solver, PETSC_TRUE));
  Check(KSPSetConvergenceTest(solver, KSPConvergedSkip, nullptr, nullptr));
  Check(KSPSetTolerances(solver, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, sweeps));
  Check(KSPSetOperators(solver, matrix, matrix));
  Check(KSPGetPC(solver, &pc));
  Check(PCSetType(pc, PCSHELL));
  Check(PCShellSetContext(pc, &sweep));
  Check(PCShellSetApplyRichardson(pc, RunSweeps));
}

/// What a rank's own work throws does not pass through PETSc: what is not a number ends the
/// iteration on all ranks. An error of PETSc itself does, because no more messages can be relied
/// upon.
template<class Body>
PetscErrorCode RankCycle::Keep(Vec result, Body&& body)
{
  try
  {
    body();
  }
  catch (const PetscFailure& error)
  {
    return error.code;
  }
  catch (...)
  {
    failure_ = std::current_exception();
    return VecSet(result, std::numeric_limits<double>::quiet_NaN());
  }
  return 0;
}

/// What PETSc's Richardson iteration is replaced by: it would compute a residual for every sweep.
PetscErrorCode RankCycle::RunSweeps(PC pc, Vec b, Vec x, Vec, PetscReal, PetscReal, PetscReal,
  PetscInt sweeps, PetscBool, PetscInt* done, PCRichardsonConvergedReason* reason)
{
  void* context = nullptr;
  const PetscErrorCode code = PCShellGetContext(pc, &context);
  if (code)
  {
    return code;
  }
  const Sweep& sweep = *static_cast<Sweep*>(context);
  *done = sweeps;
  *reason = PCRICHARDSON_CONVERGED_ITS;
  return sweep.cycle->Keep(x,
    [&]
    {
      for (PetscInt k = 0; k < sweeps; ++k)
      {
        sweep.smoother->Sweep(b, x, sweep.direction);
      }
    });
}

PetscErrorCode RankCycle::RunCoarse(PC pc, Vec r, Vec z)
{
  void* context = nullptr;
  const PetscErrorCode code = PCShellGetContext(pc, &context);
  if (code)
  {
    return code;
  }
  auto& cycle = *static_cast<RankCycle*>(context);
  return cycle.Keep(z, [&] { cycle.coarse_->Apply(r, z); });
}

PetscErrorCode RankCycle::Precondition(PC pc, Vec r, Vec z)
{
  void* context = nullptr;
  const PetscErrorCode code = PCShellGetContext(pc, &context);
  if (code)
  {
    return code;
  }
  auto& cycle = *static_cast<RankCycle*>(context);
  return cycle.Keep(z,
    [&]
    {
      Check(VecNorm(r, NORM_2, &cycle.residual_));
      Check(VecCopy(r, cycle.projected_));
      (*cycle.ofResidual_)(cycle.projected_);
      Check(PCApply(cycle.cycle_, cycle.projected_, z));
      (*cycle.ofSolution_)(z);
    });
}

/// Collective. What has failed within PETSc on one rank fails on all.
void RankCycle::ThrowTogether()
{
  ranks_.Together(
    [&]
    {
      if (failure_)
      {
        std::rethrow_exception(std::exchange(failure_, nullptr));
      }
    });
}

void RankCycle::Apply(Vec r, Vec z)
{
  Check(PCApply(cycle_, r, z));
  this->ThrowTogether();
}

/// What the iteration is watched with.
struct RankCycle::Watch
{
  const Communicator& ranks;
  const SolveOptions& options;
  const Progress& progress;
  double size;            // of the solution in the energy norm, a lower bound
  double load;            // |b|
  const double& residual; // |b - A x| of the iteration that has ended
  SolveReport report;
  bool isAborted = false;
};

PetscErrorCode RankCycle::IsDone(
  KSP, PetscInt iteration, PetscReal norm, KSPConvergedReason* reason, void* context)
{
  Watch& watch = *static_cast<Watch*>(context);
  SolveReport& report = watch.report;
  watch.size = iteration == 0 ? std::max(watch.size, norm) : watch.size;
  const double energy = watch.size > 0.0 ? norm / watch.size : norm;
  report.iterations = static_cast<int>(iteration);
  report.history.push_back({ static_cast<int>(iteration), energy,
    watch.load > 0.0 ? watch.residual / watch.load : watch.residual });
  double wish = watch.progress.Report(double(iteration) / watch.options.maximumIterations) ? 0 : 1;
  watch.ranks.Maximum(&wish, 1);
  watch.isAborted = wish > 0.0;
  *reason = KSP_CONVERGED_ITERATING;
  if (watch.isAborted)
  {
    *reason = KSP_DIVERGED_ITS;
  }
  else if (!std::isfinite(norm))
  {
    report.end = SolveEnd::NotFinite;
    *reason = KSP_DIVERGED_NANORINF;
  }
  else if (norm == 0.0 || energy <= watch.options.tolerance)
  {
    report.end = SolveEnd::Converged;
    *reason = KSP_CONVERGED_RTOL;
  }
  else if (iteration >= watch.options.maximumIterations)
  {
    report.end = SolveEnd::IterationLimit;
    *reason = KSP_DIVERGED_ITS;
  }
  return 0;
}

/// A start from the coarsest level up, a cycle on each. [T §3.3]
/// @return a lower bound of the solution's energy norm: bᵀx / |x|_A
double RankCycle::Start(Vec b, Vec x)
{
  Check(PCMGSetType(cycle_, PC_MG_FULL));
  Check(PCApply(cycle_, b, x));
  Check(PCMGSetType(cycle_, PC_MG_MULTIPLICATIVE));
  (*ofSolution_)(x);
  PetscVector product;
  Check(VecDuplicate(b, product.Receive()));
  Check(MatMult(levels_.front().matrix, x, product));
  double load = 0.0;
  double energy = 0.0;
  Check(VecDot(b, x, &load));
  Check(VecDot(product, x, &energy));
  return load > 0.0 && energy > 0.0 ? load / std::sqrt(energy) : 0.0;
}

/// |b - A x| / |b|
double RankCycle::RelativeResidual(Vec b, Vec x) const
{
  PetscVector residual;
  double size = 0.0;
  double left = 0.0;
  Check(VecDuplicate(b, residual.Receive()));
  Check(MatMult(levels_.front().matrix, x, residual));
  Check(VecAYPX(residual, -1.0, b));
  Check(VecNorm(residual, NORM_2, &left));
  Check(VecNorm(b, NORM_2, &size));
  return size > 0.0 ? left / size : left;
}

SolveReport RankCycle::Solve(Vec b, Vec x, const SolveOptions& options,
  const Projection& ofSolution, const Projection& ofResidual, const Progress& progress)
{
  ofSolution_ = &ofSolution;
  ofResidual_ = &ofResidual;
  if (!projected_)
  {
    Check(VecDuplicate(b, projected_.Receive()));
  }
  double load = 0.0;
  Check(VecNorm(b, NORM_2, &load));
  Watch watch{ ranks_, options, progress, this->Start(b, x), load, residual_, {}, false };
  watch.report.end = SolveEnd::Breakdown; // unless the test of convergence says otherwise
  PetscSolver solver;
  PC pc = nullptr;
  Check(KSPCreate(ranks_.Handle(), solver.Receive()));
  Check(KSPSetType(solver, KSPCG));
  Check(KSPSetNormType(solver, KSP_NORM_NATURAL));
  Check(KSPSetOperators(solver, levels_.front().matrix, levels_.front().matrix));
  Check(KSPSetInitialGuessNonzero(solver, PETSC_TRUE));
  Check(KSPSetConvergenceTest(solver, IsDone, &watch, nullptr));
  Check(KSPSetTolerances(
    solver, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, options.maximumIterations));
  Check(KSPGetPC(solver, &pc));
  Check(PCSetType(pc, PCSHELL));
  Check(PCShellSetContext(pc, this));
  Check(PCShellSetApply(pc, Precondition));
  Check(KSPSolve(solver, b, x));
  this->ThrowTogether();
  if (watch.isAborted)
  {
    throw Aborted();
  }
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  Check(KSPGetConvergedReason(solver, &reason));
  if (reason < 0 && watch.report.end == SolveEnd::Converged)
  {
    watch.report.end = SolveEnd::Breakdown;
  }
  watch.report.history.back().residual = this->RelativeResidual(b, x);
  watch.report.converged = watch.report.end == SolveEnd::Converged;
  watch.report.convergenceFactor = MeanFactor(watch.report);
  return watch.report;
}

} // namespace gridfem
