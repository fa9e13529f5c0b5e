#include "Grid/MergePieces.h"

#include "Base/Parallel.h"
#include "Base/RadixSort.h"
#include "Grid/CutPoints.h"

#include <algorithm>

namespace gridfem
{

namespace
{

/// Throws InvalidInput when all blocks together have too many items.
void RequireTotal(const std::vector<ClipBlock>& blocks, Index ClipBlock::*count, const char* what)
{
  double total = 0.0;
  for (const ClipBlock& block : blocks)
  {
    total += block.*count;
  }
  RequireIndices(total, what);
}

/// Returns the position of each block's items after joining, and the total at the end.
std::vector<Index> BlockOffsets(
  const std::vector<ClipBlock>& blocks, Index ClipBlock::*count, const char* what)
{
  RequireTotal(blocks, count, what);
  std::vector<Index> begin;
  begin.reserve(blocks.size() + 1);
  for (const ClipBlock& block : blocks)
  {
    begin.push_back(block.*count);
  }
  begin.push_back(0);
  ExclusiveScan(begin);
  return begin;
}

/// Appends the interior points of all blocks, and replaces their temporary ids in the corners of
/// pieces.
void AppendInteriorPoints(
  const ClipInput& input, const std::vector<ClipBlock>& blocks, int threads, ClippedMesh& clipped)
{
  const std::vector<Index> begin =
    BlockOffsets(blocks, &ClipBlock::interiors, "points of the clipped mesh");
  const auto first = static_cast<Index>(clipped.position.size());
  RequireIndices(double(first) + begin.back(), "points of the clipped mesh");
  // Reserve first, because resize() alone would double the capacity.
  clipped.cutPoints.reserve(clipped.cutPoints.size() + begin.back());
  clipped.cutPoints.resize(clipped.cutPoints.size() + begin.back());
  clipped.position.reserve(clipped.position.size() + begin.back());
  clipped.position.resize(clipped.position.size() + begin.back());
  ParallelBlocks(static_cast<Id>(blocks.size()), threads,
    [&](Id b)
    {
      const ClipBlock& block = blocks[b];
      for (Index k = 0; k < block.interiors; ++k)
      {
        const CutPoint& cut = block.store->interior[block.firstInterior + k];
        PlaceCutPoint(first + begin[b] + k, cut, input, clipped);
      }
      const Index zero = first + begin[b] - block.firstInterior - 1;
      for (Index k = block.firstCorner; k < block.firstCorner + block.corners; ++k)
      {
        Index& corner = block.store->corner[k];
        corner = corner >= 0 ? corner : zero - corner;
      }
    });
}

/// Returns the numbers of all pieces, sorted by cell.
Array<SortEntry> SortPieces(ClippedTriangles& parts, int depth, int threads)
{
  constexpr Id BlocksPerRange = 4;
  Array<SortEntry> entries = SortByKey(
    static_cast<Id>(parts.blocks.size()), 3 * depth, threads,
    [&](Id begin, Id end, const auto& add)
    {
      for (Id b = begin; b < end; ++b)
      {
        const ClipBlock& block = parts.blocks[b];
        for (Index piece = block.firstPiece; piece < block.firstPiece + block.pieces; ++piece)
        {
          add(block.store->key[piece], block.store->NumberOf(piece));
        }
      }
    },
    BlocksPerRange);
  for (ClipBuffer& store : parts.stores)
  {
    Release(store.key);
  }
  return entries;
}

/// Lists the cells that contain the sorted pieces.
void ListCells(const Array<SortEntry>& entries, int threads, ClippedMesh& clipped)
{
  const Id count = static_cast<Id>(entries.size());
  const auto isFirst = [&](Id k) { return k == 0 || entries[k].key != entries[k - 1].key; };
  std::vector<Index> firstCell((count + DefaultBlockSize - 1) / DefaultBlockSize + 1, 0);
  ParallelRanges(count, threads,
    [&](Id begin, Id end)
    {
      for (Id k = begin; k < end; ++k)
      {
        firstCell[begin / DefaultBlockSize] += isFirst(k) ? 1 : 0;
      }
    });
  const Index cells = ExclusiveScan(firstCell);
  clipped.cells.resize(cells);
  clipped.cellBegin.resize(cells + 1);
  clipped.cellBegin[cells] = static_cast<Index>(count);
  ParallelRanges(count, threads,
    [&](Id begin, Id end)
    {
      Index cell = firstCell[begin / DefaultBlockSize];
      for (Id k = begin; k < end; ++k)
      {
        if (isFirst(k))
        {
          clipped.cells[cell] = entries[k].key;
          clipped.cellBegin[cell++] = static_cast<Index>(k);
        }
      }
    });
}

/// Finds a piece by its number.
class PieceFinder
{
public:
  struct Found
  {
    const ClipBuffer* store;
    Index piece;
  };

