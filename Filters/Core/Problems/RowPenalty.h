// A penalty on what functions are at places of the surface, on all levels of a hierarchy.
#ifndef GridFEM_RowPenalty_h
#define GridFEM_RowPenalty_h

#include "Spaces/SpaceLevels.h"

#include <vector>

namespace gridfem
{

/// Cᵀ W C: each row of C holds the values of all functions at a place, W one weight for each. A
/// place adds a term of rank one on the functions of one patch, which the patch smoother inverts;
/// on coarser levels C has the rows C P. Where processes hold the functions together, each has rows
/// of its own, of functions that it has: what they add is its part.
class RowPenalty
{
public:
  RowPenalty() = default;

  /// @param rows  a place without functions has an empty one
  /// Throws InvalidInput when the rows are not of this space.
  RowPenalty(const SpaceLevels& space, SparseMatrix rows, std::vector<double> weight, int threads);

  /// C, and W of each row.
  const SparseMatrix& Rows() const { return levels_.front().rows; }

  /// W r for values at the places.
  MultiVector Weighted(const MultiVector& values) const;

  /// A += Cᵀ W C. What the pattern has no place for goes to the diagonal, so that the sum stays
  /// positive: that happens only below hats, on a level that preconditions.
  void AddTo(std::size_t level, SparseMatrix& A, int threads) const;

  /// Cᵀ W r for values at the places: rows = functions.
  MultiVector LoadOf(const MultiVector& values, int threads) const;

private:
  struct Level
  {
    SparseMatrix rows;
    SparseMatrix transposed;
  };

  std::vector<Level> levels_; // finest first
  std::vector<double> weight_;
};

} // namespace gridfem

#endif
