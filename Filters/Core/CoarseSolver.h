// Direct solve of the coarsest system, which may be singular.
#ifndef GridFEM_CoarseSolver_h
#define GridFEM_CoarseSolver_h

#include "SparseMatrix.h"

namespace gridfem
{

/// Dense factors of a symmetric positive semi-definite matrix, one per connected component of its
/// graph, so that thousands of components cost no more than one. Dependent directions (pivots below
/// 1e-12 of the scaled diagonal) are left out.
class CoarseSolver
{
public:
  CoarseSolver() = default;
  explicit CoarseSolver(const SparseMatrix& A);

  /// x = A⁺ b for a consistent b.
  void Solve(const MultiVector& b, MultiVector& x) const;

  std::size_t Memory() const;

private:
  std::vector<std::vector<Index>> unknowns_; // of each component
  std::vector<Eigen::MatrixXd> inverse_;     // generalised, of each component
};

} // namespace gridfem

#endif
