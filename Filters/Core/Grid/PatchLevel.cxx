#include "Grid/PatchLevel.h"

#include "Base/Errors.h"
#include "Base/RadixSort.h"
#include "Base/UnionFind.h"

#include <algorithm>

namespace gridfem
{

namespace
{

/// Returns the number of the corner of `cell` at the lattice point `corner`, or -1 if it has none
/// there.
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

/// Makes one set per component of a corner's support: linked patches share the functions of their
/// common corners. Slot 8 p + c is corner c of patch p.
void UniteAlongLinks(
  const std::vector<MortonKey>& cell, const Array<Link>& links, int threads, UnionFind& slots)
{
  ParallelRanges(static_cast<Id>(links.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id k = begin; k < end; ++k)
      {
        const CellIndex first = MortonDecode(cell[links[k].first]);
        const CellIndex second = MortonDecode(cell[links[k].second]);
        for (int corner = 0; corner < FunctionsPerPatch; ++corner)
        {
          const int other = CornerOf(second, LatticePoint(first, corner));
          if (other >= 0)
          {
            slots.Unite(FunctionsPerPatch * links[k].first + corner,
              FunctionsPerPatch * links[k].second + other);
          }
        }
      }
    });
}

/// Makes one set per lattice point.
void UniteByCorner(const std::vector<MortonKey>& cell, int depth, int threads, UnionFind& slots)
{
  const Array<SortEntry> entries = SortByKey(static_cast<Id>(cell.size()), 3 * (depth + 1), threads,
    [&](Id begin, Id end, const auto& add)
    {
      for (Id patch = begin; patch < end; ++patch)
      {
        const CellIndex index = MortonDecode(cell[patch]);
        for (int corner = 0; corner < FunctionsPerPatch; ++corner)
        {
          add(MortonEncode(LatticePoint(index, corner)), FunctionsPerPatch * patch + corner);
        }
      }
    });
  for (std::size_t k = 1; k < entries.size(); ++k)
  {
    if (entries[k].key == entries[k - 1].key)
    {
      slots.Unite(static_cast<Index>(entries[k - 1].item), static_cast<Index>(entries[k].item));
    }
  }
}

/// Numbers the functions of a level whose cells are known.
void NumberFunctions(
  PatchLevel& level, const Array<Link>& links, FunctionSupport support, int threads)
{
  RequireIndices(double(FunctionsPerPatch) * level.NumberOfPatches(), "corners of patches");
  UnionFind slots(FunctionsPerPatch * level.NumberOfPatches(), threads);
  if (support == FunctionSupport::Plain)
  {
    UniteByCorner(level.cell, level.depth, threads, slots);
  }
  else
  {
    UniteAlongLinks(level.cell, links, threads, slots);
  }
  const Array<Index> number = NumberSets(slots, level.numberOfFunctions, threads);
  level.dof.resize(level.cell.size());
  for (std::size_t slot = 0; slot < number.size(); ++slot)
  {
    level.dof[slot / FunctionsPerPatch][slot % FunctionsPerPatch] = number[slot];
  }
}

/// Fills `fine.parent` and returns the level of the parents, without functions.
PatchLevel GroupToParents(
  PatchLevel& fine, const Array<Link>& links, FunctionSupport support, int threads)
{
  UnionFind sets(fine.NumberOfPatches(), threads);
  if (support == FunctionSupport::Plain)
  {
    for (Index patch = 1; patch < fine.NumberOfPatches(); ++patch)
    {
      if (fine.cell[patch] >> 3 == fine.cell[patch - 1] >> 3)
      {
        sets.Unite(patch - 1, patch);
      }
    }
  }
  else
  {
    for (const Link& link : links)
    {
      if (fine.cell[link.first] >> 3 == fine.cell[link.second] >> 3)
      {
        sets.Unite(link.first, link.second);
      }
    }
  }
  Index count = 0;
  fine.parent = NumberSets(sets, count, threads);
  PatchLevel coarse;
  coarse.depth = fine.depth - 1;
  coarse.cell.resize(count);
  for (Id patch = 0; patch < fine.NumberOfPatches(); ++patch)
  {
    coarse.cell[fine.parent[patch]] = fine.cell[patch] >> 3;
  }
  return coarse;
}

} // namespace

PatchLevel BuildFinestLevel(
  int depth, const PatchPartition& patches, FunctionSupport support, int threads)
{
  PatchLevel level;
  level.depth = depth;
  level.cell = patches.cell;
  NumberFunctions(level, patches.links, support, threads);
  return level;
}

std::vector<PatchLevel> BuildLevels(
  PatchLevel finest, Array<Link> links, FunctionSupport support, const Job& job)
{
  std::vector<PatchLevel> levels;
  levels.push_back(std::move(finest));
  const int depth = levels.front().depth;
  while (levels.back().depth > 0)
  {
    job.Check(1.0 - double(levels.back().depth) / depth);
    PatchLevel coarse = GroupToParents(levels.back(), links, support, job.threads);
    links = LinksOfGroups(links, levels.back().parent, job.threads);
    NumberFunctions(coarse, links, support, job.threads);
    levels.push_back(std::move(coarse));
  }
  return levels;
}

template<int Functions>
std::vector<Index> FunctionComponents(const BasicPatchLevel<Functions>& level, int threads)
{
  UnionFind sets(level.numberOfFunctions, threads);
  ParallelRanges(level.NumberOfPatches(), threads,
    [&](Id begin, Id end)
    {
      for (Id patch = begin; patch < end; ++patch)
      {
        const auto& dof = level.dof[patch];
        for (int k = 1; k < Functions; ++k)
        {
          sets.Unite(dof[0], dof[k]);
        }
      }
    });
  Index count = 0;
  const Array<Index> number = NumberSets(sets, count, threads);
  return { number.begin(), number.end() };
}

template std::vector<Index> FunctionComponents(const PatchLevel&, int);
template std::vector<Index> FunctionComponents(const SmoothLevel&, int);

Index NumberOfComponents(const std::vector<Index>& component)
{
  return component.empty() ? 0 : *std::max_element(component.begin(), component.end()) + 1;
}

template<int Functions>
Index LargestComponent(const BasicPatchLevel<Functions>& level, int threads)
{
  const std::vector<Index> component = FunctionComponents(level, threads);
  std::vector<Index> size(NumberOfComponents(component), 0);
  for (const Index own : component)
  {
    ++size[own];
  }
  return size.empty() ? 0 : *std::max_element(size.begin(), size.end());
}

template Index LargestComponent(const PatchLevel&, int);
template Index LargestComponent(const SmoothLevel&, int);

} // namespace gridfem
