// The constant functions of the connected components on one level: the zero modes of the Laplacian,
// known exactly, so that no iteration has to find them.
#ifndef GridFEM_Constants_h
#define GridFEM_Constants_h

#include "Algebra/DividedRows.h"
#include "Algebra/SparseMatrix.h"

#include <vector>

namespace gridfem
{

/// The null space of the stiffness matrix, known exactly: the constants of every component.
class Constants
{
public:
  /// @param mass       where processes hold the functions together, what this one adds to it
  /// @param component  per function, 0 .. numberOfComponents - 1
  /// @param divided    null: this process holds all functions; else has to outlive this, and all
  ///                   processes call the constructor and Remove
  Constants(const SparseMatrix& mass, std::vector<Index> component, Index numberOfComponents,
    int threads, const DividedRows* divided = nullptr);

  /// Removes the constants from every column, in the inner product of the mass matrix; components
  /// without mass, as pieces without an area are, become zero.
  template<class Real>
  void Remove(Block<Real> X) const;

  /// Takes the constants out of a dense mass matrix of the same size, M - M Z Zᵀ M, and components
  /// without mass.
  void Deflate(Eigen::MatrixXd& mass) const;

  /// The first `count` constants, of mass norm 1: one component each, in order of their numbers.
  MultiVector Vectors(Index count) const;

  /// Components without mass do not count.
  Index Count() const { return static_cast<Index>(massive_.size()); }

private:
  /// Mean of every column on every component.
  template<class Real>
  MultiVector Means(const ConstBlock<Real>& X) const;

  std::vector<Index> component_;
  std::vector<double> weight_; // ∫ b_i, or what this process adds to it
  std::vector<double> mass_;   // per component; 0 when negligible
  std::vector<Index> massive_; // components with mass
  int threads_;
  const DividedRows* divided_;
};

} // namespace gridfem

#endif
