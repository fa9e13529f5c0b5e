#include "Parallel/HatNumbering.h"

#include "Base/Errors.h"
#include "Parallel/RankRows.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

namespace gridfem
{

namespace
{

using Position = std::array<double, 3>;
using Holder = std::pair<Position, int>;

Position PositionOf(const Vec3& point)
{
  return { point[0], point[1], point[2] };
}

/// The ranks that hold hats which more than one rank holds.
class Directory
{
public:
  /// @param asked  positions, by the rank that holds a hat there
  /// @param own    positions of hats that this rank holds
  Directory(
    const std::vector<std::vector<Position>>& asked, const std::vector<Position>& own, int rank)
  {
    for (std::size_t other = 0; other < asked.size(); ++other)
    {
      for (const Position& position : asked[other])
      {
        holders_.emplace_back(position, static_cast<int>(other));
      }
    }
    std::sort(holders_.begin(), holders_.end());
    std::vector<Holder> here;
    for (const Position& position : own)
    {
      const auto [first, last] = this->Of(position);
      if (first != last)
      {
        here.emplace_back(position, rank);
      }
    }
    holders_.insert(holders_.end(), here.begin(), here.end());
    std::sort(holders_.begin(), holders_.end());
  }

  /// The holders of a position, sorted by rank.
  using Range = std::pair<std::vector<Holder>::const_iterator, std::vector<Holder>::const_iterator>;
  Range Of(const Position& position) const
  {
    return std::equal_range(holders_.begin(), holders_.end(), Holder(position, 0),
      [](const Holder& a, const Holder& b) { return a.first < b.first; });
  }

private:
  std::vector<Holder> holders_;
};

/// Collective. The ranks that hold each hat, ascending; none if this rank holds it alone.
std::vector<std::vector<int>> HoldersOf(const Communicator& ranks, const HatList& hats)
{
  std::vector<std::vector<Position>> asked(ranks.Size());
  std::vector<std::vector<Index>> which(ranks.Size());
  std::vector<Position> here;
  ranks.Together(
    [&]
    {
      for (std::size_t k = 0; k < hats.home.size(); ++k)
      {
        const Position position = PositionOf(hats.position[k]);
        which[hats.home[k]].push_back(static_cast<Index>(k));
        (hats.home[k] == ranks.Rank() ? here : asked[hats.home[k]]).push_back(position);
      }
    });
  asked = ranks.Exchange(asked);
  std::vector<std::vector<int>> told(ranks.Size()); // per hat: a number of ranks, then these
  ranks.Together(
    [&]
    {
      const Directory directory(asked, here, ranks.Rank());
      asked[ranks.Rank()] = std::move(here);
      for (int other = 0; other < ranks.Size(); ++other)
      {
        for (const Position& position : asked[other])
        {
          const auto [first, last] = directory.Of(position);
          told[other].push_back(static_cast<int>(last - first));
          std::transform(first, last, std::back_inserter(told[other]),
            [](const Holder& holder) { return holder.second; });
        }
      }
    });
  told = ranks.Exchange(told);
  std::vector<std::vector<int>> holders;
  ranks.Together(
    [&]
    {
      holders.resize(hats.home.size());
      for (int home = 0; home < ranks.Size(); ++home)
      {
        auto next = told[home].begin();
        for (const Index hat : which[home])
        {
          RequirePlace(0, told[home].end() - next);
          const int count = *next++;
          RequirePlace(count, told[home].end() - next + 1);
          if (count > 1)
          {
            holders[hat].assign(next, next + count);
          }
          next += count;
        }
      }
    });
  return holders;
}

std::vector<RankNeighbor> NeighborsOf(
  const std::vector<std::vector<int>>& holders, const std::vector<Index>& order, int rank)
{
  std::map<int, std::vector<Index>> shared;
  for (std::size_t place = 0; place < order.size(); ++place)
  {
    for (const int holder : holders[order[place]])
    {
      if (holder != rank)
      {
        shared[holder].push_back(static_cast<Index>(place));
      }
    }
  }
  std::vector<RankNeighbor> neighbors;
  for (auto& [other, functions] : shared)
  {
    neighbors.push_back({ other, std::move(functions) });
  }
  return neighbors;
}

/// Collective. Numbers own hats and sends their numbers to the other ranks.
void TakeNumbers(const Communicator& ranks, LevelNumbering& numbering)
{
  std::unique_ptr<const RankRows> rows;
  MultiVector number;
  ranks.Together(
    [&]
    {
      RequireIndices(static_cast<double>(numbering.total), "hat functions of all ranks");
      rows = std::make_unique<const RankRows>(ranks, numbering.ghosts, numbering.neighbors);
      number = MultiVector::Zero(static_cast<Id>(numbering.touching.size()), 1);
      for (Id row = numbering.ghosts; row < number.rows(); ++row)
      {
        number(row, 0) = static_cast<double>(numbering.begin + row - numbering.ghosts);
      }
    });
  rows->TakeGhosts(number);
  ranks.Together([&] { numbering.number.assign(number.data(), number.data() + number.size()); });
}

} // namespace

LevelNumbering NumberHats(const Communicator& ranks, const HatList& hats, std::vector<Index>& place)
{
  const std::vector<std::vector<int>> holders = HoldersOf(ranks, hats);
  LevelNumbering numbering;
  ranks.Together(
    [&]
    {
      const auto ownerOf = [&](Index hat)
      { return holders[hat].empty() ? ranks.Rank() : holders[hat].front(); };
      std::vector<Index> order(holders.size());
      std::iota(order.begin(), order.end(), Index{ 0 });
      std::stable_sort(
        order.begin(), order.end(), [&](Index a, Index b) { return ownerOf(a) < ownerOf(b); });
      place.resize(order.size());
      for (std::size_t k = 0; k < order.size(); ++k)
      {
        place[order[k]] = static_cast<Index>(k);
        numbering.touching.push_back(
          std::max<Index>(1, static_cast<Index>(holders[order[k]].size())));
        numbering.ghosts += ownerOf(order[k]) < ranks.Rank() ? 1 : 0;
      }
      numbering.neighbors = NeighborsOf(holders, order, ranks.Rank());
    });
  const Communicator::Share share = ranks.ShareOf(static_cast<Id>(place.size()) - numbering.ghosts);
  numbering.begin = share.before;
  numbering.total = share.total;
  TakeNumbers(ranks, numbering);
  return numbering;
}

} // namespace gridfem
