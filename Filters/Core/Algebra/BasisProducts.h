// Products with a basis of many long vectors: projects matrices onto it and removes its components.
// Rows are processed a few hundred at a time. Their images are then still in the cache when they
// are multiplied, and no image of the whole block is ever stored.
#ifndef GridFEM_BasisProducts_h
#define GridFEM_BasisProducts_h

#include "Algebra/BlockVectors.h"
#include "Algebra/SparseMatrix.h"

#include <vector>

namespace gridfem
{

/// A basis made of several blocks, which may lie anywhere in memory.
template<class Real>
using BasisParts = std::vector<ConstBlock<Real>>;

/// Returns [X₁ X₂ ...]ᵀ [A Y, B Y] for two matrices with the same pattern. Blocks in single
/// precision are multiplied in single precision, a few hundred rows at a time; the partial results
/// are added in double precision. Throws InvalidInput when shapes do not fit. Same bits for any
/// number of threads.
template<class Real>
Eigen::MatrixXd ProjectPair(const BasisParts<Real>& parts, const SparseMatrix& A,
  const SparseMatrix& B, const ConstBlock<Real>& Y, int threads = 0);

/// Returns [X₁ X₂ ...]ᵀ A Y, under the same conditions.
template<class Real>
Eigen::MatrixXd Project(
  const BasisParts<Real>& parts, const SparseMatrix& A, const ConstBlock<Real>& Y, int threads = 0);

/// Computes Y -= [X₁ X₂ ...] C for a small matrix C. Same bits for any number of threads.
template<class Real>
void SubtractCombination(
  const BasisParts<Real>& parts, const Eigen::MatrixXd& C, Block<Real> Y, int threads = 0);

} // namespace gridfem

#endif
