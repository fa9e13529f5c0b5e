#include "Level.h"

#include "Errors.h"
#include "RadixSort.h"
#include "UnionFind.h"

#include <limits>

namespace gridfem
{

namespace
{

/// Corner of `cell` that is the lattice point `corner`, or -1.
int CornerOf(const CellIndex& cell, const CellIndex& corner)
{
  int number = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int offset = corner[axis] - cell[axis];
    if (offset != 0 && offset != 1)
    {
      return -1;
    }
    number |= offset << axis;
  }
  return number;
}

CellIndex LatticePoint(const CellIndex& cell, int corner)
{
  return { cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2 & 1) };
}

/// One set per component of a corner's support: linked patches share the functions of the corners
/// they have in common. Slot 8 p + c is corner c of patch p.
void UniteAlongLinks(
  const std::vector<MortonKey>& cell, const std::vector<PatchLink>& links, UnionFind& slots)
{
  for (const PatchLink& link : links)
  {
    const CellIndex first = MortonDecode(cell[link.first]);
    const CellIndex second = MortonDecode(cell[link.second]);
    for (int corner = 0; corner < FunctionsPerPatch; ++corner)
    {
      const int other = CornerOf(second, LatticePoint(first, corner));
      if (other >= 0)
      {
        slots.Unite(
          FunctionsPerPatch * link.first + corner, FunctionsPerPatch * link.second + other);
      }
    }
  }
}

/// One set per lattice point.
void UniteByCorner(const std::vector<MortonKey>& cell, int depth, UnionFind& slots)
{
  std::vector<SortEntry> entries(cell.size() * FunctionsPerPatch);
  for (std::size_t patch = 0; patch < cell.size(); ++patch)
  {
    const CellIndex index = MortonDecode(cell[patch]);
    for (int corner = 0; corner < FunctionsPerPatch; ++corner)
    {
      const std::size_t slot = FunctionsPerPatch * patch + corner;
      entries[slot] = { MortonEncode(LatticePoint(index, corner)), static_cast<Id>(slot) };
    }
  }
  RadixSort(entries, 3 * (depth + 1));
  for (std::size_t k = 1; k < entries.size(); ++k)
  {
    if (entries[k].key == entries[k - 1].key)
    {
      slots.Unite(entries[k - 1].item, entries[k].item);
    }
  }
}

/// Numbers the functions of a level whose cells are known.
void NumberFunctions(Level& level, const std::vector<PatchLink>& links, FunctionSupport support)
{
  UnionFind slots(FunctionsPerPatch * level.NumberOfPatches());
  if (support == FunctionSupport::Plain)
  {
    UniteByCorner(level.cell, level.depth, slots);
  }
  else
  {
    UniteAlongLinks(level.cell, links, slots);
  }
  Id count = 0;
  const std::vector<Id> number = NumberSets<Id>(slots, count);
  if (count > std::numeric_limits<Index>::max())
  {
    throw InvalidInput("The space has " + std::to_string(count) +
                       " functions, more than can be numbered. Choose a smaller depth.");
  }
  level.numberOfFunctions = static_cast<Index>(count);
  level.dof.resize(level.cell.size());
  for (std::size_t slot = 0; slot < number.size(); ++slot)
  {
    level.dof[slot / FunctionsPerPatch][slot % FunctionsPerPatch] =
      static_cast<Index>(number[slot]);
  }
}

/// Fills `fine.parent`; returns the parents' level without functions.
Level GroupToParents(Level& fine, const std::vector<PatchLink>& links, FunctionSupport support)
{
  UnionFind sets(fine.NumberOfPatches());
  if (support == FunctionSupport::Plain)
  {
    for (Id patch = 1; patch < fine.NumberOfPatches(); ++patch)
    {
      if (fine.cell[patch] >> 3 == fine.cell[patch - 1] >> 3)
      {
        sets.Unite(patch - 1, patch);
      }
    }
  }
  else
  {
    for (const PatchLink& link : links)
    {
      if (fine.cell[link.first] >> 3 == fine.cell[link.second] >> 3)
      {
        sets.Unite(link.first, link.second);
      }
    }
  }
  Id count = 0;
  fine.parent = NumberSets<Id>(sets, count);
  Level coarse;
  coarse.depth = fine.depth - 1;
  coarse.cell.resize(count);
  for (Id patch = 0; patch < fine.NumberOfPatches(); ++patch)
  {
    coarse.cell[fine.parent[patch]] = fine.cell[patch] >> 3;
  }
  return coarse;
}

std::vector<PatchLink> LinksOfParents(
  const std::vector<PatchLink>& links, const std::vector<Id>& parent)
{
  std::vector<PatchLink> coarse;
  for (const PatchLink& link : links)
  {
    const Id a = parent[link.first];
    const Id b = parent[link.second];
    if (a != b)
    {
      coarse.push_back({ std::min(a, b), std::max(a, b) });
    }
  }
  SortUnique(coarse);
  return coarse;
}

} // namespace

Level BuildFinestLevel(int depth, const PatchPartition& patches, FunctionSupport support)
{
  Level level;
  level.depth = depth;
  level.cell = patches.cell;
  NumberFunctions(level, patches.links, support);
  return level;
}

std::vector<Level> BuildLevels(
  Level finest, std::vector<PatchLink> links, FunctionSupport support, const Progress& progress)
{
  std::vector<Level> levels;
  levels.push_back(std::move(finest));
  const int depth = levels.front().depth;
  while (levels.back().depth > 0)
  {
    progress.Check(1.0 - double(levels.back().depth) / depth);
    Level coarse = GroupToParents(levels.back(), links, support);
    links = LinksOfParents(links, levels.back().parent);
    NumberFunctions(coarse, links, support);
    levels.push_back(std::move(coarse));
  }
  return levels;
}

std::vector<Index> FunctionComponents(const Level& level)
{
  UnionFind sets(level.numberOfFunctions);
  for (const auto& dof : level.dof)
  {
    for (int corner = 1; corner < FunctionsPerPatch; ++corner)
    {
      sets.Unite(dof[0], dof[corner]);
    }
  }
  Id count = 0;
  return NumberSets<Index>(sets, count);
}

} // namespace gridfem
