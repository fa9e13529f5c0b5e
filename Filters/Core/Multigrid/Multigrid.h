// The multigrid cycle. It sees matrices and patch lists only, never triangles. [T §3.3, §4.2]
#ifndef GridFEM_Multigrid_h
#define GridFEM_Multigrid_h

#include "Base/Pool.h"
#include "Multigrid/CoarseSolver.h"
#include "Multigrid/DividedLevel.h"
#include "Multigrid/Smoother.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

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

struct MultigridOptions
{
  CycleType cycle = CycleType::W;
  SmootherType smoother = SmootherType::Patch;
  int preSweeps = 1;                                  // >= 0; equal counts keep the cycle symmetric
  int postSweeps = 1;                                 // >= 0
  FactorPrecision precision = FactorPrecision::Mixed; // of the patch smoother
  int sweepsPerSynchronisation = 1;                   // of SliceGaussSeidel: one Sweep is so many
  int threads = 0;                                    // 0: all
};

/// How one level is relaxed, where that differs from the rest of the hierarchy: the hat functions
/// of a mesh above the levels of a grid.
struct LevelSmoothing
{
  SmootherType smoother = SmootherType::GaussSeidel;
  int preSweeps = 2;
  int postSweeps = 2;
  CycleType cycle = CycleType::V; // V: the next coarser level is visited once, W: twice
};

/// One level as the cycle sees it.
struct MultigridLevel
{
  SparseMatrix A;
  SharedMatrix prolongation; // from the next coarser level to this one; empty on the coarsest
  SharedMatrix restriction;  // its transpose; is made where it is empty
  PatchOrder order;
  PatchOrder groups; // of unknowns that are relaxed together after a sweep over all; or empty
  std::optional<LevelSmoothing> smoothing;     // in place of the options of the hierarchy
  std::shared_ptr<const DividedLevel> divided; // null: this process holds the level alone
  std::unique_ptr<Smoother> smoother;          // none on the coarsest
};

/// What processes that divide the level have of it; null: this process holds it alone.
inline const DividedRows* RowsOf(const MultigridLevel& level)
{
  return level.divided ? &level.divided->Rows() : nullptr;
}

/// A hierarchy that is ready to cycle. Const methods are safe to call from several threads, but
/// where processes divide a level: there all of them make it and call each method, in the same
/// order. Vectors of a divided level have a row for each unknown that this process holds.
class Multigrid
{
public:
  /// @param levels finest first, with A, prolongation and order filled; the rest is built here.
  /// The coarsest level is solved directly; its prolongation and order are not used.
  /// Throws InvalidInput when there is no level, shapes do not fit or a sweep count is negative.
  Multigrid(std::vector<MultigridLevel> levels, const MultigridOptions& options);

  /// New matrix values on the same patterns (finest first): rebuilds smoothers and coarse solver.
  /// Throws InvalidInput, and changes nothing, when a pattern differs in shape or size.
  void Update(std::vector<SparseMatrix> matrices);

  /// The same in place: refill(level, matrix) gives the matrix of every level its values. When it
  /// throws, the hierarchy must not be used any more.
  void Update(const std::function<void(std::size_t, SparseMatrix&)>& refill);

  /// Whether a patch smoother, of any process, stores factors in single precision.
  bool HasSingleFactors() const;

  /// A copy whose patch smoothers store all factors in double precision; it shares patterns and
  /// prolongations.
  Multigrid InDoublePrecision() const;

  /// One cycle: improves x for A x = b. Any number of columns. Keeps its vectors, up to four times
  /// the size of b, for the next call.
  void Cycle(const MultiVector& b, MultiVector& x) const;

  /// One cycle from zero: x = B b, B symmetric when both sweep counts are equal.
  void Precondition(const MultiVector& b, MultiVector& x) const;

  /// A start for the iteration [T §3.3]: solves the coarsest system, takes the solution up and
  /// improves it by one cycle on every level but the finest. x = C b with C symmetric positive
  /// semi-definite where B is. Cost: a third of a W cycle. x must not be b.
  /// @param lastStep  if not null: by how much the solution of the second level differs from that
  ///                  of the third, on the finest; without columns where there are fewer
  void NestedIteration(const MultiVector& b, MultiVector& x, MultiVector* lastStep = nullptr) const;

  /// The same as Precondition on the hierarchy that begins at `level`.
  void PreconditionFrom(std::size_t level, const MultiVector& b, MultiVector& x) const;

  const SparseMatrix& Matrix() const { return levels_.front().A; }
  const std::vector<MultigridLevel>& Levels() const { return levels_; }
  const MultigridOptions& Options() const { return options_; }
  std::size_t Memory() const;

private:
  void BuildSolvers();
  void FindSingle();
  std::unique_ptr<Smoother> MakeSmoother(std::size_t level);
  std::unique_ptr<Smoother> MakeSmoother(MultigridLevel& level, SmootherType type);
  LevelSmoothing SmoothingOf(std::size_t level) const;
  /// Vectors of one level during one call.
  struct Scratch
  {
    MultiVector scaled;     // right-hand side in units of its columns, for single precision
    MultiVector correction; // its solution
    MultiVector residual;
    MultiVector coarseB;
    MultiVector coarseX;
  };
  /// Of all levels, kept from one call to the next, of one thread: fresh memory takes as long as a
  /// sweep.
  struct Workspace
  {
    std::vector<Scratch> scratch;
    Id columns = 0;

    /// What has been used has its size already: a block that Eigen cannot resize for lack of memory
    /// keeps a pointer to what it has freed.
    std::vector<Scratch>& For(std::size_t levels, Id wanted);
  };

  void CheckRows(std::size_t level, const MultiVector& b) const;
  void RestrictResidual(std::size_t level, const MultiVector& b, const MultiVector* x,
    MultiVector& residual, MultiVector& coarse) const;
  Eigen::ArrayXd CycleInUnits(
    std::size_t level, const MultiVector& b, MultiVector& x, std::vector<Scratch>& scratch) const;
  void Correct(
    std::size_t level, const MultiVector& b, MultiVector& x, std::vector<Scratch>& scratch) const;
  void Improve(
    std::size_t level, const MultiVector& b, MultiVector& x, std::vector<Scratch>& scratch) const;
  void CycleLevel(std::size_t level, const MultiVector& b, MultiVector& x, bool zeroStart,
    std::vector<Scratch>& scratch) const;
  void CorrectFromCoarse(std::size_t level, const MultiVector& b, MultiVector& x, bool zeroX,
    std::vector<Scratch>& scratch) const;
  void VisitCoarse(std::size_t level, const MultiVector& b, MultiVector& x, bool zeroX, int times,
    std::vector<Scratch>& scratch) const;

  std::vector<MultigridLevel> levels_;
  std::vector<char> isSingle_; // per level: whether it or a coarser one sweeps in single precision
  CoarseSolver coarse_;
  MultigridOptions options_;
  std::unique_ptr<Pool<Workspace>> workspace_ = std::make_unique<Pool<Workspace>>(1);
};

} // namespace gridfem

#endif
