// The V cycle with the patch smoother in single precision, for eigenproblems: it corrects hundreds
// of columns and needs to be right in a few digits only.
#ifndef GridFEM_SingleCycle_h
#define GridFEM_SingleCycle_h

#include "Pool.h"
#include "Preconditioner.h"
#include "SingleLevel.h"

namespace gridfem
{

/// One forward sweep, the correction from the next coarser level, one backward sweep. Const methods
/// are safe to call from several threads.
class SingleCycle
{
public:
  /// As Multigrid; takes the levels apart one after the other.
  SingleCycle(std::vector<MultigridLevel> levels, int threads);

  /// Whether single precision resolves all but a thousandth of the patches. The others are flat
  /// and almost parallel to a plane of the grid, where differences of functions nearly vanish.
  bool IsReliable() const;

  /// z = one cycle from `level` on, from zero, on every column of r; see Preconditioner. Keeps its
  /// vectors, as many as are used at the same time, for the next call. Throws InvalidInput when
  /// there are too many columns.
  ResidualMeasures Apply(std::size_t level, const RowSource& r, Block z) const;

  std::size_t Memory() const;

private:
  /// Two vector registers of sixteen columns each share every number of a matrix that is read; the
  /// rest of a block takes one.
  static constexpr int WidePanel = PreconditionedColumns;
  static constexpr int NarrowPanel = 16;

  /// Vectors of one level.
  template<int Width>
  struct LevelPanels
  {
    Panel<Width> b;
    Panel<Width> x;
    Panel<Width> residual;
  };
  template<int Width>
  using Panels = std::vector<LevelPanels<Width>>;

  template<int Width>
  ResidualMeasures ApplyPanel(
    std::size_t level, const RowSource& r, Block z, Pool<Panels<Width>>& pool) const;
  template<int Width>
  void CycleLevel(std::size_t level, Panels<Width>& panels) const;
  template<int Width>
  void SolveCoarsest(LevelPanels<Width>& panels) const;

  std::vector<SingleLevel> levels_; // all but the coarsest
  CoarseSolver coarse_;
  int threads_;
  mutable Pool<Panels<WidePanel>> wide_;
  mutable Pool<Panels<NarrowPanel>> narrow_;
};

} // namespace gridfem

#endif
