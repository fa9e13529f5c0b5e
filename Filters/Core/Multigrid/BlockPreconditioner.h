// The preconditioner of a block iteration: corrections of a few columns at a time, whose residuals
// are never stored.
#ifndef GridFEM_BlockPreconditioner_h
#define GridFEM_BlockPreconditioner_h

#include "Algebra/BlockVectors.h"
#include "Algebra/ColumnAlgebra.h"

#include <functional>

namespace gridfem
{

/// Largest number of rows that are requested or handed over at a time. They stay in the cache.
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

/// Loads all rows into a block of to.cols() columns. Columns beyond the columns of r become zero.
/// @param norm  if not null: rᵀr
template<class Given, class Real>
void LoadRows(const RowSource<Given>& r, Vectors<Real>& to, Columns* norm, int threads);

/// Hands over the first columns of a block.
template<class Given, class Real>
void StoreRows(const Vectors<Real>& from, Id columns, const RowSink<Given>& z, int threads);

/// Σ r² of every column. Same bits for any number of threads.
template<class Real>
Eigen::VectorXd SquaredNorms(const RowSource<Real>& r, int threads);

/// Measures of every column.
struct ResidualMeasures
{
  Eigen::VectorXd energy; // rᵀBr
  Eigen::VectorXd norm;   // rᵀr
};

/// Says whether corrections are wanted. The thread that corrects r calls it, once for every r, when
/// the measures of all columns are known. Half of the work may be done by then.
using CorrectionTest = std::function<bool(const ResidualMeasures&)>;

/// Hands over z = B r where it is wanted. B is symmetric positive semi-definite, and r has at most
/// WidestPanel columns. Safe to call from several threads; same bits for any number of them.
/// Collective, called by one thread of each process: r is this process's part of the sum over all
/// processes, and the measures describe the sum.
template<class Real>
using BlockPreconditioner = std::function<ResidualMeasures(
  const RowSource<Real>& r, const CorrectionTest& isWanted, const RowSink<Real>& z)>;

} // namespace gridfem

#endif
