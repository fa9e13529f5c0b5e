// A level's matrix and patches in the form that a sweep in single precision reads. They are stored
// block by block. Every row is a stencil of the grid, 27 numbers that need no column indices.
#ifndef GridFEM_StencilBlocks_h
#define GridFEM_StencilBlocks_h

#include "Multigrid/PatchFactor.h"
#include "Multigrid/Smoother.h"

#include <array>
#include <cstdint>
#include <vector>

namespace gridfem
{

/// Entries of a row by the grid corner of their column, x fastest. A row has nine runs along x, of
/// three neighbors and one place that stays zero.
struct StencilRow
{
  static constexpr int Size = 36;
  std::array<float, Size> value;
};

/// Blocks of a PatchOrder. The data of a block's sweep are adjacent in memory. Every block numbers
/// its unknowns: number 0 means none and has a zero row and value. The unknowns of its patches come
/// next, then the unknowns they are coupled to.
class StencilBlocks
{
public:
  static constexpr int N = 8;      // corners of a cell
  static constexpr int Slots = 64; // corners around a cell: 4 x 4 x 4, x fastest

  using Local = std::uint16_t; // number of an unknown within its block

  struct Block
  {
    Id firstUnknown; // index where Unknowns() begin
    Id firstRow;     // index where Rows() begin
    Index own;       // its patches' unknowns, which have rows: numbers 1 to `own`
    Index count;     // how many numbers there are, with 0
  };

  struct Patch
  {
    std::array<Local, Slots> slot;      // the unknown at each corner that its rows are coupled to
    std::array<Local, N> row;           // row of each corner's unknown, in the block
    std::array<Local, N> unknown;       // its unknowns in the order of the factor
    std::array<std::uint8_t, N> corner; // corner of each of these unknowns
    std::array<float, N * N> factor;    // V of PatchFactor, column by column
    Index firstExtra;                   // index in Extras()
    Index extras;
  };

  /// An entry whose column cannot have the slot of its grid corner, because another unknown has it.
  /// The two unknowns are functions that have been split.
  struct Extra
  {
    float value;
    Local corner; // of the row
    Local column;
  };

  /// An unknown of a block whose numbers would leave the range of single precision, such as a
  /// function on a sliver of a cell. The block holds `weight` times its value, and its rows and
  /// factors are scaled accordingly.
  struct Scaled
  {
    Index number;
    double weight; // a power of two near the square root of the diagonal
  };

  /// The slot of a patch's own unknown.
  static constexpr unsigned OwnSlot(unsigned corner)
  {
    return 21 + corner % 2 + 4 * (corner / 2 % 2) + 16 * (corner / 4);
  }

  /// Numbers the blocks. They stay empty if the order has no corners, a patch is not a cell's, or a
  /// block has too many unknowns. They stay empty if so many functions share corners that half of
  /// the rows would be for single patches. Finally, they stay empty if single precision does not
  /// resolve all directions of more than a tenth of the patches.
  StencilBlocks(const SparseMatrix& A, const PatchOrder& order, int threads);

  /// Takes the values of a matrix with the same pattern.
  /// @return false if the new blocks would be empty; the old ones must not be used any more
  bool Refill(const SparseMatrix& A, const PatchOrder& order, int threads);

  bool IsEmpty() const { return blocks_.empty(); }
  /// False if the blocks are empty for any values of the matrix.
  bool PatternFits() const { return patternFits_; }
  const Block& BlockAt(Id block) const { return blocks_[block]; }
  /// Unknowns of the level, by their number in the block.
  const Index* Unknowns(const Block& block) const { return &unknowns_[block.firstUnknown]; }
  /// Rows by the number of the unknown, then the rows of single patches.
  const StencilRow* Rows(const Block& block) const { return rows_.data() + block.firstRow; }
  const Patch& PatchAt(Id patch) const { return patches_[patch]; }
  const Extra* Extras(const Patch& patch) const { return extras_.data() + patch.firstExtra; }
  /// The scaled unknowns of a block. Most blocks have none.
  const std::vector<Scaled>& ScaledOf(Id block) const { return scaled_[block]; }
  /// Patches, ascending, with directions that single precision does not resolve. Their factors
  /// leave these directions out.
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
