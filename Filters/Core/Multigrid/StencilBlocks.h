// A level's matrix and patches in the form in which a sweep in single precision reads them: block
// by block, every row as a stencil of the grid, 27 numbers that need no column indices.
#ifndef GridFEM_StencilBlocks_h
#define GridFEM_StencilBlocks_h

#include "Multigrid/PatchFactor.h"
#include "Multigrid/Smoother.h"

#include <array>
#include <cstdint>
#include <vector>

namespace gridfem
{

/// Entries of a row by the corner of their column: nine runs along x of three neighbours and one
/// place that stays zero; x fastest.
struct StencilRow
{
  static constexpr int Size = 36;
  std::array<float, Size> value;
};

/// Blocks of a PatchOrder with what their sweep needs beside each other in memory. Unknowns have
/// numbers of their own in each block: 0 is none, whose row and value are zero; then come those of
/// its patches, then those they are coupled to.
class StencilBlocks
{
public:
  static constexpr int N = 8;      // corners of a cell
  static constexpr int Slots = 64; // corners around a cell: 4 x 4 x 4, x fastest

  using Local = std::uint16_t; // number of an unknown within its block

  struct Block
  {
    Id firstUnknown; // where Unknowns() begin
    Id firstRow;     // where Rows() begin
    Index own;       // unknowns of its patches: numbers 1 to `own`, which have rows
    Index count;     // numbers, with 0
  };

  struct Patch
  {
    std::array<Local, Slots> slot;      // the unknown at each corner that its rows are coupled to
    std::array<Local, N> row;           // of each corner's unknown, in the block
    std::array<Local, N> unknown;       // in the order of the factor
    std::array<std::uint8_t, N> corner; // of each of these
    std::array<float, N * N> factor;    // V of PatchFactor, column by column
    Index firstExtra;                   // in Extras()
    Index extras;
  };

  /// An entry whose column has a slot that another unknown of the same grid corner takes: one of
  /// two functions that have been split.
  struct Extra
  {
    float value;
    Local corner; // of the row
    Local column;
  };

  /// An unknown of a block whose numbers would leave the range of single precision, as those of a
  /// function on a sliver of a cell do: `weight` times its value takes the place of the value, in
  /// rows and factors as well.
  struct Scaled
  {
    Index number;
    double weight; // a power of two near the root of the diagonal
  };

  /// The slot of a patch's own unknown.
  static constexpr unsigned OwnSlot(unsigned corner)
  {
    return 21 + corner % 2 + 4 * (corner / 2 % 2) + 16 * (corner / 4);
  }

  /// Empty where the order has no corners, a patch is not a cell's, a block has too many unknowns,
  /// so many functions share corners that half of the rows would be single patches', or single
  /// precision does not resolve all directions of more than a tenth of the patches.
  StencilBlocks(const SparseMatrix& A, const PatchOrder& order, int threads);

  /// Takes the values of a matrix with the same pattern.
  /// @return false where the new blocks would be empty; then these must not be used any more
  bool Refill(const SparseMatrix& A, const PatchOrder& order, int threads);

  bool IsEmpty() const { return blocks_.empty(); }
  /// False where they are empty for any values of the matrix.
  bool PatternFits() const { return patternFits_; }
  const Block& BlockAt(Id block) const { return blocks_[block]; }
  /// Of the level, by their number in the block.
  const Index* Unknowns(const Block& block) const { return &unknowns_[block.firstUnknown]; }
  /// By the number of the unknown, then those of single patches.
  const StencilRow* Rows(const Block& block) const { return rows_.data() + block.firstRow; }
  const Patch& PatchAt(Id patch) const { return patches_[patch]; }
  const Extra* Extras(const Patch& patch) const { return extras_.data() + patch.firstExtra; }
  /// The unknowns of a block that are scaled; of most blocks none.
  const std::vector<Scaled>& ScaledOf(Id block) const { return scaled_[block]; }
  /// Patches, ascending, with directions that single precision does not resolve: their factors
  /// leave these out.
  const std::vector<Id>& Unresolved() const { return unresolved_; }
  Id NumberOfPatches() const { return static_cast<Id>(patches_.size()); }
  std::size_t Memory() const;

private:
  struct Draft;
  bool Lay(const SparseMatrix& A, const PatchOrder& order, int threads);
  bool FillFactors(const SparseMatrix& A, const PatchOrder& order, int threads);
  bool SetFactor(const PatchFactor& factor, UnknownGroup dof, Patch& patch) const;
  double WeightOf(Index unknown) const { return weight_.empty() ? 1.0 : weight_[unknown]; }
  float EntryOf(const SparseMatrix& A, Index row, Id k) const;
  void FillRows(const SparseMatrix& A, const PatchOrder& order, int threads);
  void FillOwnRows(
    const SparseMatrix& A, const PatchOrder& order, const Block& block, const Patch& patch);

  bool patternFits_ = true;
  std::vector<Block> blocks_;
  Array<Index> unknowns_;
  Array<StencilRow> rows_;
  Array<Patch> patches_;
  Array<Extra> extras_;
  std::vector<double> weight_;              // per unknown; empty where all are 1
  std::vector<std::vector<Scaled>> scaled_; // per block
  std::vector<Id> unresolved_;
};

} // namespace gridfem

#endif
