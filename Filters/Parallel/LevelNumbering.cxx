#include "Parallel/LevelNumbering.h"

#include "Base/SortEachOnce.h"

#include <algorithm>
#include <limits>
#include <memory>

namespace gridfem
{

namespace
{

/// A function, identified by one of its patches.
struct PatchCorner
{
  MortonKey cell;
  Index placeInCell;
  Index corner;
};

/// The ranks that functions touch, as far as the patches around this rank's cells show.
class Touching
{
public:
  Touching(const BlockPartition& partition, const PatchLevel& level, int rank)
    : level_(level), own_(OwnPatches(level, partition, rank)),
      owner_(level.numberOfFunctions, NoRank), patch_(level.numberOfFunctions, -1),
      count_(level.numberOfFunctions, 0)
  {
    for (Index patch = own_.first; patch < own_.last; ++patch)
    {
      for (const Index function : level.dof[patch])
      {
        owner_[function] = rank;
        count_[function] = 1;
      }
    }
    for (Index patch = 0; patch < static_cast<Index>(level.cell.size()); ++patch)
    {
      if (patch == own_.first)
      {
        patch = own_.last;
        if (patch == static_cast<Index>(level.cell.size()))
        {
          break;
        }
      }
      this->AddGhost(patch, partition.OwnerOf(level.cell[patch], level.depth));
    }
    SortEachOnce(others_);
    for (const auto& [other, function] : others_)
    {
      ++count_[function];
    }
  }

  bool IsHere(Index function) const { return count_[function] > 0; }
  int OwnerOf(Index function) const { return owner_[function]; }
  Index CountOf(Index function) const { return count_[function]; }

  /// @param place  place of every function in the numbering
  std::vector<RankNeighbor> Neighbors(const std::vector<Index>& place) const
  {
    std::vector<RankNeighbor> neighbors;
    for (const auto& [other, function] : others_)
    {
      if (neighbors.empty() || neighbors.back().rank != other)
      {
        neighbors.push_back({ other, {} });
      }
      neighbors.back().functions.push_back(place[function]);
    }
    for (RankNeighbor& neighbor : neighbors)
    {
      std::sort(neighbor.functions.begin(), neighbor.functions.end());
    }
    return neighbors;
  }

  /// Identifies a function of another rank by a patch in the owner's cells.
  PatchCorner Describe(Index function) const
  {
    const Index patch = patch_[function];
    const auto& dof = level_.dof[patch];
    const auto corner = std::find(dof.begin(), dof.end(), function) - dof.begin();
    return { level_.cell[patch], PlaceInCell(level_, patch), static_cast<Index>(corner) };
  }

private:
  static constexpr int NoRank = std::numeric_limits<int>::max();

  void AddGhost(Index patch, int owner)
  {
    for (const Index function : level_.dof[patch])
    {
      if (!this->IsHere(function))
      {
        continue;
      }
      others_.emplace_back(owner, function);
      if (owner < owner_[function])
      {
        owner_[function] = owner;
        patch_[function] = patch;
      }
    }
  }

