// A penalty on the values of functions at places of the surface, on all levels of a hierarchy.
#ifndef GridFEM_RowPenalty_h
#define GridFEM_RowPenalty_h

#include "Spaces/SpaceLevels.h"

#include <vector>

namespace gridfem
{

/// Places at which a function is held: the rows of C.
struct HeldRows : SparseMatrix
{
  HeldRows() = default;
  HeldRows(SparseMatrix rowsOfPlaces, std::vector<double> pullOfRows = {})
    : SparseMatrix(std::move(rowsOfPlaces)), pull(std::move(pullOfRows))
  {
  }

  bool IsPulled(Index row) const { return !pull.empty() && pull[row] > 0.0; }

  /// A row with a pull above 0 is not held exactly. The square of its misfit counts with this
  /// weight, in units of a + b for the matrix a M + b L. Empty: all rows are held.
  std::vector<double> pull;
};

/// The matrix Cᵀ W C. Each row of C holds the values of all functions at one place, and W has one
/// weight per place. A place adds a rank-one term on the functions of one patch, which the patch
/// smoother inverts. On coarser levels C has the rows C P. If several processes hold the functions,
/// each has rows of its own, on its own functions; together they add up to the whole.
class RowPenalty
{
public:
  RowPenalty() = default;

  /// @param rows  a place without functions has an empty row
  /// Throws InvalidInput when the rows are not of this space.
  RowPenalty(const SpaceLevels& space, SparseMatrix rows, std::vector<double> weight, int threads);

  /// C on a level.
  const SparseMatrix& Rows(std::size_t level = 0) const { return levels_[level].rows; }

  /// W r for values r at the places.
  MultiVector Weighted(const MultiVector& values) const;

  /// A += factor Cᵀ W C. Terms without a place in the pattern go to the diagonal, so that the sum
  /// stays positive. That happens only below hats, on a level that preconditions.
  void AddTo(std::size_t level, double factor, SparseMatrix& A, int threads) const;

  /// AddTo for a level that every process holds completely, although each process has only its own
  /// rows. Collective.
  void AddSumTo(std::size_t level, double factor, const DistributedRows& distributed,
    SparseMatrix& A, int threads) const;

  /// Cᵀ W r for values r at the places: rows = functions.
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
