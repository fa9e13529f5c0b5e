// Matrices of a level over all ranks, as PETSc holds them, and vectors of its functions.
#ifndef GridFEM_RankMatrices_h
#define GridFEM_RankMatrices_h

#include "Algebra/SparseMatrix.h"
#include "Parallel/LevelNumbering.h"
#include "Parallel/PetscSession.h"

#include <vector>

namespace gridfem
{

/// Collective. The sum over the ranks of what the patches of each add to it: rows belong to the
/// owners of their functions.
/// @param own  rows and columns = functions of the numbering
PetscMatrix SumOverRanks(
  const Communicator& ranks, const LevelNumbering& numbering, const SparseMatrix& own);

/// Collective. A prolongation whose rows the owners of the functions know.
/// @param own           rows = functions of the numbering, of which the foreign ones do not count
/// @param columnNumber  per column of `own` its number over all ranks; empty: that is the column
/// @param ownColumns    columns that belong to this rank
PetscMatrix RowsOfOwners(const Communicator& ranks, const LevelNumbering& numbering,
  const SparseMatrix& own, const std::vector<Id>& columnNumber, Id ownColumns);

/// Some rows of a matrix.
SparseMatrix SomeRows(const SparseMatrix& matrix, const std::vector<Index>& rows);

/// Collective. The rows and columns of all functions of the numbering, which lack nothing.
/// @param matrix  over all ranks
/// @param shared  functions that other ranks touch, too, ascending
/// @param own     what this rank's patches add: all that there is but for rows of shared functions
SparseMatrix WholeRows(const Communicator& ranks, Mat matrix, const LevelNumbering& numbering,
  const std::vector<Index>& shared, const SparseMatrix& own);

/// The way between a vector over all ranks, of which each has the entries of its own functions, and
/// the entries of all functions that touch a rank's cells, or of some of them.
class LevelVectors
{
public:
  /// Collective.
  LevelVectors(const Communicator& ranks, const LevelNumbering& numbering);
  LevelVectors(const Communicator& ranks, const LevelNumbering& numbering,
    const std::vector<Index>& functions);

  /// Collective. A new vector over all ranks.
  PetscVector Make() const;

  /// Collective. Entries of these functions.
  void Spread(Vec vector, std::vector<double>& entries) const;

  /// Collective. The way back: adds up what the ranks have, or takes the least of it.
  void Add(const std::vector<double>& entries, Vec sum) const;
  void TakeLeast(const std::vector<double>& entries, Vec least) const;

private:
  LevelVectors(const Communicator& ranks, Id own, const std::vector<PetscInt>& numbers);
  void Collect(const std::vector<double>& entries, InsertMode mode, Vec vector) const;

  MPI_Comm comm_;
  Id own_;
  Id count_;         // of the functions
  PetscVector room_; // of this process alone
  PetscScatter spread_;
};

} // namespace gridfem

#endif
