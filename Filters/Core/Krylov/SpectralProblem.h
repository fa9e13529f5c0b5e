// The eigenproblem of one level, L x = θ M x, and pairs that solve it. The block iteration, the
// dense solve and the collection of results share it. If several processes hold the rows of the
// vectors, each has only its own part of the sums in the matrices.
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
  /// True if XᵀLX = diag(values) and XᵀMX = 1 up to rounding of Real, without the rounding of many
  /// steps. A Rayleigh-Ritz on these vectors, or on the vectors they are prolonged from, ensures
  /// it.
  bool isRenewed = false;
};

/// Facts about every column x of a block.
struct ColumnFacts
{
  Eigen::RowVectorXd energy;  // xᵀLx
  Eigen::RowVectorXd mass;    // xᵀMx
  Eigen::RowVectorXd largest; // largest entry of M x in magnitude; near ties to the lowest row

  explicit ColumnFacts(Id columns)
    : energy(Eigen::RowVectorXd::Zero(columns)), mass(energy), largest(energy)
  {
  }

  /// Updates `largest`.
  /// @param row  the entries of M x in a row behind all rows before
  template<class Row>
  void TakeLargest(const Row& row)
  {
    // Symmetric surfaces have many entries that are equal up to rounding.
    constexpr double NearTie = 1e-6;
    largest = (row.array().abs() > (1.0 + NearTie) * largest.array().abs()).select(row, largest);
  }
};

/// The eigenproblem of one level, for blocks of vectors in one precision. Every function but Rows
/// is collective.
template<class Real>
struct SpectralProblem
{
  /// Rows of the vectors in this process.
  Id Rows() const { return mass.rows; }

  /// M X, in double precision. A distributed problem returns the part of this process.
  MultiVector MassTimes(const MultiVector& X) const;

  /// [X₁ X₂ ...]ᵀ [L Y, M Y] over all rows.
  Eigen::MatrixXd ProjectBoth(const BasisParts<Real>& parts, const ConstBlock<Real>& Y) const;

  /// [X₁ X₂ ...]ᵀ M Y over all rows.
  Eigen::MatrixXd ProjectMass(const BasisParts<Real>& parts, const ConstBlock<Real>& Y) const;

  /// W = B (L X - M X diag(θ)), where X are the columns at work. Panels in which all columns have
  /// converged are left out. Further loads F share the cycles, P = B F, because a cycle takes as
  /// long for a few columns as for a panel.
  /// @param load  F; as many columns as P has
  /// @return      measures of the columns at work, as many as W has
  ResidualMeasures Correct(const BlockPreconditioner<Real>& B, const EigenPairs<Real>& pairs,
    const SoftLocking& locking, Block<Real> W, const MultiVector& load, Block<Real> P) const;

  /// The facts about X, column by column, in double precision.
  ColumnFacts FactsOf(const MultiVector& X) const;

  /// rᵀr of these columns. It costs far less than a cycle for each column.
  Eigen::VectorXd SquaredResiduals(
    const EigenPairs<Real>& pairs, const std::vector<Index>& columns) const;

  /// Gives shared rows the same bits in all processes. Products of dense matrices may round them
  /// differently.
  void Agree(Block<Real> X) const;

  SparseMatrix stiffness;
  SparseMatrix mass;
  double shift = 1.0;
  /// Approximate inverse, symmetric positive semi-definite, of stiffness + shift mass.
  WithFallback<BlockPreconditioner<Real>> preconditioner;
  const Constants* constants = nullptr;         // the pairs found are orthogonal to them
  const DistributedRows* distributed = nullptr; // null: this process holds all rows
  int threads = 0;
};

} // namespace gridfem

#endif
