#include "Grid/ClipPart.h"

#include <algorithm>
#include <limits>

namespace gridfem
{

CellRegion::CellRegion(std::vector<MortonKey> blocks, int shift, int margin)
  : blocks_(std::move(blocks)), shift_(shift), margin_(margin)
{
  std::sort(blocks_.begin(), blocks_.end());
  low_.fill(std::numeric_limits<int>::max());
  high_.fill(std::numeric_limits<int>::min());
  for (const MortonKey block : blocks_)
  {
    const CellIndex index = MortonDecode(block);
    for (int axis = 0; axis < 3; ++axis)
    {
      low_[axis] = std::min(low_[axis], (index[axis] << shift_) - margin_ - 1);
      high_[axis] = std::max(high_[axis], ((index[axis] + 1) << shift_) + margin_);
    }
  }
}

bool CellRegion::HasBlockOf(const CellIndex& cell) const
{
  CellIndex block;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (cell[axis] < 0)
    {
      return false;
    }
    block[axis] = cell[axis] >> shift_;
  }
  return std::binary_search(blocks_.begin(), blocks_.end(), MortonEncode(block));
}

bool CellRegion::Contains(const CellIndex& cell) const
{
  if (this->HasBlockOf(cell))
  {
    return true;
  }
  for (int corner = 0; corner < 8; ++corner)
  {
    CellIndex near = cell;
    for (int axis = 0; axis < 3; ++axis)
    {
      near[axis] += (corner >> axis & 1) ? margin_ : -margin_;
    }
    if (this->HasBlockOf(near))
    {
      return true;
    }
  }
  return false;
}

} // namespace gridfem
