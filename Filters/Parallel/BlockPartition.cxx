#include "Parallel/BlockPartition.h"

#include "Base/SortEachOnce.h"

#include <algorithm>
#include <limits>
#include <string>
#include <unordered_map>

namespace gridfem
{

namespace
{

/// Cells by which a triangle may be closer to a block than its coordinates say. It is more than the
/// distance of snapping.
constexpr double Slack = 0.01;

/// Finest level for blocks when none is given. A surface has about 10^5 blocks there.
constexpr int FinestBlocks = 7;

std::array<Vec3, 3> CornersOf(const TriangleMesh& mesh, Id triangle, const Grid& grid)
{
  const auto& points = mesh.triangles[triangle];
  return { grid.ToGrid(mesh.points[points[0]]), grid.ToGrid(mesh.points[points[1]]),
    grid.ToGrid(mesh.points[points[2]]) };
}

/// Approximate number of pieces that a triangle is clipped to.
double ExpectedPieces(const std::array<Vec3, 3>& corner)
{
  const Vec3 extent = corner[0].cwiseMax(corner[1]).cwiseMax(corner[2]) -
                      corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]);
  return 1.0 + extent.sum() + 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
}

/// Sorts blocks by key and adds up the pieces of blocks with the same key.
template<class Block>
void SortAndMerge(std::vector<Block>& blocks)
{
  std::stable_sort(
    blocks.begin(), blocks.end(), [](const Block& a, const Block& b) { return a.key < b.key; });
  std::vector<Block> merged;
  for (const Block& block : blocks)
  {
    if (!merged.empty() && merged.back().key == block.key)
    {
      merged.back().pieces += block.pieces;
    }
    else
    {
      merged.push_back(block);
    }
  }
  blocks.swap(merged);
}

} // namespace

BlockPartition::BlockPartition(const Communicator& ranks, const TriangleMesh& mesh,
  const ClipFrame& frame, int granularity, const std::vector<MortonKey>* cells)
{
  const int finest = frame.grid.depth - 1;
  if (granularity < 0 || granularity > finest)
  {
    throw InvalidInput("The granularity is " + std::to_string(granularity) +
                       "; it must be between 1 and " + std::to_string(finest) + ", or 0.");
  }
  depth_ = granularity > 0 ? granularity : std::min(finest, FinestBlocks);
  std::vector<Block> blocks;
  ranks.Together(
    [&]
    {
      std::unordered_map<MortonKey, double> pieces;
      std::vector<MortonKey> met;
      std::pair<const MortonKey, double>* last = nullptr; // of the triangle before, often the same
      const double side = 1 << (frame.grid.depth - depth_);
      for (Id t = 0; t < static_cast<Id>(mesh.triangles.size()); ++t)
      {
        const auto corner = CornersOf(mesh, t, frame.grid);
        met.clear();
        if (cells)
        {
          met.push_back((*cells)[t] >> (3 * (frame.grid.depth - depth_)));
        }
        else
        {
          ForBlocksNear(corner, BoxNear(corner, side, 1 << depth_, Slack), side, Slack,
            [&](MortonKey key) { met.push_back(key); });
        }
        for (const MortonKey key : met)
        {
          last = last && last->first == key ? last : &*pieces.try_emplace(key, 0.0).first;
          last->second += ExpectedPieces(corner) / static_cast<double>(met.size());
        }
      }
      for (const auto& [key, number] : pieces)
      {
        blocks.push_back({ key, number });
      }
      SortAndMerge(blocks);
    });
  blocks = ranks.Gather(blocks);
  ranks.Together([&] { this->Divide(std::move(blocks), granularity == 0, ranks.Size()); });
  shift_ = frame.grid.depth - depth_;
}

void BlockPartition::Divide(std::vector<Block> blocks, bool isCoarsened, int ranks)
{
  SortAndMerge(blocks);
  while (isCoarsened && depth_ > 1 && static_cast<Id>(blocks.size()) > MostBlocks)
  {
    --depth_;
    for (Block& block : blocks)
    {
      block.key >>= 3;
    }
    SortAndMerge(blocks);
  }
  double total = 0.0;
  for (const Block& block : blocks)
  {
    total += block.pieces;
    blocks_.push_back(block.key);
  }
  begin_.push_back(0);
  double sum = 0.0;
  for (const Block& block : blocks)
  {
    // A block goes to the rank whose share contains its middle.
    const double middle = sum + 0.5 * block.pieces;
    while (static_cast<int>(begin_.size()) < ranks &&
           middle >= total * static_cast<double>(begin_.size()) / ranks)
    {
      begin_.push_back(block.key);
    }
    sum += block.pieces;
  }
  begin_.resize(ranks, MortonKey{ 1 } << (3 * depth_));
  begin_.push_back(MortonKey{ 1 } << (3 * depth_));
  for (const MortonKey block : blocks_)
  {
    const int owner = this->OwnerOf(block, depth_);
    this->ForNeighbors(block, [&](MortonKey key) { near_.emplace_back(key, owner); });
  }
  SortEachOnce(near_);
}

