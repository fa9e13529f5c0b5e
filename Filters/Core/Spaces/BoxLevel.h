// Levels whose cells are boxes, wide across an axis and thin along it: the semi-coarsened levels of
// a grid. A box holds the part of one patch of the level of its width that lies in one of its
// layers, so that sheets that the grid keeps apart stay apart. Functions are numbered as in any
// other level.
#ifndef GridFEM_BoxLevel_h
#define GridFEM_BoxLevel_h

#include "Grid/GridFunctions.h"
#include "Integrals/DenseElement.h"

#include <tuple>
#include <vector>

namespace gridfem
{

struct Box
{
  MortonKey cell; // in units of the box's sides
  int axis;       // along which it is thin
  Index patch;    // of the level of its width

  bool operator<(const Box& other) const
  {
    return std::tie(cell, axis, patch) < std::tie(other.cell, other.axis, other.patch);
  }
  bool operator==(const Box& other) const
  {
    return std::tie(cell, axis, patch) == std::tie(other.cell, other.axis, other.patch);
  }
};

/// Boxes of 2^width x 2^width x 2^thickness finest cells, of all three axes. Those of different
/// axes share no functions. The next level's are twice as wide, and as thin until the ratio is
/// LargestRatio; from there on they grow along all axes.
struct BoxLevel
{
  static constexpr int LargestRatio = 4; // exponent, too

  int width = 0;
  int thickness = 0;
  std::vector<Box> boxes; // sorted, unique
  Array<ElementMatrix> elements;
  Array<Index> parent; // per box, in the next coarser level; set by CoarsenBoxes

  /// The axes, as bits, along which a box is half as long as its parent.
  int HalvedAxes(const Box& box) const
  {
    return width - thickness < LargestRatio ? 7 & ~(1 << box.axis) : 7;
  }
};

/// Weights of the parent's corners (columns) in a box's corners (rows).
const DenseElement& WeightsInParent(const BoxLevel& level, const Box& box);

/// The next level, with its elements by Galerkin coarsening; fills the parents of the finer boxes.
/// space.levels[fine.width] must have a coarser level. Cost O(boxes log boxes), partly serial; same
/// bits for any number of threads.
BoxLevel CoarsenBoxes(const GridFunctions& space, BoxLevel& fine, int threads = 0);

/// The boxes as patches of an ordinary level; no parents.
PatchLevel MakeLevel(const GridFunctions& space, const BoxLevel& boxes);

} // namespace gridfem

#endif
