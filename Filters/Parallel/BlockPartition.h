// Divides space among the ranks: the cells of a coarse level of the octree, along the Morton curve.
// A cell and all cells in it have one owner. [DESIGN §6]
#ifndef GridFEM_BlockPartition_h
#define GridFEM_BlockPartition_h

#include "Grid/ClipPart.h"
#include "Parallel/Communicator.h"
#include "Parallel/TriangleBlocks.h"

#include <utility>
#include <vector>

namespace gridfem
{

/// The partition into blocks. A block is a cell of the level `depth`, which is coarser than the
/// finest.
class BlockPartition
{
public:
  /// Collective. Divides the blocks that the surface meets so that each rank gets about as many
  /// clipped pieces.
  /// @param mesh         the triangles of this rank, in the grid of the whole surface
  /// @param granularity  the level of the blocks, 1 .. grid.depth - 1; 0: the finest level with at
  ///   most MostBlocks of them
  /// @param cells        cells of triangles that are pieces already; null: triangles are clipped
  /// Throws InvalidInput for a granularity outside this range.
  BlockPartition(const Communicator& ranks, const TriangleMesh& mesh, const ClipFrame& frame,
    int granularity, const std::vector<MortonKey>* cells = nullptr);

  /// Largest automatic number of blocks. All ranks hold each of their functions, on this level and
  /// on coarser levels.
  static constexpr Id MostBlocks = 4096;

  int Depth() const { return depth_; }

  /// The rank that owns a cell.
  /// @param depth  the level of the cell, at least Depth()
  int OwnerOf(MortonKey cell, int depth) const;

  /// Range of the keys, begin .. end, of the cells of a level that a rank owns. The level is at
  /// least Depth().
  std::pair<MortonKey, MortonKey> CellsOf(int rank, int depth) const;

  /// The cells for which a rank clips: its own blocks, the blocks around them, and a few cells
  /// more. The margin is necessary because slivers are decided a little further away.
  CellRegion RegionOf(int rank) const;

  struct RanksNear
  {
    std::vector<int> ranks;
    BlockBox box; // the ranks are valid for any triangle in this box
  };

  /// Finds the ranks whose regions a triangle may meet, in ascending order.
  /// @param a, b, c  the triangle's corners, grid units
  /// @param near     result of the triangle before; triangles close to each other often share it
  void FindRanksNear(const Vec3& a, const Vec3& b, const Vec3& c, RanksNear& near) const;

  /// All ranks that FindRanksNear can find for a triangle in a cell of the finest level, in
  /// ascending order.
  std::vector<int> RanksNearCell(MortonKey cell) const;

  /// Number of cells by which a region extends beyond its blocks.
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
  void ForNeighbors(MortonKey block, Body&& body) const;

  int depth_ = 0;
  int shift_ = 0;                 // cells per side of a block: 2^shift
  std::vector<MortonKey> blocks_; // blocks that the surface meets, ascending
  std::vector<MortonKey> begin_;  // begin of each rank's range, and the end
  /// Blocks with the ranks that own them or a block next to them; ascending.
  std::vector<std::pair<MortonKey, int>> near_;
};

} // namespace gridfem

#endif
