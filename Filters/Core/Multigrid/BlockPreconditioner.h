// What a block iteration asks of a preconditioner: corrections of a few columns, whose residuals
// are never stored.
#ifndef GridFEM_BlockPreconditioner_h
#define GridFEM_BlockPreconditioner_h

#include "Algebra/BlockVectors.h"
#include "Algebra/ColumnAlgebra.h"

#include <functional>

namespace gridfem
{

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

/// Says whether corrections are wanted. Called once for every r, when the measures of all of its
/// columns are known; half of the work may be done by then. The thread that corrects r calls it.
using CorrectionTest = std::function<bool(const ResidualMeasures&)>;

/// Hands over z = B r where it is wanted. B is symmetric positive semi-definite; r has at most
/// WidestPanel columns. Safe to call from several threads; same bits for any number of
/// them. If several processes hold the rows together, r is what this one adds to the whole, the
/// measures are those of the whole, and one thread of each process calls it.
template<class Real>
using BlockPreconditioner = std::function<ResidualMeasures(
  const RowSource<Real>& r, const CorrectionTest& isWanted, const RowSink<Real>& z)>;

} // namespace gridfem

#endif
