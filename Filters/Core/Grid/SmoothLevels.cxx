#include "Grid/SmoothLevels.h"

#include "Base/Errors.h"
#include "Base/Grouping.h"
#include "Base/RadixSort.h"
#include "Base/UnionFind.h"

namespace gridfem
{
namespace
{

constexpr int Count = SmoothFunctionsPerPatch;

/// Returns the number of a function in a patch whose offset along each axis is the corner's bit
/// plus the shift's bit. The trilinear function at this corner has its support inside this
/// function's support.
int FunctionAround(int corner, int shift)
{
  int number = 0;
  for (int axis = 2; axis >= 0; --axis)
  {
    number = 3 * number + ((corner >> axis) & 1) + ((shift >> axis) & 1);
  }
  return number;
}

/// Makes one set per connected component of a support. Two patches in a support that share an edge
/// also share a corner in its interior. The trilinear functions of that corner are equal exactly if
/// the patches are connected around it, and these cells lie in the support. The trilinear functions
/// at the inner corners of a support therefore determine which of its patches are connected.
void UniteAroundCorners(const PatchLevel& level, int threads, UnionFind& slots)
{
  const Groups places = GroupItems(level.dof.empty() ? nullptr : level.dof.front().data(),
    FunctionsPerPatch * level.NumberOfPatches(), level.numberOfFunctions, threads);
  ParallelRanges(level.numberOfFunctions, threads,
    [&](Id begin, Id end)
    {
      const auto slotOf = [&](Index k, int shift)
      {
        const Index place = places.item[k];
        return Count * (place / FunctionsPerPatch) +
               FunctionAround(place % FunctionsPerPatch, shift);
      };
      for (Id f = begin; f < end; ++f)
      {
        for (Index k = places.begin[f] + 1; k < places.begin[f + 1]; ++k)
        {
          for (int shift = 0; shift < 8; ++shift)
          {
            slots.Unite(slotOf(k - 1, shift), slotOf(k, shift));
          }
        }
      }
    });
}

/// Makes one set per support.
void UniteByPlace(const PatchLevel& level, int threads, UnionFind& slots)
{
  const Array<SortEntry> entries =
    SortByKey(level.NumberOfPatches(), 3 * (level.depth + 2), threads,
      [&](Id begin, Id end, const auto& add)
      {
        for (Id patch = begin; patch < end; ++patch)
        {
          const CellIndex cell = MortonDecode(level.cell[patch]);
          for (int k = 0; k < Count; ++k)
          {
            add(MortonEncode({ cell[0] + k % 3, cell[1] + k / 3 % 3, cell[2] + k / 9 }),
              Count * patch + k);
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

SmoothLevel NumberSmoothFunctions(const PatchLevel& level, FunctionSupport support, int threads)
{
  RequireIndices(double(Count) * double(level.NumberOfPatches()), "functions of patches");
  UnionFind slots(Count * level.NumberOfPatches(), threads);
  if (support == FunctionSupport::Plain)
  {
    UniteByPlace(level, threads, slots);
  }
  else
  {
    UniteAroundCorners(level, threads, slots);
  }
  SmoothLevel smooth;
  smooth.depth = level.depth;
  smooth.cell = level.cell;
  smooth.parent = level.parent;
  const Array<Index> number = NumberSets(slots, smooth.numberOfFunctions, threads);
  smooth.dof.resize(level.cell.size());
  for (std::size_t slot = 0; slot < number.size(); ++slot)
  {
    smooth.dof[slot / Count][slot % Count] = number[slot];
  }
  return smooth;
}

} // namespace

std::vector<SmoothLevel> BuildSmoothLevels(const GridFunctions& grid, const Job& job)
{
  std::vector<SmoothLevel> levels;
  for (const PatchLevel& level : grid.levels)
  {
    levels.push_back(NumberSmoothFunctions(level, grid.support, job.threads));
    job.Check(double(levels.size()) / double(grid.levels.size()));
  }
  return levels;
}

} // namespace gridfem
