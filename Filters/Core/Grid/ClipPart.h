// Clipping a part of a surface: the grid is that of the whole, and pieces are made in some of its
// cells only. What is made there is, bit for bit, what every other part makes there.
#ifndef GridFEM_ClipPart_h
#define GridFEM_ClipPart_h

#include "Grid/Clip.h"

#include <vector>

namespace gridfem
{

/// Cells of a grid: those of some blocks of 2^shift cells per side, and those near to them.
class CellRegion
{
public:
  /// @param blocks  keys of the blocks, in any order
  /// @param margin  how many cells around the blocks belong to it; less than a block has
  CellRegion(std::vector<MortonKey> blocks, int shift, int margin);

  bool Contains(const CellIndex& cell) const;

  /// Whether cells with this index along an axis are in the region or next to it. Who makes a point
  /// on the border of the region can lie just outside.
  bool IsNear(int axis, int index) const { return low_[axis] <= index && index <= high_[axis]; }

private:
  bool HasBlockOf(const CellIndex& cell) const;

  std::vector<MortonKey> blocks_; // ascending
  int shift_;
  int margin_;
  CellIndex low_;
  CellIndex high_;
};

/// What a part knows of the whole surface.
struct ClipFrame
{
  Grid grid;                          // of the whole; its depth counts
  double tolerance = 0.0;             // SnapTolerance of the whole
  const CellRegion* region = nullptr; // null: all cells
};

/// A coordinate this near to a grid plane (in cells) lies on it.
/// @param largest  absolute value of a coordinate of the surface, world units
double SnapTolerance(double largest, const Grid& grid);

/// As Clip, in a given grid. Positions agree between parts, bit for bit, when coincident points
/// have the same order in both. Throws InvalidInput (see Validate) and Aborted.
ClippedMesh ClipPart(const TriangleMesh& mesh, const ClipFrame& frame, const ClipOptions& options,
  const Progress& progress = {});

} // namespace gridfem

#endif
