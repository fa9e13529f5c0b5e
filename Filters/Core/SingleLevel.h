// One level of a hierarchy in single precision, as the cycle on blocks of columns sees it: sweeps
// of the patch smoother, the residual, and the way to the next coarser level. A vector register
// holds twice as many columns as in double, and a column moves half as many bytes.
#ifndef GridFEM_SingleLevel_h
#define GridFEM_SingleLevel_h

#include "BlockSweep.h"
#include "Multigrid.h"

#include <array>

namespace gridfem
{

/// Columns of a block of vectors that are worked on together: one row, aligned to its vector
/// registers.
template<int Width>
using PanelRow = Eigen::Array<float, Width, 1>;
template<int Width>
using Panel = Array<PanelRow<Width>>;

/// A sparse matrix in single precision; shares its pattern with the one it comes from.
struct SingleMatrix
{
  Index rows = 0;
  SharedArray<Id> rowBegin;
  SharedArray<Index> column;
  Array<float> value;

  SingleMatrix() = default;
  SingleMatrix(const SparseMatrix& A, int threads);

  std::size_t Memory() const { return value.size() * sizeof(float); }
};

class SingleLevel
{
public:
  /// From a level with matrix and order; its prolongation may be empty.
  SingleLevel(const MultigridLevel& level, int threads);

  Index Rows() const { return A_.rows; }
  Index CoarseRows() const { return restriction_.rows; }

  /// As Smoother::Sweep: improves x for A x = b.
  template<int Width>
  void Sweep(const Panel<Width>& b, Panel<Width>& x, SweepDirection direction, int threads) const;

  /// r = b - A x
  template<int Width>
  void Residual(const Panel<Width>& b, const Panel<Width>& x, Panel<Width>& r, int threads) const;

  /// coarse = Pᵀ r
  template<int Width>
  void Restrict(const Panel<Width>& r, Panel<Width>& coarse, int threads) const;

  /// x += P coarse
  template<int Width>
  void AddProlonged(const Panel<Width>& coarse, Panel<Width>& x, int threads) const;

  Id Patches() const { return static_cast<Id>(patches_.size()); }
  /// Patches with directions that single precision does not resolve: the sweep leaves them out.
  Id UnresolvedPatches() const { return unresolved_; }
  std::size_t Memory() const;

private:
  static constexpr int N = FunctionsPerPatch;
  /// Unknowns in the order of the pivots, and the rows of V, packed; see PatchFactor.
  struct Patch
  {
    std::array<Index, N> dof;
    std::array<float, N*(N + 1) / 2> factor;
  };

  template<int Width>
  void Relax(const Patch& patch, const PanelRow<Width>* b, PanelRow<Width>* x) const;

  SingleMatrix A_;
  SingleMatrix prolongation_;
  SingleMatrix restriction_;
  BlockRanges ranges_;
  Array<Patch> patches_; // in visiting order
  Id unresolved_ = 0;
};

} // namespace gridfem

#endif