  explicit PieceFinder(const std::vector<ClipBuffer>& stores)
  {
    std::size_t chunks = 0;
    for (const ClipBuffer& store : stores)
    {
      chunks += store.chunk.size();
    }
    chunks_.resize(chunks);
    for (const ClipBuffer& store : stores)
    {
      for (std::size_t k = 0; k < store.chunk.size(); ++k)
      {
        chunks_[store.chunk[k]] = { &store, static_cast<Index>(k) * PiecesPerChunk };
      }
    }
  }

  /// All numbers are below this bound.
  Id Bound() const { return static_cast<Id>(chunks_.size()) * PiecesPerChunk; }

  Found operator()(Id number) const
  {
    const Found& chunk = chunks_[number / PiecesPerChunk];
    return { chunk.store, chunk.piece + static_cast<Index>(number % PiecesPerChunk) };
  }

private:
  std::vector<Found> chunks_; // the first piece of each chunk
};

/// Copies the pieces in their sorted order.
/// @return the index of each piece in the clipped mesh, by the piece's number
Array<Index> CopyPieces(
  const PieceFinder& find, const Array<SortEntry>& entries, int threads, ClippedMesh& clipped)
{
  const Id count = static_cast<Id>(entries.size());
  Array<Index> place(find.Bound());
  clipped.pieceTriangle.resize(count);
  clipped.pieceBegin.resize(count + 1);
  ParallelRanges(count, threads,
    [&](Id begin, Id end)
    {
      for (Id k = begin; k < end; ++k)
      {
        const auto [store, piece] = find(entries[k].item);
        place[entries[k].item] = static_cast<Index>(k);
        clipped.pieceTriangle[k] = store->triangle[piece];
        clipped.pieceBegin[k] = store->cornerBegin[piece + 1] - store->cornerBegin[piece];
      }
    });
  clipped.pieceBegin[count] = 0;
  clipped.corners.resize(ExclusiveScan(clipped.pieceBegin));
  ParallelRanges(count, threads,
    [&](Id begin, Id end)
    {
      for (Id k = begin; k < end; ++k)
      {
        const auto [store, piece] = find(entries[k].item);
        const Index first = clipped.pieceBegin[k];
        std::copy_n(store->corner.data() + store->cornerBegin[piece],
          clipped.pieceBegin[k + 1] - first, clipped.corners.data() + first);
      }
    });
  return place;
}

/// Copies the links inside triangles.
void PlaceLinks(const std::vector<ClipBlock>& blocks, const Array<Index>& place, int threads,
  ClippedMesh& clipped)
{
  const std::vector<Index> begin = BlockOffsets(blocks, &ClipBlock::links, "links");
  clipped.links.resize(begin.back());
  ParallelBlocks(static_cast<Id>(blocks.size()), threads,
    [&](Id b)
    {
      const ClipBlock& block = blocks[b];
      for (Index k = 0; k < block.links; ++k)
      {
        const Link& link = block.store->links[block.firstLink + k];
        const auto [low, high] = std::minmax(place[link.first], place[link.second]);
        clipped.links[begin[b] + k] = { low, high };
      }
    });
}

} // namespace

Array<Index> JoinPieces(
  ClippedTriangles parts, const ClipInput& input, const Job& job, ClippedMesh& clipped)
{
  RequireTotal(parts.blocks, &ClipBlock::pieces, "pieces");
  RequireTotal(parts.blocks, &ClipBlock::corners, "corners of pieces");
  AppendInteriorPoints(input, parts.blocks, job.threads, clipped);
  for (ClipBuffer& store : parts.stores)
  {
    Release(store.interior);
  }
  job.Check(0.2);
  Array<SortEntry> entries = SortPieces(parts, clipped.grid.depth, job.threads);
  job.Check(0.5);
  ListCells(entries, job.threads, clipped);
  Array<Index> place = CopyPieces(PieceFinder(parts.stores), entries, job.threads, clipped);
  Release(entries);
  job.Check(0.9);
  PlaceLinks(parts.blocks, place, job.threads, clipped);
  job.Check(1.0);
  return place;
}

} // namespace gridfem
