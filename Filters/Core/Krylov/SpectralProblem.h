// The eigenproblem of one level, L x = θ M x, and pairs that solve it. What the block iteration,
// the dense solve and the collection of results share.
// Where several processes hold the rows of the vectors together, matrices are the parts that this
// one adds.
#ifndef GridFEM_SpectralProblem_h
#define GridFEM_SpectralProblem_h

#include "Algebra/BasisProducts.h"
#include "Algebra/Constants.h"
#include "Algebra/SparseMatrix.h"
#include "Krylov/SoftLocking.h"
#include "Krylov/WithFallback.h"
#include "Multigrid/BlockPreconditioner.h"

namespace gridfem
{

template<class Real>
struct EigenPairs
{
  Eigen::VectorXd values;    // ascending
  BlockBuffer<Real> vectors; // columns orthonormal in the mass matrix, up to rounding of Real
  /// By Rayleigh-Ritz on these vectors or on those they are prolonged from: XᵀLX = diag(values) and
  /// XᵀMX = 1 up to rounding of Real, not up to that of many steps.
  bool isRenewed = false;
};

/// Per column x of a block.
struct ColumnFacts
{
  Eigen::RowVectorXd energy;  // xᵀLx
  Eigen::RowVectorXd mass;    // xᵀMx
  Eigen::RowVectorXd largest; // the entry of M x of largest magnitude, near ties to the lowest row

  explicit ColumnFacts(Id columns)
    : energy(Eigen::RowVectorXd::Zero(columns)), mass(energy), largest(energy)
  {
  }

  /// @param row  entries of M x in rows behind those before
  template<class Row>
  void TakeLargest(const Row& row)
  {
    // Symmetric surfaces have many entries that are equal up to rounding.
    constexpr double NearTie = 1e-6;
    largest = (row.array().abs() > (1.0 + NearTie) * largest.array().abs()).select(row, largest);
  }
};

/// One level's eigenproblem, for blocks of vectors of one precision. Where processes hold it
/// together, all of them call every function but Rows, in the same order.
template<class Real>
struct SpectralProblem
{
  /// Of the vectors, in this process.
  Id Rows() const { return mass.rows; }

  /// M X, in double precision; of a divided problem the part.
  MultiVector MassTimes(const MultiVector& X) const;

  /// [X₁ X₂ ...]ᵀ [L Y, M Y] over all rows.
  Eigen::MatrixXd ProjectBoth(const BasisParts<Real>& parts, const ConstBlock<Real>& Y) const;

  /// [X₁ X₂ ...]ᵀ M Y over all rows.
  Eigen::MatrixXd ProjectMass(const BasisParts<Real>& parts, const ConstBlock<Real>& Y) const;

  /// W = B (L X - M X diag(θ)), where X are the columns at work. Panels in which all columns have
  /// converged are left out. Further loads F share the cycles, P = B F: a cycle takes as long for a
  /// few columns as for a panel. Measures are those of the columns at work, as many as W has.
  /// @param load  F; as many columns as P has
  ResidualMeasures Correct(const BlockPreconditioner<Real>& B, const EigenPairs<Real>& pairs,
    const SoftLocking& locking, Block<Real> W, const MultiVector& load, Block<Real> P) const;

  /// What X has, column by column, in double precision.
  ColumnFacts FactsOf(const MultiVector& X) const;

  /// rᵀr of these columns. A cycle for each would cost far more.
  Eigen::VectorXd SquaredResiduals(
    const EigenPairs<Real>& pairs, const std::vector<Index>& columns) const;

  /// Gives rows that several processes hold the same bits in all of them: products of dense
  /// matrices may round them differently.
  void Agree(Block<Real> X) const;

  SparseMatrix stiffness;
  SparseMatrix mass;
  double shift = 1.0;
  /// Approximate inverse, symmetric positive semi-definite, of stiffness + shift mass.
  WithFallback<BlockPreconditioner<Real>> preconditioner;
  const Constants* constants = nullptr; // the pairs found are orthogonal to them
  const DividedRows* divided = nullptr; // null: this process holds all rows
  int threads = 0;
};

} // namespace gridfem

#endif
