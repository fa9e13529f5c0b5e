#include "Multigrid/StencilBlocks.h"

#include "Base/Parallel.h"
#include "Base/PrecisionTraits.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>

namespace gridfem
{
namespace
{

constexpr int N = StencilBlocks::N;
static_assert(N == PatchKernelWidth);
constexpr Index None = -1;

/// Largest share of patches with smaller pivots than single precision resolves. These patches are
/// relaxed once more in double precision. With a larger share, sweeps gain little and iterations to
/// small tolerances grow. On a part with many walls (cheese, depth 6) a share of 4 % raised the
/// iterations to 1e-10 from 41 to 51, in seven eighths of the time.
constexpr double UnresolvedShare = 0.1;

/// Place of the diagonal entry in a row. The corners (PatchOrder::corner) of row and column differ
/// by -17 to 17.
constexpr unsigned Center = 17;

/// The offset of PatchOrder::corner at a corner of a cell.
constexpr Index CornerOffset(int corner)
{
  return (corner & 1) + 4 * ((corner >> 1) & 1) + 12 * (corner >> 2);
}

/// The slot that a patch's unknown at `corner` sees at a place of its row.
constexpr unsigned SlotOf(unsigned corner, unsigned place)
{
  const unsigned x = (corner & 1) + place % 4;
  const unsigned y = ((corner >> 1) & 1) + place / 4 % 3;
  const unsigned z = (corner >> 2) + place / 12;
  return x + 4 * y + 16 * z;
}

bool IsCell(UnknownGroup dof, const std::vector<Index>& corner)
{
  for (int c = 0; c < N; ++c)
  {
    if (dof[c] < 0 || corner[dof[c]] - corner[dof[0]] != CornerOffset(c))
    {
      return false;
    }
  }
  return true;
}

/// Calls visit(k, place) for the entries of a row.
template<class Visit>
void ForEachPlace(const SparseMatrix& A, const std::vector<Index>& corner, Index row, Visit&& visit)
{
  const Index first = corner[row] - static_cast<Index>(Center);
  for (Id k = A.rowBegin[row]; k < A.rowBegin[row + 1]; ++k)
  {
    visit(k, static_cast<unsigned>(corner[A.column[k]] - first));
  }
}

/// Sets the highest bit of every 16-bit number that is not zero.
constexpr std::uint64_t IsSet(std::uint64_t word)
{
  constexpr std::uint64_t low = 0x7fff7fff7fff7fff;
  return (((word & low) + low) | word) & ~low;
}

/// If the square roots of diagonals are between Range and 1 / Range, products of entries with
/// corrections stay in the range of single precision.
constexpr double Range = 1e-15;

/// A power of two near the square root of the diagonal if the root is out of range, else 1.
double RangeWeight(const BlockSource::Row& row)
{
  const bool isInRange = row.scale > Range && row.scale < 1.0 / Range;
  return row.diagonal < 0 || isInRange ? 1.0 : std::exp2(-std::ilogb(row.scale));
}

bool IsPlace(unsigned place)
{
  return place < StencilRow::Size && place % 4 != 3;
}

} // namespace

/// A block while its unknowns are being numbered.
struct StencilBlocks::Draft
{
  std::vector<Index> unknowns{ None }; // by their number, own unknowns first
  Index own = 0;
  Index rows = 0;            // zero row, own rows, and rows of patches with extras
  std::vector<Extra> extras; // of all its patches, without values
  bool fits = true;

  /// @param number  per unknown of the level: 0, and 0 again afterward
  Draft(const SparseMatrix& A, const PatchOrder& order, Id begin, Id end,
    std::vector<Index>& number, Patch* patches)
  {
    this->NumberOwn(order, begin, end, number);
    this->NumberNeighbors(A, order, number);
    fits = fits && unknowns.size() <= std::numeric_limits<Local>::max();
    for (Id p = begin; fits && p < end; ++p)
    {
      this->TakeSlots(A, order, order.dof[p], number, patches[p]);
    }
    for (std::size_t k = 1; k < unknowns.size(); ++k)
    {
      number[unknowns[k]] = 0;
    }
  }

private:
  /// Numbers of a row's unknowns, by place. A run of four numbers is one word. 0: none.
  struct Neighbors
  {
    std::array<std::uint64_t, StencilRow::Size / 4> run{};
    bool areMany = false; // two unknowns at one place

