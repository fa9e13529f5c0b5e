// One level of a multigrid hierarchy: its matrix, the way to the next coarser level, its smoother,
// and the steps of a cycle on it.
#ifndef GridFEM_MultigridLevel_h
#define GridFEM_MultigridLevel_h

#include "Algebra/ColumnAlgebra.h"
#include "Multigrid/DistributedLevel.h"
#include "Multigrid/Smoother.h"

#include <memory>
#include <optional>

namespace gridfem
{

enum class CycleType
{
  V = 0,
  W = 1
};

enum class SmootherType
{
  Patch = 0,
  GaussSeidel = 1,
  SliceGaussSeidel = 2 // needs slices in the order; see MakeSliceGaussSeidel
};

/// How one level is relaxed, if it differs from the rest of the hierarchy. An example is the level
/// of a mesh's hat functions above the levels of a grid.
struct LevelSmoothing
{
  SmootherType smoother = SmootherType::GaussSeidel;
  int preSweeps = 2;
  int postSweeps = 2;
  CycleType cycle = CycleType::V; // V: the next coarser level is visited once, W: twice
};

/// The data of one level, and what a cycle does with them. The steps are the same on a distributed
/// level; they are collective there. Vectors have a row for each unknown that this process holds.
template<class Real>
struct BasicMultigridLevel
{
  BasicSparseMatrix<Real> A;
  BasicSharedMatrix<Real> prolongation; // from the next coarser level; empty on the coarsest
  BasicSharedMatrix<Real> restriction;  // transpose of `prolongation`; made if empty
  PatchOrder order;
  PatchOrder groups; // unknowns that are relaxed together after a sweep over all; may be empty
  std::optional<LevelSmoothing> smoothing;             // replaces the options of the hierarchy
  std::shared_ptr<const DistributedLevel> distributed; // null: this process holds the level alone
  std::unique_ptr<BasicSmoother<Real>> smoother;       // none on the coarsest

  /// The communication between the rows; null if this process holds the level alone.
  const DistributedRows* Rows() const { return distributed ? &distributed->Rows() : nullptr; }

  /// xᵀ y of every column.
  Columns Products(const Vectors<Real>& x, const Vectors<Real>& y, int threads) const;

  /// r = b - A x; r may be b.
  void Residual(
    const Vectors<Real>& b, const Vectors<Real>& x, Vectors<Real>& r, int threads) const;

  void Sweep(const Vectors<Real>& b, Vectors<Real>& x, SweepDirection direction, int times,
    int threads) const;

  /// coarse = Pᵀ b
  void Restrict(const Vectors<Real>& b, Vectors<Real>& coarse, int threads) const;

  /// coarse = Pᵀ r for r = b - A x. The scratch receives this process's part of r.
  /// @param energy  if not null: receives xᵀ (b + r) of every column
  void RestrictResidual(const Vectors<Real>& b, const Vectors<Real>& x, Vectors<Real>& scratch,
    Vectors<Real>& coarse, Columns* energy, int threads) const;

  /// fine = P coarse
  void Prolong(const Vectors<Real>& coarse, Vectors<Real>& fine, int threads) const;

  /// x += P coarse
  void ProlongAdd(
    const Vectors<Real>& coarse, Vectors<Real>& x, Vectors<Real>& scratch, int threads) const;
};

using MultigridLevel = BasicMultigridLevel<double>;

} // namespace gridfem

#endif
