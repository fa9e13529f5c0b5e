#include "Base/Grouping.h"
#include "Base/Parallel.h"
#include "Base/PerThreadLists.h"
#include "Base/SortEachOnce.h"
#include "Base/UnionFind.h"
#include "Grid/PatchChoice.h"
#include "Grid/PatchLevel.h"

#include <algorithm>

namespace gridfem
{

namespace
{

/// Returns the patch of every piece. Patches are numbered by their first piece, and thus by Morton
/// key.
Array<Index> GroupPieces(const ClippedMesh& clipped, const Array<Index>& pieceCell,
  FunctionSupport support, int threads, Index& count)
{
  if (support == FunctionSupport::Plain)
  {
    count = static_cast<Index>(clipped.cells.size());
    return pieceCell;
  }
  UnionFind sets(clipped.NumberOfPieces(), threads);
  ParallelRanges(static_cast<Id>(clipped.links.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id k = begin; k < end; ++k)
      {
        const auto [first, second] = clipped.links[k];
        if (pieceCell[first] == pieceCell[second])
        {
          sets.Unite(first, second);
        }
      }
    });
  return NumberSets(sets, count, threads);
}

/// Marks the patches that result from rounding.
std::vector<char> FindSlivers(
  const ClippedMesh& clipped, const Array<Index>& piecePatch, Index numberOfPatches, int threads)
{
  const std::vector<double> area = CountedPatchAreas(clipped, piecePatch, numberOfPatches, threads);
  std::vector<char> isSliver(area.size());
  std::transform(area.begin(), area.end(), isSliver.begin(),
    [](double counted) { return counted < SmallestPatchArea; });
  return isSliver;
}

/// Returns for every patch the patch that it joins. A regular patch joins itself. A sliver joins
/// the lowest regular patch that it touches, if need be through other slivers. A sliver that
/// touches none stays.
std::vector<Index> AbsorbSlivers(
  const ClippedMesh& clipped, const Array<Index>& piecePatch, const std::vector<char>& isSliver)
{
  std::vector<Index> target(isSliver.size());
  bool open = false;
  for (std::size_t patch = 0; patch < target.size(); ++patch)
  {
    target[patch] = isSliver[patch] ? -1 : static_cast<Index>(patch);
    open |= isSliver[patch] != 0;
  }
  Array<Link> links;
  for (std::size_t k = 0; open && k < clipped.links.size(); ++k)
  {
    const Index a = piecePatch[clipped.links[k].first];
    const Index b = piecePatch[clipped.links[k].second];
    if (a != b && (target[a] < 0 || target[b] < 0))
    {
      links.emplace_back(a, b);
    }
  }
  while (open)
  {
    std::vector<Index> next = target;
    const auto offer = [&](Index sliver, Index patch)
    {
      if (target[sliver] < 0 && target[patch] >= 0 &&
          (next[sliver] < 0 || target[patch] < next[sliver]))
      {
        next[sliver] = target[patch];
      }
    };
    for (const Link& link : links)
    {
      offer(link.first, link.second);
      offer(link.second, link.first);
    }
    open = next != target;
    target = std::move(next);
  }
  for (std::size_t patch = 0; patch < target.size(); ++patch)
  {
    target[patch] = target[patch] < 0 ? static_cast<Index>(patch) : target[patch];
  }
  return target;
}

/// Sorts links by first, then by second, and removes duplicates, in time linear in the number of
/// links.
Array<Link> SortUnique(const Array<Link>& links, int threads)
{
  Array<Index> group(links.size());
  std::transform(
    links.begin(), links.end(), group.begin(), [](const Link& link) { return link.first; });
  const Id groups = group.empty() ? 0 : Id{ *std::max_element(group.begin(), group.end()) } + 1;
  const Groups byFirst = GroupItems(group.data(), static_cast<Id>(group.size()), groups, threads);
  Array<Link> result;
  AppendRanges(groups, threads, result,
    [&](Id begin, Id end, Array<Link>& sorted)
    {
      std::vector<Index> seconds;
      for (auto first = static_cast<Index>(begin); first < end; ++first)
      {
        seconds.clear();
        for (Index k = byFirst.begin[first]; k < byFirst.begin[first + 1]; ++k)
        {
          seconds.push_back(links[byFirst.item[k]].second);
        }
        SortEachOnce(seconds);
        for (const Index second : seconds)
        {
          sorted.emplace_back(first, second);
        }
      }
    });
  return result;
}

} // namespace

PatchPartition BuildPatches(const ClippedMesh& clipped, FunctionSupport support, int threads)
{
  PatchPartition patches;
  Index count = 0;
  const Array<Index> pieceCell = PieceCells(clipped, threads);
  patches.piecePatch = GroupPieces(clipped, pieceCell, support, threads, count);
  std::vector<Index> cellOfPatch(count);
  for (std::size_t piece = 0; piece < pieceCell.size(); ++piece)
  {
    cellOfPatch[patches.piecePatch[piece]] = pieceCell[piece];
  }
  const std::vector<Index> target = AbsorbSlivers(
    clipped, patches.piecePatch, FindSlivers(clipped, patches.piecePatch, count, threads));
  std::vector<Index> number(count, -1);
  for (Index patch = 0; patch < count; ++patch)
  {
    if (target[patch] == patch)
    {
      number[patch] = static_cast<Index>(patches.cell.size());
      patches.cell.push_back(clipped.cells[cellOfPatch[patch]]);
    }
  }
  ParallelRanges(clipped.NumberOfPieces(), threads,
    [&](Id begin, Id end)
    {
      for (Id piece = begin; piece < end; ++piece)
      {
        patches.piecePatch[piece] = number[target[patches.piecePatch[piece]]];
      }
    });
  patches.links = LinksOfGroups(clipped.links, patches.piecePatch, threads);
  return patches;
}

Array<Link> LinksOfGroups(const Array<Link>& links, const Array<Index>& group, int threads)
{
  const auto groupLinks = [&](Id begin, Id end, Array<Link>& list)
  {
    Link last{ -1, -1 };
    for (Id k = begin; k < end; ++k)
    {
      const auto [low, high] = std::minmax(group[links[k].first], group[links[k].second]);
      const Link link{ low, high };
      if (low != high && !(link == last))
      {
        list.push_back(link);
        last = link;
      }
    }
  };
  Array<Link> ofGroups;
  AppendRanges(static_cast<Id>(links.size()), threads, ofGroups, groupLinks);
  return SortUnique(ofGroups, threads);
}

} // namespace gridfem
