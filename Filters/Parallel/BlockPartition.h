// Which rank owns which part of space: the cells of a coarse level of the octree, along the Morton
// curve. A cell and all cells in it have one owner. [DESIGN §6]
#ifndef GridFEM_BlockPartition_h
#define GridFEM_BlockPartition_h

#include "Grid/ClipPart.h"
#include "Parallel/Communicator.h"
#include "Parallel/TriangleBlocks.h"

#include <utility>
#include <vector>

namespace gridfem
{

/// Blocks are cells of the level `depth`, coarser than the finest.
class BlockPartition
{
public:
  /// Collective. Divides the blocks that the surface meets so that each rank gets about as many
  /// clipped pieces.
  /// @param mesh         the triangles of this rank, of the whole surface's grid
  /// @param granularity  the level of the blocks, 1 .. grid.depth - 1; 0: the finest with at most
  ///                     MostBlocks of them
  /// @param cells        of triangles that are pieces already; null: they are clipped
  /// Throws InvalidInput for a granularity outside this range.
  BlockPartition(const Communicator& ranks, const TriangleMesh& mesh, const ClipFrame& frame,
    int granularity, const std::vector<MortonKey>* cells = nullptr);

  /// Each of their functions is held by all ranks, on that level and those above it.
  static constexpr Id MostBlocks = 4096;

  int Depth() const { return depth_; }

  /// @param depth  the level of the cell, from Depth() on
  int OwnerOf(MortonKey cell, int depth) const;

  /// Cells of this level, from Depth() on, that a rank owns: begin .. end of their keys.
  std::pair<MortonKey, MortonKey> CellsOf(int rank, int depth) const;

  /// The cells for which a rank clips: its own blocks, those around them, and a few cells more,
  /// because what slivers do is decided a little further away.
  CellRegion RegionOf(int rank) const;

  struct RanksNear
  {
    std::vector<int> ranks;
    BlockBox box; // for which they hold, whatever the triangle in it
  };

  /// The ranks whose regions a triangle may meet, ascending.
  /// @param a, b, c  the triangle's corners, grid units
  /// @param near     of the triangle before; near triangles often have the same
  void FindRanksNear(const Vec3& a, const Vec3& b, const Vec3& c, RanksNear& near) const;

  /// Of a triangle in a cell of the finest level: all ranks that FindRanksNear can find, ascending.
  std::vector<int> RanksNearCell(MortonKey cell) const;

  /// How many cells a region reaches beyond its blocks.
  static constexpr int Margin = 2;

private:
  struct Block
  {
    MortonKey key;
    double pieces; // expected
  };

  void Divide(std::vector<Block> blocks, bool isCoarsened, int ranks);
  void AddRanksNear(MortonKey block, std::vector<int>& ranks) const;
  template<class Body>
  void ForNeighbours(MortonKey block, Body&& body) const;

  int depth_ = 0;
  int shift_ = 0;                 // cells per side of a block: 2^shift
  std::vector<MortonKey> blocks_; // that the surface meets, ascending
  std::vector<MortonKey> begin_;  // of each rank's range, and one more
  /// Blocks, and the ranks that own them or a block next to them; ascending.
  std::vector<std::pair<MortonKey, int>> near_;
};

} // namespace gridfem

#endif
