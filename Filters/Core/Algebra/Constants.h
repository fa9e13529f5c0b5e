// The constant functions of the connected components on one level. They are the zero modes of the
// Laplacian and known exactly, so no iteration has to find them.
#ifndef GridFEM_Constants_h
#define GridFEM_Constants_h

#include "Algebra/DistributedRows.h"
#include "Algebra/SparseMatrix.h"

#include <vector>

namespace gridfem
{

/// The null space of the stiffness matrix: one constant function per component, unless it is held.
class Constants
{
public:
  /// @param mass       this process's part of the mass matrix, if several processes hold the
  ///   functions
  /// @param component  the component of each function, 0 .. numberOfComponents - 1
  /// @param isHeld     per component: it has no constant, because something holds its functions;
  ///   empty: none
  /// @param distributed    null: this process holds all functions. Otherwise it must outlive this
  ///   object, and the constructor and Remove are collective
  Constants(const SparseMatrix& mass, std::vector<Index> component, Index numberOfComponents,
    int threads, const DistributedRows* distributed = nullptr, std::vector<char> isHeld = {});

  /// Removes the constants from every column, in the inner product of the mass matrix. Components
  /// without mass become zero, for example pieces without area.
  template<class Real>
  void Remove(Block<Real> X) const;

  /// Removes the constants from a dense mass matrix of the same size: M - M Z Zᵀ M. Rows and
  /// columns of components without mass become zero.
  void Deflate(Eigen::MatrixXd& mass) const;

  /// Returns the first `count` constants with mass norm 1, one component each, in the order of the
  /// components' numbers.
  MultiVector Vectors(Index count) const;

  /// Number of constants. Components without mass and held ones do not count.
  Index Count() const { return static_cast<Index>(massive_.size()); }

private:
  /// Returns the mean of every column on every component, or 0 if the component has no constant.
  template<class Real>
  MultiVector Means(const ConstBlock<Real>& X) const;

  bool IsHeld(Index component) const { return !isHeld_.empty() && isHeld_[component] != 0; }

  std::vector<Index> component_;
  std::vector<double> weight_; // ∫ b_i, or the part of this process
  std::vector<double> mass_;   // per component; 0 if negligible
  std::vector<Index> massive_; // components with mass that have a constant
  std::vector<char> isHeld_;   // per component
  int threads_;
  const DistributedRows* distributed_;
};

} // namespace gridfem

#endif
