#include "DistributedAmg.h"

#include <petscksp.h>

namespace gridfem::benchmarks
{

namespace
{

/// PETSc takes the settings of hypre as text only.
void UseBoomerOptions()
{
  const char* const settings[][2] = { { "-pc_hypre_type", "boomeramg" },
    { "-pc_hypre_boomeramg_coarsen_type", "HMIS" }, { "-pc_hypre_boomeramg_interp_type", "ext+i" },
    { "-pc_hypre_boomeramg_P_max", "4" }, { "-pc_hypre_boomeramg_strong_threshold", "0.25" },
    { "-pc_hypre_boomeramg_relax_type_all", "symmetric-SOR/Jacobi" } };
  for (const auto& [name, value] : settings)
  {
    PetscOptionsSetValue(nullptr, name, value);
  }
}

class PetscAmg : public DistributedAmg
{
public:
  PetscAmg(MPI_Comm ranks, const MatrixPart& part, DistributedCycle cycle)
  {
    this->Assemble(ranks, part);
    KSPCreate(ranks, &solver_);
    KSPSetOperators(solver_, matrix_, matrix_);
    KSPSetType(solver_, KSPCG);
    KSPSetNormType(solver_, KSP_NORM_NATURAL);
    PC preconditioner = nullptr;
    KSPGetPC(solver_, &preconditioner);
    PCSetType(preconditioner, cycle == DistributedCycle::Gamg ? PCGAMG : PCHYPRE);
    if (cycle == DistributedCycle::BoomerAmg)
    {
      UseBoomerOptions();
    }
    KSPSetFromOptions(solver_); // PETSC_OPTIONS in the environment tries other settings
    KSPSetUp(solver_);
    MatCreateVecs(matrix_, &solution_, &load_);
  }

  ~PetscAmg() override
  {
    VecDestroy(&load_);
    VecDestroy(&solution_);
    KSPDestroy(&solver_);
    MatDestroy(&matrix_);
  }

  Eigen::VectorXd Solve(const Eigen::VectorXd& load, double tolerance) override
  {
    double* values = nullptr;
    VecGetArray(load_, &values);
    Eigen::VectorXd::Map(values, load.size()) = load;
    VecRestoreArray(load_, &values);
    KSPSetTolerances(solver_, tolerance, PETSC_DEFAULT, PETSC_DEFAULT, 1000);
    KSPSolve(solver_, load_, solution_);
    VecGetArray(solution_, &values);
    Eigen::VectorXd own = Eigen::VectorXd::Map(values, load.size());
    VecRestoreArray(solution_, &values);
    return own;
  }

  int Iterations() const override
  {
    PetscInt count = 0;
    KSPGetIterationNumber(solver_, &count);
    return static_cast<int>(count);
  }

private:
  void Assemble(MPI_Comm ranks, const MatrixPart& part)
  {
    const auto entries = static_cast<std::size_t>(part.matrix.nonZeros());
    std::vector<PetscInt> row;
    std::vector<PetscInt> column;
    row.reserve(entries);
    column.reserve(entries);
    for (int k = 0; k < static_cast<int>(part.matrix.outerSize()); ++k)
    {
      for (SymmetricMatrix::InnerIterator entry(part.matrix, k); entry; ++entry)
      {
        row.push_back(part.number[static_cast<std::size_t>(entry.row())]);
        column.push_back(part.number[static_cast<std::size_t>(entry.col())]);
      }
    }
    MatCreate(ranks, &matrix_);
    MatSetSizes(matrix_, part.own, part.own, PETSC_DETERMINE, PETSC_DETERMINE);
    MatSetType(matrix_, MATAIJ);
    MatSetPreallocationCOO(matrix_, static_cast<PetscCount>(entries), row.data(), column.data());
    MatSetValuesCOO(matrix_, part.matrix.valuePtr(), ADD_VALUES);
    MatSetOption(matrix_, MAT_SPD, PETSC_TRUE);
  }

  Mat matrix_ = nullptr;
  KSP solver_ = nullptr;
  Vec load_ = nullptr;
  Vec solution_ = nullptr;
};

} // namespace

std::unique_ptr<DistributedAmg> MakeDistributedAmg(
  MPI_Comm ranks, const MatrixPart& part, DistributedCycle cycle)
{
  return std::make_unique<PetscAmg>(ranks, part, cycle);
}

} // namespace gridfem::benchmarks
