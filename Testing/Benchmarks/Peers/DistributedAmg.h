// Conjugate gradients with algebraic multigrid on several ranks, by PETSc's solvers: its own GAMG
// and hypre's BoomerAMG.
#ifndef GridFEM_Benchmarks_DistributedAmg_h
#define GridFEM_Benchmarks_DistributedAmg_h

#include "CotangentSystem.h"

#include <mpi.h>

#include <memory>

namespace gridfem::benchmarks
{

/// The contribution of a rank to a matrix of all ranks, and the rows that belong to the rank.
struct MatrixPart
{
  const SymmetricMatrix& matrix;
  const std::vector<int>& number; // per row: its number in the whole
  int own;                        // rows of the whole that this rank owns, contiguous
};

enum class DistributedCycle
{
  Gamg,
  BoomerAmg
};

/// All functions are collective. MessagePassing must be alive; MPI may be up before and after it.
class DistributedAmg
{
public:
  virtual ~DistributedAmg() = default;

  /// From zero until the energy of the preconditioned residual is `tolerance` of its start.
  /// @param load  of the rank's own rows
  /// @return the rank's own rows of the solution
  virtual Eigen::VectorXd Solve(const Eigen::VectorXd& load, double tolerance) = 0;

  virtual int Iterations() const = 0;
};

/// The matrix is put together and the hierarchy is built, with the settings of
/// AlgebraicMultigrid.h.
std::unique_ptr<DistributedAmg> MakeDistributedAmg(
  MPI_Comm ranks, const MatrixPart& part, DistributedCycle cycle);

} // namespace gridfem::benchmarks

#endif
