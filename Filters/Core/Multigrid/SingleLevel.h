// One level of a hierarchy in single precision, as the cycle on blocks of columns sees it: sweeps
// of the patch smoother, the residual, and the way to the next coarser level. A vector register
// holds twice as many columns as in double, and a column moves half as many bytes.
#ifndef GridFEM_SingleLevel_h
#define GridFEM_SingleLevel_h

#include "Multigrid/BlockPreconditioner.h"
#include "Multigrid/BlockSweep.h"
#include "Multigrid/Multigrid.h"

#include <array>

namespace gridfem
{

/// A row of the few columns that are worked on together: two vector registers of sixteen share
/// every number of a matrix that is read. Reading matrices takes most of the time, so that fewer
/// columns are not much faster.
using PanelRow = Eigen::Array<float, PreconditionedColumns, 1>;
using Panel = Array<PanelRow>;
using PanelSums = Eigen::Array<double, PreconditionedColumns, 1>;

/// Rows of panels as a block.
inline Eigen::Map<Vectors<float>> AllColumns(PanelRow* rows, Id count)
{
  return { rows->data(), count, PreconditionedColumns };
}

/// Adds up products(row), in single precision a few rows at a time.
template<class Products>
PanelSums SumOfRows(Id begin, Id end, Products&& products)
{
  constexpr Id rowsAtOnce = 64;
  PanelSums sum = PanelSums::Zero();
  for (Id first = begin; first < end; first += rowsAtOnce)
  {
    PanelRow part = PanelRow::Zero();
    for (Id row = first; row < std::min(end, first + rowsAtOnce); ++row)
    {
      part += products(row);
    }
    sum += part.cast<double>();
  }
  return sum;
}

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
  /// From a level with matrix and order; its prolongation may be empty. Where processes divide it,
  /// all call Sweep, Residual and Restrict.
  SingleLevel(const MultigridLevel& level, int threads);

  Index Rows() const { return A_.rows; }
  Index CoarseRows() const { return restriction_.rows; }
  const DividedRows* Divided() const { return divided_ ? &divided_->Rows() : nullptr; }

  /// As Smoother::Sweep: improves x for A x = b. Here as below panels have a row per unknown.
  void Sweep(const PanelRow* b, PanelRow* x, SweepDirection direction, int threads) const;

  /// r = b - A x, of a divided level the part; returns xᵀ(b + r), which for the first sweep from
  /// zero is its share of bᵀBb.
  PanelSums Residual(const PanelRow* b, const PanelRow* x, PanelRow* r, int threads) const;

  /// coarse = Pᵀ r
  void Restrict(const PanelRow* r, PanelRow* coarse, int threads) const;

  /// x += P coarse
  void AddProlonged(const PanelRow* coarse, PanelRow* x, int threads) const;

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

  void Relax(const Patch& patch, const PanelRow* b, PanelRow* x) const;
  void RelaxPatches(const PanelRow* b, PanelRow* x, SweepDirection direction, int threads) const;
  void RelaxBorder(const PanelRow* b, PanelRow* x, SweepDirection direction) const;
  PanelRow ResidualRow(Index row, const PanelRow* b, const PanelRow* x) const;

  std::shared_ptr<const DividedLevel> divided_; // null: this process holds all
  Index foreign_;                               // unknowns of other processes, whose b is theirs
  SingleMatrix A_;
  SingleMatrix prolongation_;
  SingleMatrix restriction_;
  BlockRanges ranges_;
  Array<Patch> patches_; // in visiting order
  Id unresolved_ = 0;
};

} // namespace gridfem

#endif
