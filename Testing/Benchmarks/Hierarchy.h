// Multigrid of Core on prolongations from elsewhere, and histories of repeated cycles, for the
// figures of the thesis.
#ifndef GridFEM_Benchmarks_Hierarchy_h
#define GridFEM_Benchmarks_Hierarchy_h

#include "CotangentSystem.h"
#include "Multigrid/Multigrid.h"
#include "Support/Hybrid.h"

#include <functional>
#include <vector>

namespace gridfem::benchmarks
{

/// The thesis' cycle: W, ten Gauss-Seidel sweeps before and after the coarse correction. [T §4.3.2]
MultigridOptions ThesisCycle();

/// The same for hat functions above a grid.
testing::HybridCycle ThesisHybrid();

SparseMatrix FromEigen(const Eigen::SparseMatrix<double>& matrix);
SymmetricMatrix ToEigen(const SparseMatrix& matrix);

/// A on the finest level, Galerkin products on the others, Gauss-Seidel in the order of the rows.
Multigrid BuildHierarchy(const SymmetricMatrix& A,
  const std::vector<Eigen::SparseMatrix<double>>& prolongations, const MultigridOptions& options);

/// |b - A x| / |b| for each iterate, over all columns.
double RelativeResidual(
  const SymmetricMatrix& A, const Eigen::MatrixXd& b, const Eigen::MatrixXd& x);

/// Iterate k of a method; 0 is its start.
using Iterate = std::function<Eigen::MatrixXd(int)>;

/// The cycle repeated k times, for every k; from `start`, or from zero when it has no rows.
/// The multigrid must outlive the result.
Iterate Cycles(
  const Multigrid& multigrid, const Eigen::MatrixXd& b, const Eigen::MatrixXd& start = {});

/// Relative residuals of iterates 0 .. count.
std::vector<double> Residuals(
  const SymmetricMatrix& A, const Eigen::MatrixXd& b, const Iterate& iterate, int count);

} // namespace gridfem::benchmarks

#endif
