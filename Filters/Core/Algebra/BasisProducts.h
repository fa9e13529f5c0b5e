// Products with a basis of many long vectors: projected matrices and the removal of components.
// Rows are taken a few hundred at a time, so that what is computed of them is still in the cache
// when it is multiplied, and no image of the whole block is ever stored.
#ifndef GridFEM_BasisProducts_h
#define GridFEM_BasisProducts_h

#include "Algebra/BlockVectors.h"
#include "Algebra/SparseMatrix.h"

#include <vector>

namespace gridfem
{

/// A basis in parts that lie apart in memory.
template<class Real>
using BasisParts = std::vector<ConstBlock<Real>>;

/// [X₁ X₂ ...]ᵀ [A Y, B Y] for matrices of one pattern. Blocks in single precision are multiplied
/// in it, a few hundred rows at a time; what these give is added up in double. Throws InvalidInput
/// when shapes do not fit. Same bits for any number of threads.
template<class Real>
Eigen::MatrixXd ProjectPair(const BasisParts<Real>& parts, const SparseMatrix& A,
  const SparseMatrix& B, const ConstBlock<Real>& Y, int threads = 0);

/// [X₁ X₂ ...]ᵀ A Y, under the same conditions.
template<class Real>
Eigen::MatrixXd Project(
  const BasisParts<Real>& parts, const SparseMatrix& A, const ConstBlock<Real>& Y, int threads = 0);

/// Y -= [X₁ X₂ ...] C for a small C. Same bits for any number of threads.
template<class Real>
void SubtractCombination(
  const BasisParts<Real>& parts, const Eigen::MatrixXd& C, Block<Real> Y, int threads = 0);

} // namespace gridfem

#endif
