#include "Links.h"

#include "Parallel.h"

#include <algorithm>
#include <atomic>
#include <limits>

namespace gridfem
{

namespace
{

/// Links of one edge with more than two uses. `pieces` is sorted and unique, so by cell.
void LinkStar(
  const std::vector<Id>& pieces, const std::vector<Id>& pieceCell, std::vector<PieceLink>& links)
{
  std::vector<Id> firstOfCell;
  for (const Id piece : pieces)
  {
    if (!firstOfCell.empty() && pieceCell[firstOfCell.back()] == pieceCell[piece])
    {
      links.push_back({ firstOfCell.back(), piece });
      continue;
    }
    for (const Id other : firstOfCell)
    {
      links.push_back({ other, piece });
    }
    firstOfCell.push_back(piece);
  }
}

} // namespace

void LinkByEdges(const std::vector<std::vector<EdgeUse>>& uses, Id numberOfEdges,
  const std::vector<Id>& pieceCell, int threads, std::vector<PieceLink>& links)
{
  // The lowest piece and the number of uses of each edge: both are independent of the order in
  // which threads arrive.
  std::vector<std::atomic<Id>> lowest(numberOfEdges);
  std::vector<std::atomic<int>> count(numberOfEdges);
  const Id blocks = static_cast<Id>(uses.size());
  ParallelRanges(numberOfEdges, threads,
    [&](Id begin, Id end)
    {
      for (Id e = begin; e < end; ++e)
      {
        lowest[e].store(std::numeric_limits<Id>::max(), std::memory_order_relaxed);
        count[e].store(0, std::memory_order_relaxed);
      }
    });
  ParallelBlocks(blocks, threads,
    [&](Id b)
    {
      for (const EdgeUse& use : uses[b])
      {
        count[use.edge].fetch_add(1, std::memory_order_relaxed);
        Id known = lowest[use.edge].load(std::memory_order_relaxed);
        while (use.piece < known &&
               !lowest[use.edge].compare_exchange_weak(known, use.piece, std::memory_order_relaxed))
        {
        }
      }
    });
  std::vector<std::vector<PieceLink>> pairs(blocks);
  std::vector<std::vector<EdgeUse>> shared(blocks);
  ParallelBlocks(blocks, threads,
    [&](Id b)
    {
      for (const EdgeUse& use : uses[b])
      {
        const Id other = lowest[use.edge].load(std::memory_order_relaxed);
        if (count[use.edge].load(std::memory_order_relaxed) > 2)
        {
          shared[b].push_back(use);
        }
        else if (other != use.piece)
        {
          pairs[b].push_back({ other, use.piece });
        }
      }
    });
  std::vector<EdgeUse> stars;
  for (Id b = 0; b < blocks; ++b)
  {
    links.insert(links.end(), pairs[b].begin(), pairs[b].end());
    stars.insert(stars.end(), shared[b].begin(), shared[b].end());
  }
  std::sort(stars.begin(), stars.end(),
    [](const EdgeUse& a, const EdgeUse& b)
    { return a.edge != b.edge ? a.edge < b.edge : a.piece < b.piece; });
  std::vector<Id> pieces;
  for (std::size_t k = 0; k < stars.size(); ++k)
  {
    if (pieces.empty() || pieces.back() != stars[k].piece)
    {
      pieces.push_back(stars[k].piece);
    }
    if (k + 1 == stars.size() || stars[k + 1].edge != stars[k].edge)
    {
      LinkStar(pieces, pieceCell, links);
      pieces.clear();
    }
  }
}

} // namespace gridfem