int BlockPartition::OwnerOf(MortonKey cell, int depth) const
{
  const MortonKey block = cell >> (3 * (depth - depth_));
  const auto next = std::upper_bound(begin_.begin(), begin_.end() - 1, block);
  return static_cast<int>(next - begin_.begin()) - 1;
}

std::pair<MortonKey, MortonKey> BlockPartition::CellsOf(int rank, int depth) const
{
  const int bits = 3 * (depth - depth_);
  return { begin_[rank] << bits, begin_[rank + 1] << bits };
}

template<class Body>
void BlockPartition::ForNeighbors(MortonKey block, Body&& body) const
{
  const CellIndex index = MortonDecode(block);
  const int side = 1 << depth_;
  for (int k = std::max(index[2] - 1, 0); k <= std::min(index[2] + 1, side - 1); ++k)
  {
    for (int j = std::max(index[1] - 1, 0); j <= std::min(index[1] + 1, side - 1); ++j)
    {
      for (int i = std::max(index[0] - 1, 0); i <= std::min(index[0] + 1, side - 1); ++i)
      {
        body(MortonEncode({ i, j, k }));
      }
    }
  }
}

CellRegion BlockPartition::RegionOf(int rank) const
{
  std::vector<MortonKey> region;
  const auto begin = std::lower_bound(blocks_.begin(), blocks_.end(), begin_[rank]);
  const auto end = std::lower_bound(begin, blocks_.end(), begin_[rank + 1]);
  for (auto block = begin; block != end; ++block)
  {
    this->ForNeighbors(*block, [&](MortonKey key) { region.push_back(key); });
  }
  SortEachOnce(region);
  return CellRegion(std::move(region), shift_, std::min(Margin, (1 << shift_) - 1));
}

void BlockPartition::AddRanksNear(MortonKey block, std::vector<int>& ranks) const
{
  const auto first = std::lower_bound(near_.begin(), near_.end(), std::make_pair(block, 0));
  for (auto next = first; next != near_.end() && next->first == block; ++next)
  {
    ranks.push_back(next->second);
  }
}

std::vector<int> BlockPartition::RanksNearCell(MortonKey cell) const
{
  constexpr int Reach = Margin + 1; // for all results of FindRanksNear
  const CellIndex index = MortonDecode(cell);
  BlockBox box;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.first[axis] = std::max(index[axis] - Reach, 0) >> shift_;
    box.last[axis] = std::min((index[axis] + Reach) >> shift_, (1 << depth_) - 1);
  }
  std::vector<int> ranks;
  ForBlocksOf(box, [&](const CellIndex& block) { this->AddRanksNear(MortonEncode(block), ranks); });
  SortEachOnce(ranks);
  return ranks;
}

void BlockPartition::FindRanksNear(
  const Vec3& a, const Vec3& b, const Vec3& c, RanksNear& near) const
{
  constexpr double Reach = Margin + Slack;
  const double side = 1 << shift_;
  const std::array<Vec3, 3> corner = { a, b, c };
  const BlockBox box = BoxNear(corner, side, 1 << depth_, Reach);
  bool isSmall = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    isSmall &= box.last[axis] <= box.first[axis] + 1;
  }
  if (isSmall && box == near.box)
  {
    return;
  }
  std::vector<int>& ranks = near.ranks;
  ranks.clear();
  if (isSmall)
  {
    // A closer look would cost more than the few triangles that it saves.
    near.box = box;
    ForBlocksOf(
      box, [&](const CellIndex& block) { this->AddRanksNear(MortonEncode(block), ranks); });
  }
  else
  {
    near.box = {};
    ForBlocksNear(
      corner, box, side, Reach, [&](MortonKey block) { this->AddRanksNear(block, ranks); });
  }
  SortEachOnce(ranks);
}

} // namespace gridfem
