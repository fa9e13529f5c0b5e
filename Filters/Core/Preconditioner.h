// What a block iteration asks of a preconditioner: corrections of a few columns whose residuals are
// never stored.
#ifndef GridFEM_Preconditioner_h
#define GridFEM_Preconditioner_h

#include "BlockVectors.h"

#include <functional>

namespace gridfem
{

/// Columns that are corrected together, at most.
constexpr Id PreconditionedColumns = 32;

/// A block of vectors that is computed some rows at a time: fills the first rows of `rows` with the
/// rows begin .. end - 1. Safe to call from several threads.
using RowSource = std::function<void(Id begin, Id end, MultiVector& rows)>;

/// Rows to ask a source for at a time: they stay in the cache.
constexpr Id SourceRows = 256;

/// Σ r² of every column. Same bits for any number of threads.
Eigen::VectorXd SquaredNorms(const RowSource& r, Id rows, Id columns, int threads);

/// Per column.
struct ResidualMeasures
{
  Eigen::VectorXd energy; // rᵀBr
  Eigen::VectorXd norm;   // rᵀr
};

/// z = B r, B symmetric positive semi-definite; r has the shape of z, with at most
/// PreconditionedColumns columns. Safe to call from several threads; same bits for any number of
/// them.
using Preconditioner = std::function<ResidualMeasures(const RowSource& r, Block z)>;

} // namespace gridfem

#endif
