// Products with a basis of many long vectors: projected matrices and the removal of components.
// Rows are taken a few hundred at a time, so that what is computed of them is still in the cache
// when it is multiplied, and no image of the whole block is ever stored.
#ifndef GridFEM_BasisProducts_h
#define GridFEM_BasisProducts_h

#include "BlockVectors.h"
#include "SparseMatrix.h"

#include <vector>

namespace gridfem
{

/// A basis in parts that lie apart in memory.
using BasisParts = std::vector<ConstBlock>;

/// [X₁ X₂ ...]ᵀ [A Y, B Y] for matrices of one pattern. Throws InvalidInput when shapes do not fit.
/// Same bits for any number of threads.
Eigen::MatrixXd ProjectPair(const BasisParts& parts, const SparseMatrix& A, const SparseMatrix& B,
  const ConstBlock& Y, int threads = 0);

/// [X₁ X₂ ...]ᵀ A Y, under the same conditions.
Eigen::MatrixXd Project(
  const BasisParts& parts, const SparseMatrix& A, const ConstBlock& Y, int threads = 0);

/// Y -= [X₁ X₂ ...] C for a small C. Same bits for any number of threads.
void SubtractCombination(
  const BasisParts& parts, const Eigen::MatrixXd& C, Block Y, int threads = 0);

} // namespace gridfem

#endif
