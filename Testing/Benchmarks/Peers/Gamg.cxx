#include "AlgebraicMultigrid.h"

#include <petscksp.h>

#include <cstdlib>

namespace gridfem::benchmarks
{

namespace
{

/// The library takes settings of inner solvers only as text.
void UseThesisOptions()
{
  const char* const settings[][2] = { { "-thesis_pc_mg_cycle_type", "w" },
    { "-thesis_pc_gamg_coarse_eq_limit", "99" }, { "-thesis_mg_levels_ksp_type", "richardson" },
    { "-thesis_mg_levels_ksp_max_it", "10" }, { "-thesis_mg_levels_pc_type", "sor" },
    { "-thesis_mg_levels_pc_sor_forward", nullptr } };
  for (const auto& [name, value] : settings)
  {
    PetscOptionsSetValue(nullptr, name, value);
  }
}

class Gamg : public AlgebraicMultigrid
{
public:
  Gamg(const SymmetricMatrix& A, AmgUse use) : use_(use), rows_(static_cast<PetscInt>(A.rows()))
  {
    MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, rows_, rows_, const_cast<int*>(A.outerIndexPtr()),
      const_cast<int*>(A.innerIndexPtr()), const_cast<double*>(A.valuePtr()), &matrix_);
    MatSetOption(matrix_, MAT_SPD, PETSC_TRUE);
  }

  ~Gamg() override
  {
    KSPDestroy(&solver_);
    MatDestroy(&matrix_);
  }

  void Setup() override
  {
    KSPDestroy(&solver_);
    KSPCreate(PETSC_COMM_SELF, &solver_);
    KSPSetOperators(solver_, matrix_, matrix_);
    KSPSetType(solver_, use_ == AmgUse::ThesisCycle ? KSPRICHARDSON : KSPCG);
    PC cycle = nullptr;
    KSPGetPC(solver_, &cycle);
    PCSetType(cycle, PCGAMG);
    if (use_ == AmgUse::ThesisCycle)
    {
      UseThesisOptions();
      KSPSetOptionsPrefix(solver_, "thesis_");
    }
    KSPSetFromOptions(solver_); // PETSC_OPTIONS in the environment tries other settings
    KSPSetUp(solver_);
  }

  int Solve(const Eigen::VectorXd& b, Eigen::VectorXd& x, double tolerance, int iterations) override
  {
    x.resize(rows_);
    Vec source = nullptr;
    Vec solution = nullptr;
    VecCreateSeqWithArray(PETSC_COMM_SELF, 1, rows_, b.data(), &source);
    VecCreateSeqWithArray(PETSC_COMM_SELF, 1, rows_, x.data(), &solution);
    KSPSetNormType(
      solver_, use_ == AmgUse::ThesisCycle ? KSP_NORM_NONE : KSP_NORM_UNPRECONDITIONED);
    KSPSetTolerances(solver_, tolerance, PETSC_DEFAULT, PETSC_DEFAULT, iterations);
    KSPSolve(solver_, source, solution);
    PetscInt count = 0;
    KSPGetIterationNumber(solver_, &count);
    VecDestroy(&source);
    VecDestroy(&solution);
    return count;
  }

private:
  AmgUse use_;
  PetscInt rows_;
  Mat matrix_ = nullptr;
  KSP solver_ = nullptr;
};

} // namespace

MessagePassing::MessagePassing()
{
  // A process that nobody started in parallel needs no daemon for it.
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  PetscInitializeNoArguments();
  PetscPopSignalHandler();
}

MessagePassing::~MessagePassing()
{
  PetscFinalize();
}

std::unique_ptr<AlgebraicMultigrid> MakeGamg(const SymmetricMatrix& A, AmgUse use)
{
  return std::make_unique<Gamg>(A, use);
}

} // namespace gridfem::benchmarks
