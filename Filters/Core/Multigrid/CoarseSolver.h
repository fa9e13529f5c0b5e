// Direct solve of the coarsest system, which may be singular.
#ifndef GridFEM_CoarseSolver_h
#define GridFEM_CoarseSolver_h

#include "Algebra/SparseMatrix.h"
#include "Base/Grouping.h"

#include <vector>

namespace gridfem
{

/// The unknowns of each connected component of a matrix graph.
Groups ComponentsOf(const SparseMatrix& A);

/// Dense factors of a symmetric positive semi-definite matrix, one per connected component of its
/// graph. Thousands of components therefore cost no more than one. It leaves out dependent
/// directions (small pivots of the scaled matrix) and unknowns without a positive number on the
/// diagonal. Cost: n³ / 3 multiplications and 8 n² bytes for a component of n unknowns.
class CoarseSolver
{
public:
  CoarseSolver() = default;

  /// Throws InvalidInput when A is not square.
  explicit CoarseSolver(const SparseMatrix& A, int threads = 1, double smallestPivot = 1e-12);

  /// Computes x = B b, with B symmetric, positive semi-definite and A B A = A. It solves A x = b
  /// wherever b is consistent. Unknowns that were left out get 0. Any number of columns; x must not
  /// be b.
  void Solve(const MultiVector& b, MultiVector& x, int threads = 1) const;

  /// B as a matrix. It has a full block for every component.
  SparseMatrix Inverse() const;

  std::size_t Memory() const;

private:
  /// S A S restricted to `unknown` is L Lᵀ, with S = diag(scale).
  struct Component
  {
    std::vector<Index> unknown; // the kept unknowns, in the order of the pivots
    Eigen::VectorXd scale;
    Eigen::MatrixXd L; // lower triangle
  };

  static Component Factor(
    const SparseMatrix& A, const Index* begin, const Index* end, double smallestPivot);
  static void SolveComponent(const Component& component, const MultiVector& b, MultiVector& x);

  Id rows_ = 0;
  std::vector<Component> components_;
};

} // namespace gridfem

#endif
