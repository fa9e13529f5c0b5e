#include "AlgebraicMultigrid.h"

#include <HYPRE.h>
#include <HYPRE_parcsr_ls.h>

#include <numeric>

namespace gridfem::benchmarks
{

namespace
{

class Vector
{
public:
  explicit Vector(int rows)
  {
    HYPRE_IJVectorCreate(MPI_COMM_SELF, 0, rows - 1, &vector_);
    HYPRE_IJVectorSetObjectType(vector_, HYPRE_PARCSR);
  }
  ~Vector() { HYPRE_IJVectorDestroy(vector_); }
  Vector(const Vector&) = delete;
  Vector& operator=(const Vector&) = delete;

  void Set(const Eigen::VectorXd& values)
  {
    HYPRE_IJVectorInitialize(vector_);
    HYPRE_IJVectorSetValues(vector_, static_cast<HYPRE_Int>(values.size()), nullptr, values.data());
    HYPRE_IJVectorAssemble(vector_);
  }
  void Get(Eigen::VectorXd& values) const
  {
    HYPRE_IJVectorGetValues(vector_, static_cast<HYPRE_Int>(values.size()), nullptr, values.data());
  }
  HYPRE_ParVector Object() const
  {
    void* object = nullptr;
    HYPRE_IJVectorGetObject(vector_, &object);
    return static_cast<HYPRE_ParVector>(object);
  }

private:
  HYPRE_IJVector vector_ = nullptr;
};

class BoomerAmg : public AlgebraicMultigrid
{
public:
  BoomerAmg(const SymmetricMatrix& A, AmgUse use)
    : use_(use), rows_(static_cast<int>(A.rows())), b_(rows_), x_(rows_)
  {
    HYPRE_IJMatrixCreate(MPI_COMM_SELF, 0, rows_ - 1, 0, rows_ - 1, &matrix_);
    HYPRE_IJMatrixSetObjectType(matrix_, HYPRE_PARCSR);
    HYPRE_IJMatrixInitialize(matrix_);
    std::vector<HYPRE_BigInt> row(rows_);
    std::iota(row.begin(), row.end(), 0);
    std::vector<HYPRE_Int> count(rows_);
    for (int r = 0; r < rows_; ++r)
    {
      count[r] = A.outerIndexPtr()[r + 1] - A.outerIndexPtr()[r];
    }
    HYPRE_IJMatrixSetValues(
      matrix_, rows_, count.data(), row.data(), A.innerIndexPtr(), A.valuePtr());
    HYPRE_IJMatrixAssemble(matrix_);
    b_.Set(Eigen::VectorXd::Zero(rows_));
    x_.Set(Eigen::VectorXd::Zero(rows_));
  }

  ~BoomerAmg() override
  {
    this->DestroySolvers();
    HYPRE_IJMatrixDestroy(matrix_);
  }

  void Setup() override
  {
    this->DestroySolvers();
    HYPRE_BoomerAMGCreate(&cycle_);
    HYPRE_BoomerAMGSetCoarsenType(cycle_, 10); // HMIS
    HYPRE_BoomerAMGSetInterpType(cycle_, 6);   // extended+i
    HYPRE_BoomerAMGSetPMaxElmts(cycle_, 4);
    HYPRE_BoomerAMGSetStrongThreshold(cycle_, 0.25);
    HYPRE_BoomerAMGSetAggNumLevels(cycle_, 0);
    HYPRE_BoomerAMGSetTol(cycle_, 0.0);
    if (use_ == AmgUse::ThesisCycle)
    {
      HYPRE_BoomerAMGSetCycleType(cycle_, 2); // W
      HYPRE_BoomerAMGSetMaxCoarseSize(cycle_, 99);
      HYPRE_BoomerAMGSetRelaxType(cycle_, 3); // Gauss-Seidel
      HYPRE_BoomerAMGSetNumSweeps(cycle_, 10);
      HYPRE_BoomerAMGSetCycleRelaxType(cycle_, 9, 3); // a direct solve on the coarsest level
      HYPRE_BoomerAMGSetup(cycle_, this->Matrix(), b_.Object(), x_.Object());
      return;
    }
    HYPRE_BoomerAMGSetRelaxType(cycle_, 6); // symmetric Gauss-Seidel
    HYPRE_BoomerAMGSetNumSweeps(cycle_, 1);
    HYPRE_BoomerAMGSetMaxIter(cycle_, 1);
    HYPRE_ParCSRPCGCreate(MPI_COMM_SELF, &solver_);
    HYPRE_PCGSetTwoNorm(solver_, 1);
    HYPRE_PCGSetPrecond(solver_, reinterpret_cast<HYPRE_PtrToSolverFcn>(HYPRE_BoomerAMGSolve),
      reinterpret_cast<HYPRE_PtrToSolverFcn>(HYPRE_BoomerAMGSetup), cycle_);
    HYPRE_ParCSRPCGSetup(solver_, this->Matrix(), b_.Object(), x_.Object());
  }

  int Solve(const Eigen::VectorXd& b, Eigen::VectorXd& x, double tolerance, int iterations) override
  {
    b_.Set(b);
    x_.Set(Eigen::VectorXd::Zero(rows_));
    x.resize(rows_);
    if (use_ == AmgUse::ThesisCycle)
    {
      HYPRE_BoomerAMGSetMaxIter(cycle_, iterations);
      HYPRE_BoomerAMGSolve(cycle_, this->Matrix(), b_.Object(), x_.Object());
      HYPRE_ClearAllErrors();
      x_.Get(x);
      return iterations;
    }
    HYPRE_PCGSetTol(solver_, tolerance);
    HYPRE_PCGSetMaxIter(solver_, iterations);
    HYPRE_ParCSRPCGSolve(solver_, this->Matrix(), b_.Object(), x_.Object());
    HYPRE_ClearAllErrors(); // stopping at the limit counts as an error there
    x_.Get(x);
    HYPRE_Int count = 0;
    HYPRE_PCGGetNumIterations(solver_, &count);
    return count;
  }

private:
  void DestroySolvers()
  {
    if (solver_ != nullptr)
    {
      HYPRE_ParCSRPCGDestroy(solver_);
      solver_ = nullptr;
    }
    if (cycle_ != nullptr)
    {
      HYPRE_BoomerAMGDestroy(cycle_);
      cycle_ = nullptr;
    }
  }
  HYPRE_ParCSRMatrix Matrix() const
  {
    void* object = nullptr;
    HYPRE_IJMatrixGetObject(matrix_, &object);
    return static_cast<HYPRE_ParCSRMatrix>(object);
  }

  AmgUse use_;
  int rows_;
  Vector b_;
  Vector x_;
  HYPRE_IJMatrix matrix_ = nullptr;
  HYPRE_Solver cycle_ = nullptr;
  HYPRE_Solver solver_ = nullptr;
};

} // namespace

std::unique_ptr<AlgebraicMultigrid> MakeBoomerAmg(const SymmetricMatrix& A, AmgUse use)
{
  return std::make_unique<BoomerAmg>(A, use);
}

} // namespace gridfem::benchmarks
