// The multigrid cycle. It sees only matrices and patch lists, never triangles. [T §3.3, §4.2]
#ifndef GridFEM_Multigrid_h
#define GridFEM_Multigrid_h

#include "Base/Pool.h"
#include "Multigrid/BlockPreconditioner.h"
#include "Multigrid/CoarseSolver.h"
#include "Multigrid/DeviceHierarchy.h"
#include "Multigrid/MultigridLevel.h"

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace gridfem
{

struct MultigridOptions
{
  CycleType cycle = CycleType::W;
  SmootherType smoother = SmootherType::Patch;
  int preSweeps = 1;                                  // >= 0; equal counts keep the cycle symmetric
  int postSweeps = 1;                                 // >= 0
  FactorPrecision precision = FactorPrecision::Mixed; // precision of the patch smoother's factors
  int sweepsPerSynchronization = 1;                   // of SliceGaussSeidel: sweeps in one Sweep
  int threads = 0;                                    // 0: all
  /// A GPU has V cycles and a smoother of its own. Another smoother, number of sweeps or precision
  /// than the default keeps the cycles on the CPU.
  DeviceChoice device = DeviceChoice::Automatic;
};

/// A hierarchy that is ready to cycle, on the CPU or on a device. Real is the precision of matrices
/// and vectors. Solves need double. Float suits corrections of many columns that need only a few
/// correct digits. It offers only PreconditionRows. Sweeps may be in single precision with both.
/// Const methods are safe to call from several threads, unless processes divide a level. The
/// constructor and every method are then collective. Vectors of a distributed level have a row for
/// each unknown that this process holds.
template<class Real>
class BasicMultigrid
{
public:
  /// Builds everything else from the matrices, prolongations and orders.
  /// @param levels  finest first, with A, prolongation and order filled
  /// The coarsest level is solved directly; its prolongation and order are not used. In single
  /// precision only patches are relaxed, and each level is released as soon as it is converted.
  /// Throws InvalidInput when there is no level, shapes do not fit or a sweep count is negative.
  BasicMultigrid(std::vector<MultigridLevel> levels, const MultigridOptions& options);

  /// Takes new matrix values on the same patterns and rebuilds smoothers and coarse solver.
  /// refill(level, matrix) gives the matrix of every level its values. If it throws, the hierarchy
  /// must not be used any more.
  void Update(const std::function<void(std::size_t, SparseMatrix&)>& refill);

  /// Whether a patch smoother of any process stores factors in single precision, or a device
  /// cycles.
  bool HasSingleFactors() const;

  /// Whether sweeps resolve all but a hundredth of the patches of all processes. Unresolved patches
  /// are flat and almost parallel to a plane of the grid, where differences of functions nearly
  /// vanish. Always true in double precision.
  bool IsReliable() const { return isReliable_; }

  /// A copy on the CPU whose patch smoothers store all factors in double precision. It shares
  /// patterns and prolongations.
  BasicMultigrid InDoublePrecision() const;

  /// One cycle: improves x for A x = b. Any number of columns. Keeps its vectors for the next call,
  /// up to four times the size of b for each thread that cycles at the same time.
  void Cycle(const Vectors<Real>& b, Vectors<Real>& x) const;

  /// One cycle from zero: x = B b. B is symmetric when both sweep counts are equal.
  void Precondition(const Vectors<Real>& b, Vectors<Real>& x) const;

  /// Computes a start for the iteration [T §3.3]. It solves the coarsest system, prolongs the
  /// solution and improves it by one cycle on every level but the finest. The result is x = C b,
  /// with C symmetric positive semi-definite where B is. Cost: a third of a W cycle. x must not be
  /// b.
  /// @param lastStep if not null: the solution of the second level minus the solution of the third,
  ///   prolonged to the finest; without columns if there are fewer levels
  void NestedIteration(
    const Vectors<Real>& b, Vectors<Real>& x, Vectors<Real>* lastStep = nullptr) const;

  /// z = B r on the hierarchy that begins at `level`; see BlockPreconditioner. rᵀBr is known after
  /// all but the last sweeps of this level. Throws InvalidInput when there are more than
  /// WidestPanel columns, or B is not symmetric.
  template<class Given>
  ResidualMeasures PreconditionRows(std::size_t level, const RowSource<Given>& r,
    const CorrectionTest& isWanted, const RowSink<Given>& z) const;

  const BasicSparseMatrix<Real>& Matrix() const { return levels_.front().A; }
  /// The levels; in single precision they have no orders and groups, and on a device only A.
  const std::vector<BasicMultigridLevel<Real>>& Levels() const { return levels_; }
  const MultigridOptions& Options() const { return options_; }
  std::size_t Memory() const;

  /// The device that cycles; null if the CPU does.
  const DeviceHierarchy* OnDevice() const { return device_.get(); }
  /// Why no device cycles; empty if one does, or did until it failed.
  const std::string& WhyNotOnDevice() const { return whyNotOnDevice_; }
  /// The device that cycles, and the reason if it is the CPU: "GPU: NVIDIA H100", "CPU: there are
  /// few functions".
  std::string Where() const;

private:
  void ConvertLevels(std::vector<MultigridLevel> levels);
  void BuildSolvers();
  void UseDevice(const std::vector<MultigridLevel>& levels);
  void FindSingleLevels();
  std::unique_ptr<BasicSmoother<Real>> MakeSmoother(MultigridLevel& level) const;
  std::unique_ptr<BasicSmoother<Real>> MakeFirstSmoother(MultigridLevel& level) const;
  LevelSmoothing SmoothingOf(const std::optional<LevelSmoothing>& ofLevel) const
  {
    return ofLevel.value_or(
      LevelSmoothing{ options_.smoother, options_.preSweeps, options_.postSweeps, options_.cycle });
  }

  /// Vectors of one level during one call.
  struct Scratch
  {
    Vectors<Real> b; // a load other than the caller's: of a coarser level, or scaled to units
    Vectors<Real> x; // its solution
    Vectors<Real> residual;
  };
  /// Vectors of all levels during one call. As many workspaces are kept for the next call as are
  /// used at the same time, because fresh memory takes as long as a sweep.
  struct Workspace
  {
    std::vector<Scratch> scratch;
    Id columns = 0;

    /// The scratch of `levels` levels. Old blocks of another width are released, not resized. A
    /// block that Eigen cannot resize for lack of memory keeps a pointer to freed memory.
    std::vector<Scratch>& For(std::size_t levels, Id wanted);
  };

  bool IsCoarsest(std::size_t level) const { return level + 1 == levels_.size(); }
  void CheckRows(std::size_t level, Id rows) const;
  void RequireSymmetry(std::size_t level) const;
  void SolveCoarsest(const Vectors<Real>& b, Vectors<Real>& x) const;
  const BasicMultigrid& OnCpu() const;
  void CorrectOnDevice(
    std::size_t level, const Vectors<Real>& b, Vectors<Real>& x, bool isMeasured) const;
  void Correct(std::size_t level, const Vectors<Real>& b, Vectors<Real>& x,
    std::vector<Scratch>& scratch) const;
  void Improve(std::size_t level, const Vectors<Real>& b, Vectors<Real>& x,
    std::vector<Scratch>& scratch) const;
  void CycleLevel(std::size_t level, const Vectors<Real>& b, Vectors<Real>& x, bool zeroStart,
    std::vector<Scratch>& scratch) const;
  void Descend(std::size_t level, const Vectors<Real>& b, Vectors<Real>& x, bool zeroStart,
    std::vector<Scratch>& scratch, Columns* energy = nullptr) const;
  void Ascend(std::size_t level, const Vectors<Real>& b, Vectors<Real>& x,
    std::vector<Scratch>& scratch) const;

  std::vector<BasicMultigridLevel<Real>> levels_;
  /// Whether vectors of each level are in double precision while this level or a coarser one sweeps
  /// in single precision.
  std::vector<char> isSingle_;
  bool isReliable_ = true;
  CoarseSolver coarse_;
  MultigridOptions options_;
  std::unique_ptr<DeviceHierarchy> device_;
  std::string whyNotOnDevice_; // once refused, a device is not tried again
  /// What goes on if the device fails.
  struct Spare
  {
    std::vector<MultigridLevel> levels; // of a hierarchy in single precision, which keeps no orders
    std::once_flag isMade;
    std::unique_ptr<const BasicMultigrid> onCpu;
  };
  std::unique_ptr<Spare> spare_; // null without a device
  std::unique_ptr<Pool<Workspace>> workspace_ = std::make_unique<Pool<Workspace>>();
};

using Multigrid = BasicMultigrid<double>;

///@{ Functions of hierarchies in double precision only.
template<>
void BasicMultigrid<float>::Update(const std::function<void(std::size_t, SparseMatrix&)>&) = delete;
template<>
bool BasicMultigrid<float>::HasSingleFactors() const = delete;
template<>
BasicMultigrid<float> BasicMultigrid<float>::InDoublePrecision() const = delete;
template<>
void BasicMultigrid<float>::Cycle(const Vectors<float>&, Vectors<float>&) const = delete;
template<>
void BasicMultigrid<float>::Precondition(const Vectors<float>&, Vectors<float>&) const = delete;
template<>
void BasicMultigrid<float>::NestedIteration(
  const Vectors<float>&, Vectors<float>&, Vectors<float>*) const = delete;
///@}

/// Whether a hierarchy in single precision accepts these levels. All levels but the coarsest have
/// to relax patches; the precision of their factors does not matter.
bool FitSinglePrecision(const std::vector<MultigridLevel>& levels, const MultigridOptions& options);

/// One cycle from zero, from `level` on. The hierarchy has to outlive the preconditioner.
template<class Given, class Real>
BlockPreconditioner<Given> CyclePreconditioner(
  const BasicMultigrid<Real>& multigrid, std::size_t level)
{
  return [&multigrid, level](const RowSource<Given>& r, const CorrectionTest& isWanted,
           const RowSink<Given>& z) { return multigrid.PreconditionRows(level, r, isWanted, z); };
}

} // namespace gridfem

#endif
