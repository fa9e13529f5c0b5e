// The V cycle with the patch smoother in single precision, for eigenproblems: it corrects hundreds
// of columns and needs to be right in a few digits only.
#ifndef GridFEM_SingleCycle_h
#define GridFEM_SingleCycle_h

#include "Base/Pool.h"
#include "Multigrid/BlockPreconditioner.h"
#include "Multigrid/SingleLevel.h"

namespace gridfem
{

/// One forward sweep, the correction from the next coarser level, one backward sweep. Const methods
/// are safe to call from several threads, but where processes divide a level: there all of them
/// call each method, in the same order.
class SingleCycle
{
public:
  /// As Multigrid; takes the levels apart one after the other.
  SingleCycle(std::vector<MultigridLevel> levels, int threads);

  /// Whether single precision resolves all but a hundredth of the patches. The others are flat and
  /// almost parallel to a plane of the grid, where differences of functions nearly vanish.
  bool IsReliable() const;

  /// z = one cycle from `level` on, from zero, on every column of r; see BlockPreconditioner. Half
  /// of a cycle, down to the coarsest level, makes rᵀBr known. Keeps its vectors, as many as are
  /// used at the same time, for the next call. Throws InvalidInput when there are too many columns.
  template<class Real>
  ResidualMeasures Apply(std::size_t level, const RowSource<Real>& r,
    const CorrectionTest& isWanted, const RowSink<Real>& z) const;

  std::size_t Memory() const;

private:
  struct Panels
  {
    std::vector<Panel> b; // of every level
    Panel work;           // x and residual: those of coarser levels where a residual has been used
  };

  std::size_t WorkRows(std::size_t level) const;
  PanelSums GoDown(std::size_t level, std::vector<Panel>& b, PanelRow* work) const;
  void GoUp(std::size_t level, const std::vector<Panel>& b, PanelRow* work) const;
  PanelSums SolveCoarsest(const Panel& b, PanelRow* x) const;

  std::vector<SingleLevel> levels_; // all but the coarsest
  std::vector<std::size_t> rows_;   // of all
  CoarseSolver coarse_;
  int threads_;
  mutable Pool<Panels> panels_;
};

} // namespace gridfem

#endif
