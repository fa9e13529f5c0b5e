// What a block iteration asks of a preconditioner: corrections of a few columns, whose residuals
// are never stored.
#ifndef GridFEM_BlockPreconditioner_h
#define GridFEM_BlockPreconditioner_h

#include "Algebra/BlockVectors.h"
#include "Algebra/ColumnAlgebra.h"

#include <functional>

namespace gridfem
{

/// Columns that are corrected together, at most.
constexpr Id PreconditionedColumns = WideChunk;

/// Rows that are asked for or handed over at a time, at most: they stay in the cache.
constexpr Id SourceRows = 256;

/// A block of vectors that is computed some rows at a time.
template<class Real>
struct RowSource
{
  Id rows = 0;
  Id columns = 0;
  /// Fills `part` with the rows begin .. end - 1. Safe to call from several threads.
  std::function<void(Id begin, Id end, Block<Real> part)> fill;
};

/// Takes the rows begin .. end - 1 of a block. Safe to call from several threads.
template<class Real>
using RowSink = std::function<void(Id begin, Id end, const ConstBlock<Real>& part)>;

/// The rows as a block of to.cols() columns, of which those behind r's are zero.
/// @param norm  if not null: rᵀr
template<class Given, class Real>
void LoadRows(const RowSource<Given>& r, Vectors<Real>& to, Columns* norm, int threads);

/// Hands over the first columns of a block.
template<class Given, class Real>
void HandOver(const Vectors<Real>& from, Id columns, const RowSink<Given>& z, int threads);

/// Σ r² of every column. Same bits for any number of threads.
template<class Real>
Eigen::VectorXd SquaredNorms(const RowSource<Real>& r, int threads);

/// Per column.
struct ResidualMeasures
{
  Eigen::VectorXd energy; // rᵀBr
  Eigen::VectorXd norm;   // rᵀr
};

/// Whether corrections are wanted, once the measures of all columns of r are known, which may be
/// after half of the work. Called once for every r, by the thread that corrects it.
using CorrectionTest = std::function<bool(const ResidualMeasures&)>;

/// Hands over z = B r where it is wanted, B symmetric positive semi-definite; r has at most
/// PreconditionedColumns columns. Safe to call from several threads; same bits for any number of
/// them. Where processes hold the rows together, r is what each adds to it, measures are of the
/// whole, and one thread of each calls it.
template<class Real>
using BlockPreconditioner = std::function<ResidualMeasures(
  const RowSource<Real>& r, const CorrectionTest& isWanted, const RowSink<Real>& z)>;

} // namespace gridfem

#endif