  const PatchLevel& level_;
  PatchRange own_;
  std::vector<int> owner_;
  std::vector<Index> patch_;
  std::vector<Index> count_;
  std::vector<std::pair<int, Index>> others_; // other ranks touched by functions here
};

/// The number of a function that another rank asks for.
Id NumberOf(const PatchCorner& wanted, const PatchLevel& level, const std::vector<Id>& number)
{
  const Id patch = Id{ FirstInCell(level, wanted.cell) } + wanted.placeInCell;
  const bool isThere =
    patch < static_cast<Id>(level.cell.size()) && level.cell[patch] == wanted.cell;
  const Id known = isThere ? number[level.dof[patch][wanted.corner]] : -1;
  if (known < 0)
  {
    throw std::logic_error("Two ranks have clipped the surface differently where they meet.");
  }
  return known;
}

/// The functions of a level that this rank holds, ascending.
struct HeldFunctions
{
  std::vector<Index> own;
  std::vector<std::vector<Index>> ghosts;        // per owner
  std::vector<std::vector<PatchCorner>> corners; // of the ghosts
};

HeldFunctions FunctionsByOwner(
  const Touching& touching, const PatchLevel& level, const Communicator& ranks)
{
  HeldFunctions held;
  held.ghosts.resize(ranks.Size());
  held.corners.resize(ranks.Size());
  for (Index function = 0; function < level.numberOfFunctions; ++function)
  {
    if (!touching.IsHere(function))
    {
      continue;
    }
    const int owner = touching.OwnerOf(function);
    if (owner == ranks.Rank())
    {
      held.own.push_back(function);
    }
    else
    {
      held.ghosts[owner].push_back(function);
      held.corners[owner].push_back(touching.Describe(function));
    }
  }
  return held;
}

/// Collective. Asks the owners of ghosts for their numbers.
void AskForNumbers(const Communicator& ranks, const PatchLevel& level, const HeldFunctions& held,
  std::vector<Id>& number)
{
  const std::vector<std::vector<PatchCorner>> wanted = ranks.Exchange(held.corners);
  std::vector<std::vector<Id>> told(ranks.Size());
  ranks.Together(
    [&]
    {
      for (int rank = 0; rank < ranks.Size(); ++rank)
      {
        for (const PatchCorner& corner : wanted[rank])
        {
          told[rank].push_back(NumberOf(corner, level, number));
        }
      }
    });
  told = ranks.Exchange(told, SizesOf(held.ghosts));
  for (int rank = 0; rank < ranks.Size(); ++rank)
  {
    for (std::size_t k = 0; k < held.ghosts[rank].size(); ++k)
    {
      number[held.ghosts[rank][k]] = told[rank][k];
    }
  }
}

/// All functions that this rank holds. Ghosts have lower numbers and come first.
std::vector<Index> InOrderOfNumbers(const HeldFunctions& held, const std::vector<Id>& number)
{
  std::vector<Index> functions;
  for (const std::vector<Index>& ofOwner : held.ghosts)
  {
    functions.insert(functions.end(), ofOwner.begin(), ofOwner.end());
  }
  std::sort(
    functions.begin(), functions.end(), [&](Index a, Index b) { return number[a] < number[b]; });
  functions.insert(functions.end(), held.own.begin(), held.own.end());
  return functions;
}

} // namespace

Index FirstInCell(const PatchLevel& level, MortonKey cell)
{
  return static_cast<Index>(
    std::lower_bound(level.cell.begin(), level.cell.end(), cell) - level.cell.begin());
}

Index PlaceInCell(const PatchLevel& level, Index patch)
{
  return patch - FirstInCell(level, level.cell[patch]);
}

PatchRange OwnPatches(const PatchLevel& level, const BlockPartition& partition, int rank)
{
  const auto [begin, end] = partition.CellsOf(rank, level.depth);
  return { FirstInCell(level, begin), FirstInCell(level, end) };
}

LevelNumbering NumberLevel(const Communicator& ranks, const BlockPartition& partition,
  const PatchLevel& level, std::vector<Index>& place)
{
  LevelNumbering numbering;
  std::vector<Id> number;
  std::unique_ptr<const Touching> touching;
  HeldFunctions held;
  ranks.Together(
    [&]
    {
      touching = std::make_unique<const Touching>(partition, level, ranks.Rank());
      held = FunctionsByOwner(*touching, level, ranks);
    });
  const Communicator::Share share = ranks.ShareOf(static_cast<Id>(held.own.size()));
  numbering.begin = share.before;
  numbering.total = share.total;
  ranks.Together(
    [&]
    {
      RequireIndices(static_cast<double>(share.total), "functions of all ranks");
      number.assign(level.numberOfFunctions, -1);
      for (std::size_t k = 0; k < held.own.size(); ++k)
      {
        number[held.own[k]] = share.before + static_cast<Id>(k);
      }
    });
  AskForNumbers(ranks, level, held, number);
  ranks.Together(
    [&]
    {
      const std::vector<Index> functions = InOrderOfNumbers(held, number);
      numbering.ghosts = static_cast<Index>(functions.size() - held.own.size());
      place.assign(level.numberOfFunctions, -1);
      for (std::size_t k = 0; k < functions.size(); ++k)
      {
        place[functions[k]] = static_cast<Index>(k);
        numbering.number.push_back(number[functions[k]]);
        numbering.touching.push_back(touching->CountOf(functions[k]));
      }
      numbering.neighbors = touching->Neighbors(place);
    });
  return numbering;
}

} // namespace gridfem
