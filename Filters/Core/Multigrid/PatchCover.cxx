#include "Multigrid/PatchCover.h"

#include "Base/Errors.h"

#include <algorithm>
#include <string>

namespace gridfem
{
namespace
{

using Group = std::array<Index, FunctionsPerPatch>;

/// How many patches each unknown still needs: `times`, or as many as there are.
std::vector<int> CountNeeds(const PatchOrder& order, Index unknowns, int times)
{
  std::vector<int> needs(unknowns, 0);
  for (const Group& group : order.dof)
  {
    for (const Index unknown : group)
    {
      if (unknown < -1 || unknown >= unknowns)
      {
        throw InvalidInput(
          "a patch names unknown " + std::to_string(unknown) + " of " + std::to_string(unknowns));
      }
      if (unknown >= 0)
      {
        needs[unknown] = std::min(times, needs[unknown] + 1);
      }
    }
  }
  return needs;
}

/// 1 for the patches that are chosen.
std::vector<char> Choose(const PatchOrder& order, std::vector<int> needs)
{
  std::vector<char> isChosen(order.dof.size(), 0);
  for (int helped = FunctionsPerPatch; helped > 0; --helped)
  {
    for (std::size_t patch = 0; patch < order.dof.size(); ++patch)
    {
      const Group& group = order.dof[patch];
      const auto isInNeed = [&](Index unknown) { return unknown >= 0 && needs[unknown] > 0; };
      if (!isChosen[patch] && std::count_if(group.begin(), group.end(), isInNeed) >= helped)
      {
        isChosen[patch] = 1;
        for (const Index unknown : group)
        {
          needs[std::max(unknown, 0)] -= isInNeed(unknown) ? 1 : 0;
        }
      }
    }
  }
  return isChosen;
}

} // namespace

PatchOrder CoverUnknowns(const PatchOrder& order, Index unknowns, int times)
{
  if (times < 1)
  {
    throw InvalidInput("every unknown must be covered at least once");
  }
  const std::vector<char> isChosen = Choose(order, CountNeeds(order, unknowns, times));
  PatchOrder cover;
  cover.colourBegin = order.colourBegin;
  Id patch = 0;
  for (const Id end : order.blockBegin)
  {
    for (; patch < end; ++patch)
    {
      if (isChosen[patch])
      {
        cover.dof.push_back(order.dof[patch]);
      }
    }
    cover.blockBegin.push_back(static_cast<Id>(cover.dof.size()));
  }
  return cover;
}

} // namespace gridfem