    void Set(unsigned place, Local number)
    {
      const unsigned shift = 16 * (place % 4);
      const bool isTaken = (run[place / 4] >> shift & 0xffff) != 0;
      run[place / 4] |= isTaken ? 0 : std::uint64_t{ number } << shift;
      areMany = areMany || isTaken;
    }
  };

  Index Number(Index unknown, std::vector<Index>& number)
  {
    if (number[unknown] == 0)
    {
      number[unknown] = static_cast<Index>(unknowns.size());
      unknowns.push_back(unknown);
    }
    return number[unknown];
  }

  void NumberOwn(const PatchOrder& order, Id begin, Id end, std::vector<Index>& number)
  {
    for (Id p = begin; fits && p < end; ++p)
    {
      fits = IsCell(order.dof[p], order.corner);
      for (int c = 0; fits && c < N; ++c)
      {
        this->Number(order.dof[p][c], number);
      }
    }
    own = static_cast<Index>(unknowns.size()) - 1;
    rows = own + 1;
  }

  void NumberNeighbors(const SparseMatrix& A, const PatchOrder& order, std::vector<Index>& number)
  {
    neighbors_.resize(own + 1);
    for (Index i = 1; fits && i <= own; ++i)
    {
      ForEachPlace(A, order.corner, unknowns[i],
        [&](Id k, unsigned place)
        {
          const auto column = static_cast<Local>(this->Number(A.column[k], number));
          if (IsPlace(place))
          {
            neighbors_[i].Set(place, column);
          }
          fits = fits && IsPlace(place);
        });
    }
  }

  /// Chooses the unknown of each slot. Functions that share a corner cannot both have its slot. The
  /// patch's own function has it, or else the function of the first row coupled to one of them.
  /// Rows coupled to another function get their own copy without its entries, which become extras.
  void TakeSlots(const SparseMatrix& A, const PatchOrder& order, UnknownGroup dof,
    const std::vector<Index>& number, Patch& patch)
  {
    std::array<std::uint64_t, Slots / 4> slots{};
    for (int c = 0; c < N; ++c)
    {
      const unsigned slot = OwnSlot(c);
      slots[slot / 4] |= std::uint64_t(number[dof[c]]) << 16 * (slot % 4);
    }
    const auto forEachRun = [&](int c, auto&& visit)
    {
      const Neighbors& row = neighbors_[number[dof[c]]];
      for (int run = 0; run < StencilRow::Size / 4; ++run)
      {
        visit(row.run[run] << 16 * (c & 1), slots[SlotOf(c - c % 2, 4 * run) / 4]);
      }
    };
    for (int c = 0; c < N; ++c)
    {
      forEachRun(c, [](std::uint64_t run, std::uint64_t& slot)
        { slot |= run & ~((IsSet(slot) >> 15) * 0xffff); });
    }
    for (unsigned k = 0; k < Slots; ++k)
    {
      patch.slot[k] = static_cast<Local>(slots[k / 4] >> 16 * (k % 4) & 0xffff);
    }
    patch.firstExtra = static_cast<Index>(extras.size()); // counted from the block's first
    for (int c = 0; c < N; ++c)
    {
      std::uint64_t foreign = neighbors_[number[dof[c]]].areMany ? 1 : 0;
      forEachRun(c,
        [&](std::uint64_t run, std::uint64_t slot) { foreign |= IsSet(run) & IsSet(run ^ slot); });
      patch.row[c] = static_cast<Local>(foreign == 0 ? number[dof[c]] : rows++);
      if (foreign != 0)
      {
        this->AddExtras(A, order, dof[c], c, number, patch);
      }
    }
    patch.extras = static_cast<Index>(extras.size()) - patch.firstExtra;
    fits = fits && rows <= std::numeric_limits<Local>::max();
  }

  void AddExtras(const SparseMatrix& A, const PatchOrder& order, Index row, int corner,
    const std::vector<Index>& number, const Patch& patch)
  {
    ForEachPlace(A, order.corner, row,
      [&](Id k, unsigned place)
      {
        const auto column = static_cast<Local>(number[A.column[k]]);
        if (patch.slot[SlotOf(corner, place)] != column)
        {
          extras.push_back({ 0.0f, static_cast<Local>(corner), column });
        }
      });
  }

