#include "Parallel/LevelNumbering.h"

#include <algorithm>
#include <limits>
#include <optional>

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
      this->AddForeign(patch, partition.OwnerOf(level.cell[patch], level.depth));
    }
    std::sort(others_.begin(), others_.end());
    others_.erase(std::unique(others_.begin(), others_.end()), others_.end());
    for (const auto& [other, function] : others_)
    {
      ++count_[function];
    }
  }

  bool IsHere(Index function) const { return count_[function] > 0; }
  int OwnerOf(Index function) const { return owner_[function]; }
  Index CountOf(Index function) const { return count_[function]; }

  /// @param place  place of every function in the numbering
  std::vector<RankNeighbour> Neighbours(const std::vector<Index>& place) const
  {
    std::vector<RankNeighbour> neighbours;
    for (const auto& [other, function] : others_)
    {
      if (neighbours.empty() || neighbours.back().rank != other)
      {
        neighbours.push_back({ other, {} });
      }
      neighbours.back().functions.push_back(place[function]);
    }
    for (RankNeighbour& neighbour : neighbours)
    {
      std::sort(neighbour.functions.begin(), neighbour.functions.end());
    }
    return neighbours;
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

  void AddForeign(Index patch, int owner)
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
  std::vector<Index> own;
  std::vector<std::vector<Index>> ghosts(ranks.Size());
  std::vector<std::vector<PatchCorner>> wanted(ranks.Size());
  std::optional<Touching> touching;
  ranks.Together(
    [&]
    {
      number.assign(level.numberOfFunctions, -1);
      touching.emplace(partition, level, ranks.Rank());
      for (Index function = 0; function < level.numberOfFunctions; ++function)
      {
        if (!touching->IsHere(function))
        {
          continue;
        }
        const int owner = touching->OwnerOf(function);
        if (owner == ranks.Rank())
        {
          own.push_back(function);
        }
        else
        {
          ghosts[owner].push_back(function);
          wanted[owner].push_back(touching->Describe(function));
        }
      }
    });
  const Communicator::Share share = ranks.ShareOf(static_cast<Id>(own.size()));
  numbering.begin = share.before;
  numbering.total = share.total;
  for (std::size_t k = 0; k < own.size(); ++k)
  {
    number[own[k]] = share.before + static_cast<Id>(k);
  }

  wanted = ranks.Exchange(wanted);
  std::vector<std::vector<Id>> told(ranks.Size());
  ranks.Together(
    [&]
    {
      RequireIndices(static_cast<double>(share.total), "functions of all ranks");
      for (int rank = 0; rank < ranks.Size(); ++rank)
      {
        for (const PatchCorner& corner : wanted[rank])
        {
          told[rank].push_back(NumberOf(corner, level, number));
        }
      }
    });
  told = ranks.Exchange(told);

  ranks.Together(
    [&]
    {
      std::vector<Index> functions;
      for (int rank = 0; rank < ranks.Size(); ++rank)
      {
        for (std::size_t k = 0; k < ghosts[rank].size(); ++k)
        {
          number[ghosts[rank][k]] = told[rank][k];
          functions.push_back(ghosts[rank][k]);
        }
      }
      numbering.ghosts = static_cast<Index>(functions.size());
      std::sort(functions.begin(), functions.end(),
        [&](Index a, Index b) { return number[a] < number[b]; });
      functions.insert(functions.end(), own.begin(), own.end());
      place.assign(level.numberOfFunctions, -1);
      for (std::size_t k = 0; k < functions.size(); ++k)
      {
        place[functions[k]] = static_cast<Index>(k);
        numbering.number.push_back(number[functions[k]]);
        numbering.touching.push_back(touching->CountOf(functions[k]));
      }
      numbering.neighbours = touching->Neighbours(place);
    });
  return numbering;
}

} // namespace gridfem
