#include "Grouping.h"
#include "Level.h"
#include "Parallel.h"
#include "UnionFind.h"

#include <algorithm>
#include <numeric>

namespace gridfem
{

namespace
{

/// Patches of less area, in cell faces, come from rounding.
constexpr double SmallestArea = 1e-10;

/// Patch of every piece, numbered by the first piece: so by Morton key.
std::vector<Id> GroupPieces(const ClippedMesh& clipped, FunctionSupport support, Id& count)
{
  if (support == FunctionSupport::Plain)
  {
    count = static_cast<Id>(clipped.cells.size());
    return clipped.pieceCell;
  }
  UnionFind sets(clipped.NumberOfPieces());
  for (const PieceLink& link : clipped.links)
  {
    if (clipped.pieceCell[link.first] == clipped.pieceCell[link.second])
    {
      sets.Unite(link.first, link.second);
    }
  }
  return NumberSets<Id>(sets, count);
}

std::vector<double> PatchAreas(
  const ClippedMesh& clipped, const std::vector<Id>& piecePatch, Id numberOfPatches, int threads)
{
  std::vector<double> pieceArea(piecePatch.size());
  ParallelRanges(clipped.NumberOfPieces(), threads,
    [&](Id begin, Id end)
    {
      for (Id piece = begin; piece < end; ++piece)
      {
        pieceArea[piece] = PieceArea(clipped, piece);
      }
    });
  std::vector<double> area(numberOfPatches, 0.0);
  for (std::size_t piece = 0; piece < piecePatch.size(); ++piece)
  {
    area[piecePatch[piece]] += pieceArea[piece];
  }
  return area;
}

/// For every patch the patch it becomes part of: itself, or for a sliver the lowest patch that is
/// none and that it touches, over other slivers if need be. Slivers that touch none stay.
std::vector<Id> AbsorbSlivers(
  const ClippedMesh& clipped, const std::vector<Id>& piecePatch, const std::vector<double>& area)
{
  std::vector<Id> target(area.size());
  bool open = false;
  for (std::size_t patch = 0; patch < area.size(); ++patch)
  {
    target[patch] = area[patch] < SmallestArea ? -1 : static_cast<Id>(patch);
    open |= target[patch] < 0;
  }
  std::vector<PatchLink> links;
  for (const PieceLink& link : clipped.links)
  {
    const Id a = piecePatch[link.first];
    const Id b = piecePatch[link.second];
    if (open && a != b && (target[a] < 0 || target[b] < 0))
    {
      links.push_back({ a, b });
    }
  }
  while (open)
  {
    std::vector<Id> next = target;
    const auto offer = [&](Id sliver, Id patch)
    {
      if (target[sliver] < 0 && target[patch] >= 0 &&
          (next[sliver] < 0 || target[patch] < next[sliver]))
      {
        next[sliver] = target[patch];
      }
    };
    for (const PatchLink& link : links)
    {
      offer(link.first, link.second);
      offer(link.second, link.first);
    }
    open = next != target;
    target = std::move(next);
  }
  for (std::size_t patch = 0; patch < target.size(); ++patch)
  {
    target[patch] = target[patch] < 0 ? static_cast<Id>(patch) : target[patch];
  }
  return target;
}

} // namespace

PatchPartition BuildPatches(const ClippedMesh& clipped, FunctionSupport support, int threads)
{
  PatchPartition patches;
  Id count = 0;
  patches.piecePatch = GroupPieces(clipped, support, count);
  std::vector<MortonKey> cell(count);
  for (std::size_t piece = 0; piece < patches.piecePatch.size(); ++piece)
  {
    cell[patches.piecePatch[piece]] = clipped.cells[clipped.pieceCell[piece]];
  }
  const std::vector<Id> target = AbsorbSlivers(
    clipped, patches.piecePatch, PatchAreas(clipped, patches.piecePatch, count, threads));
  std::vector<Id> number(count, -1);
  for (Id patch = 0; patch < count; ++patch)
  {
    if (target[patch] == patch)
    {
      number[patch] = static_cast<Id>(patches.cell.size());
      patches.cell.push_back(cell[patch]);
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
  patches.links = LinksOfPatches(clipped.links, patches.piecePatch);
  return patches;
}

std::vector<PatchLink> LinksOfPatches(
  const std::vector<PieceLink>& links, const std::vector<Id>& piecePatch)
{
  std::vector<PatchLink> patchLinks;
  for (const PieceLink& link : links)
  {
    const Id a = piecePatch[link.first];
    const Id b = piecePatch[link.second];
    const PatchLink ordered{ std::min(a, b), std::max(a, b) };
    if (a != b && (patchLinks.empty() || !(patchLinks.back() == ordered)))
    {
      patchLinks.push_back(ordered);
    }
  }
  SortUnique(patchLinks);
  return patchLinks;
}

void SortUnique(std::vector<PatchLink>& links)
{
  const Id patches = std::accumulate(links.begin(), links.end(), Id{ 0 },
    [](Id most, const PatchLink& link) { return std::max(most, link.first + 1); });
  std::vector<Id> group(links.size());
  std::transform(
    links.begin(), links.end(), group.begin(), [](const PatchLink& link) { return link.first; });
  const Groups byFirst = GroupItems(group, patches);
  std::vector<PatchLink> sorted;
  sorted.reserve(links.size());
  std::vector<Id> seconds;
  for (Id first = 0; first < patches; ++first)
  {
    seconds.clear();
    for (Id k = byFirst.begin[first]; k < byFirst.begin[first + 1]; ++k)
    {
      seconds.push_back(links[byFirst.item[k]].second);
    }
    std::sort(seconds.begin(), seconds.end());
    seconds.erase(std::unique(seconds.begin(), seconds.end()), seconds.end());
    for (const Id second : seconds)
    {
      sorted.push_back({ first, second });
    }
  }
  links = std::move(sorted);
}

} // namespace gridfem