  std::vector<Neighbors> neighbors_; // of own unknowns, by their number
};

StencilBlocks::StencilBlocks(const SparseMatrix& A, const PatchOrder& order, int threads)
{
  patches_.resize(order.dof.Count());
  patternFits_ = order.dof.size == N && static_cast<Index>(order.corner.size()) == A.rows;
  if (patternFits_ && this->FillFactors(A, order, threads))
  {
    patternFits_ = this->Lay(A, order, threads);
  }
  if (patternFits_ && !blocks_.empty())
  {
    this->FillRows(A, order, threads);
  }
  else
  {
    blocks_.clear();
  }
}

bool StencilBlocks::Refill(const SparseMatrix& A, const PatchOrder& order, int threads)
{
  const bool fits = this->FillFactors(A, order, threads);
  if (fits)
  {
    this->FillRows(A, order, threads);
  }
  return fits;
}

bool StencilBlocks::Lay(const SparseMatrix& A, const PatchOrder& order, int threads)
{
  const Id blocks = static_cast<Id>(order.blockBegin.size()) - 1;
  std::vector<std::vector<Index>> number(NumberOfThreads(threads));
  std::vector<std::unique_ptr<Draft>> drafts(std::max<Id>(blocks, 0));
  std::atomic<bool> fits{ true };
  ParallelBlocks(blocks, threads,
    [&](Id b, int thread)
    {
      if (!fits)
      {
        return;
      }
      number[thread].resize(A.rows, 0);
      drafts[b] = std::make_unique<Draft>(
        A, order, order.blockBegin[b], order.blockBegin[b + 1], number[thread], patches_.data());
      if (!drafts[b]->fits)
      {
        fits = false;
      }
    });
  if (!fits)
  {
    return false;
  }
  Id unknowns = 0;
  Id own = 0;
  Id rows = 0;
  std::vector<Id> firstExtra(blocks);
  Id extras = 0;
  for (Id b = 0; b < blocks; ++b)
  {
    const Draft& draft = *drafts[b];
    blocks_.push_back({ unknowns, rows, draft.own, static_cast<Index>(draft.unknowns.size()) });
    unknowns += blocks_.back().count;
    own += draft.own;
    rows += draft.rows;
    firstExtra[b] = extras;
    extras += static_cast<Id>(draft.extras.size());
  }
  if (rows > 2 * own + blocks || extras > std::numeric_limits<Index>::max())
  {
    return false;
  }
  unknowns_.resize(unknowns);
  rows_.resize(rows);
  extras_.resize(extras);
  ParallelBlocks(blocks, threads,
    [&](Id b)
    {
      std::copy(drafts[b]->unknowns.begin(), drafts[b]->unknowns.end(),
        unknowns_.data() + blocks_[b].firstUnknown);
      std::copy(drafts[b]->extras.begin(), drafts[b]->extras.end(), extras_.data() + firstExtra[b]);
      for (Id p = order.blockBegin[b]; p < order.blockBegin[b + 1]; ++p)
      {
        patches_[p].firstExtra += static_cast<Index>(firstExtra[b]);
      }
    });
  return true;
}

/// Fills weights and factors.
/// @return whether single precision resolves enough of the patches
bool StencilBlocks::FillFactors(const SparseMatrix& A, const PatchOrder& order, int threads)
{
  const BlockSource source(A, threads);
  weight_.resize(source.row.size());
  std::transform(source.row.begin(), source.row.end(), weight_.begin(), RangeWeight);
  if (std::all_of(weight_.begin(), weight_.end(), [](double weight) { return weight == 1.0; }))
  {
    weight_.clear();
  }
  std::vector<char> isResolved(patches_.size());
  ParallelRanges(
    this->NumberOfPatches(), threads,
    [&](Id begin, Id end)
    {
      ForEachFactor(source, order.dof, begin, end, PrecisionTraits<float>::SmallestPatchPivot,
        [&](Id p, const PatchFactor& factor)
        { isResolved[p] = this->SetFactor(factor, order.dof[p], patches_[p]) ? 1 : 0; });
    },
    PatchesPerBlock);
  unresolved_.clear();
  for (Id p = 0; p < this->NumberOfPatches(); ++p)
  {
    if (isResolved[p] == 0)
    {
      unresolved_.push_back(p);
    }
  }
  return double(unresolved_.size()) <= UnresolvedShare * double(this->NumberOfPatches());
}

/// Stores the factor of a patch, without directions that single precision does not resolve.
/// @return whether single precision resolves all directions
bool StencilBlocks::SetFactor(const PatchFactor& factor, UnknownGroup dof, Patch& patch) const
{
  std::array<double, N> weight;
  for (int i = 0; i < N; ++i)
  {
    weight[i] = this->WeightOf(factor.dof[i]);
    const auto found = std::find(dof.begin(), dof.end(), factor.dof[i]);
    patch.corner[i] = static_cast<std::uint8_t>(found != dof.end() ? found - dof.begin() : 0);
  }
  for (int k = 0; k < N * N; ++k)
  {
    // In the lower triangle, column j belongs to unknown j. The upper triangle is its mirror image.
    patch.factor[k] = static_cast<float>(factor.V.data()[k] * weight[std::min(k / N, k % N)]);
  }
  return factor.isComplete;
}

float StencilBlocks::EntryOf(const SparseMatrix& A, Index row, Id k) const
{
  return static_cast<float>(
    weight_.empty() ? A.value[k] : A.value[k] / weight_[row] / weight_[A.column[k]]);
}

void StencilBlocks::FillRows(const SparseMatrix& A, const PatchOrder& order, int threads)
{
  scaled_.assign(blocks_.size(), {});
  ParallelBlocks(static_cast<Id>(blocks_.size()), threads,
    [&](Id b)
    {
      const Block& block = blocks_[b];
      StencilRow* const rows = rows_.data() + block.firstRow;
      const Index* const unknowns = this->Unknowns(block);
      for (Index i = 1; !weight_.empty() && i < block.count; ++i)
      {
        if (weight_[unknowns[i]] != 1.0)
        {
          scaled_[b].push_back({ i, weight_[unknowns[i]] });
        }
      }
      rows[0].value.fill(0.0f);
      for (Index i = 1; i <= block.own; ++i)
      {
        rows[i].value.fill(0.0f);
        ForEachPlace(A, order.corner, unknowns[i],
          [&](Id k, unsigned place) { rows[i].value[place] = this->EntryOf(A, unknowns[i], k); });
      }
      for (Id p = order.blockBegin[b]; p < order.blockBegin[b + 1]; ++p)
      {
        Patch& patch = patches_[p];
        for (int i = 0; i < N; ++i)
        {
          patch.unknown[i] = patch.slot[OwnSlot(patch.corner[i])];
        }
        this->FillOwnRows(A, order, block, patch);
      }
    });
}

/// Fills the rows that a patch does not share with the block. Entries whose column has no slot
/// become extras.
void StencilBlocks::FillOwnRows(
  const SparseMatrix& A, const PatchOrder& order, const Block& block, const Patch& patch)
{
  Extra* extra = extras_.data() + patch.firstExtra;
  for (int c = 0; c < N && patch.extras > 0; ++c)
  {
    if (patch.row[c] <= block.own)
    {
      continue;
    }
    StencilRow& row = rows_[block.firstRow + patch.row[c]];
    row.value.fill(0.0f);
    const Index* const unknowns = this->Unknowns(block);
    const Index own = unknowns[patch.slot[OwnSlot(c)]];
    ForEachPlace(A, order.corner, own,
      [&](Id k, unsigned place)
      {
        const float value = this->EntryOf(A, own, k);
        if (unknowns[patch.slot[SlotOf(c, place)]] == A.column[k])
        {
          row.value[place] = value;
          return;
        }
        (extra++)->value = value;
      });
  }
}

std::size_t StencilBlocks::Memory() const
{
  std::size_t bytes = blocks_.size() * sizeof(Block) + unknowns_.size() * sizeof(Index) +
                      rows_.size() * sizeof(StencilRow) + patches_.size() * sizeof(Patch) +
                      extras_.size() * sizeof(Extra) + weight_.size() * sizeof(double) +
                      scaled_.size() * sizeof(std::vector<Scaled>);
  for (const std::vector<Scaled>& scaled : scaled_)
  {
    bytes += scaled.capacity() * sizeof(Scaled);
  }
  return bytes;
}

} // namespace gridfem
