// Conjugate gradients with algebraic multigrid, by the libraries most use: hypre's BoomerAMG
// (classical, after Ruge and Stüben) and PETSc's GAMG (smoothed aggregation). One process, one
// thread.
#ifndef GridFEM_Benchmarks_AlgebraicMultigrid_h
#define GridFEM_Benchmarks_AlgebraicMultigrid_h

#include "CotangentSystem.h"

#include <memory>
#include <string>
#include <vector>

namespace gridfem::benchmarks
{

/// MPI and the libraries are up while this lives. Once per process.
class MessagePassing
{
public:
  MessagePassing();
  ~MessagePassing();
  MessagePassing(const MessagePassing&) = delete;
  MessagePassing& operator=(const MessagePassing&) = delete;
};

enum class AmgUse
{
  Preconditioner, // of conjugate gradients, with the settings each library recommends
  ThesisCycle     // alone: W-cycles, ten Gauss-Seidel sweeps before and after [T §4.3.2]
};

class AlgebraicMultigrid
{
public:
  virtual ~AlgebraicMultigrid() = default;

  /// The hierarchy. The matrix was handed over at construction and is not copied here.
  virtual void Setup() = 0;

  /// From zero, steps of conjugate gradients or cycles, until |r| is `tolerance` of its start or
  /// after `iterations`; 0 for the tolerance: as many as allowed.
  /// @return the number of iterations; of cycles always as many as allowed
  virtual int Solve(
    const Eigen::VectorXd& b, Eigen::VectorXd& x, double tolerance, int iterations) = 0;
};

/// HMIS coarsening, extended+i interpolation of at most four entries, strong threshold 0.25,
/// symmetric Gauss-Seidel, V-cycle.
std::unique_ptr<AlgebraicMultigrid> MakeBoomerAmg(
  const SymmetricMatrix& A, AmgUse use = AmgUse::Preconditioner);

/// The library's defaults for symmetric positive definite matrices: one smoothing of the
/// aggregates, Chebyshev smoothers of degree two, V-cycle.
std::unique_ptr<AlgebraicMultigrid> MakeGamg(
  const SymmetricMatrix& A, AmgUse use = AmgUse::Preconditioner);

} // namespace gridfem::benchmarks

#endif
