// Clips a part of a surface. It uses the grid of the whole surface, but makes pieces only in some
// of its cells. In the cells that two parts share, they make the same pieces, bit for bit.
#ifndef GridFEM_ClipPart_h
#define GridFEM_ClipPart_h

#include "Grid/Clip.h"

#include <vector>

namespace gridfem
{

/// A region of grid cells: some blocks of 2^shift cells per side, and a margin around them.
class CellRegion
{
public:
  /// @param blocks  Morton keys of the blocks, in any order
  /// @param margin  width of the margin around the blocks, in cells; less than the side of a block
  CellRegion(std::vector<MortonKey> blocks, int shift, int margin);

  bool Contains(const CellIndex& cell) const;

  /// Whether cells with this index along `axis` can be in the region or next to it. A polygon that
  /// makes a point on the border of the region may lie just outside.
  bool IsNear(int axis, int index) const { return low_[axis] <= index && index <= high_[axis]; }

private:
  bool HasBlockOf(const CellIndex& cell) const;

  std::vector<MortonKey> blocks_; // ascending
  int shift_;
  int margin_;
  CellIndex low_;
  CellIndex high_;
};

/// Data of the whole surface that clipping a part needs.
struct ClipFrame
{
  Grid grid;                          // grid of the whole surface; its depth replaces
                                      // ClipOptions::depth
  double tolerance = 0.0;             // SnapTolerance of the whole surface
  const CellRegion* region = nullptr; // null: all cells
};

/// Returns the distance, in cells, up to which a coordinate near a grid plane counts as lying on
/// it.
/// @param largest  largest absolute value of a coordinate of the surface, world units
double SnapTolerance(double largest, const Grid& grid);

/// Clips like Clip, but in a given grid. Positions in two parts agree bit for bit if coincident
/// points have the same order in both parts. Throws InvalidInput (see Validate) and Aborted.
ClippedMesh ClipPart(const TriangleMesh& mesh, const ClipFrame& frame, const ClipOptions& options,
  const Progress& progress = {});

} // namespace gridfem

#endif
