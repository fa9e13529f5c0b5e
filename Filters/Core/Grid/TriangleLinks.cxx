#include "Grid/TriangleClipper.h"

#include <algorithm>

namespace gridfem
{

/// Links the pieces that share an edge, whatever cells they are in. It sorts all edges, which takes
/// longer than LinkPieces.
void TriangleClipper::LinkByEdges(ClipBuffer& store)
{
  sides_.clear();
  for (const LocalPiece& piece : pieces_)
  {
    const Index* const ids = store.corner.data() + store.cornerBegin[piece.piece];
    Index from = ids[piece.size - 1];
    for (int i = 0; i < piece.size; ++i)
    {
      const auto [low, high] = std::minmax(from, ids[i]);
      sides_.push_back({ low, high, piece.piece });
      from = ids[i];
    }
  }
  std::sort(sides_.begin(), sides_.end());
  for (std::size_t k = 0; k < sides_.size(); ++k)
  {
    const auto [low, high, piece] = sides_[k];
    for (std::size_t other = k + 1; other < sides_.size(); ++other)
    {
      if (sides_[other][0] != low || sides_[other][1] != high)
      {
        break;
      }
      if (sides_[other][2] != piece)
      {
        store.links.emplace_back(store.NumberOf(piece), store.NumberOf(sides_[other][2]));
      }
    }
  }
}

void TriangleClipper::LinkPieces(ClipBuffer& store) const
{
  for (const LocalPiece& piece : pieces_)
  {
    for (int i = 0; i < piece.size; ++i)
    {
      const Corner& corner = corners_[piece.firstCorner + i];
      const int axis = corner.tag - PlaneTag;
      if (axis < 0)
      {
        continue;
      }
      constexpr CellCode Mask = (CellCode{ 1 } << BitsPerAxis) - 1;
      const CellCode index = (piece.cell >> ShiftOf(axis)) & Mask;
      if (static_cast<CellCode>(vertices_[corner.vertex].position[axis]) == index + 1)
      {
        this->LinkAcross(piece, i, store);
      }
    }
  }
}

bool TriangleClipper::HasEdge(const ClipBuffer& store, const LocalPiece& piece, Index a, Index b)
{
  const Index* const ids = store.corner.data() + store.cornerBegin[piece.piece];
  Index from = ids[piece.size - 1];
  for (int i = 0; i < piece.size; ++i)
  {
    const Index to = ids[i];
    if ((from == a && to == b) || (from == b && to == a))
    {
      return true;
    }
    from = to;
  }
  return false;
}

const TriangleClipper::LocalPiece* TriangleClipper::FindPiece(CellCode cell) const
{
  const auto found = std::lower_bound(pieces_.begin(), pieces_.end(), cell,
    [](const LocalPiece& piece, CellCode wanted) { return piece.cell < wanted; });
  return found != pieces_.end() && found->cell == cell ? &*found : nullptr;
}

/// Links a piece to the piece on the other side of a cut, which is in the next cell. If the cut
/// runs along an edge of the grid, it can be one cell away along the axes clipped later.
void TriangleClipper::LinkAcross(const LocalPiece& piece, int corner, ClipBuffer& store) const
{
  const Index* const ids = store.corner.data() + store.cornerBegin[piece.piece];
  const Index from = ids[corner];
  const Index to = ids[corner + 1 == piece.size ? 0 : corner + 1];
  const int axis = corners_[piece.firstCorner + corner].tag - PlaneTag;
  static constexpr std::array<int, 3> Shifts = { 0, -1, 1 };
  for (const int shiftZ : Shifts)
  {
    for (const int shiftY : Shifts)
    {
      if ((axis == 2 && shiftZ != 0) || (axis >= 1 && shiftY != 0))
      {
        continue;
      }
      const LocalPiece* other = this->FindPiece(piece.cell + (CellCode{ 1 } << ShiftOf(axis)) +
                                                shiftY * (CellCode{ 1 } << ShiftOf(1)) + shiftZ);
      if (other && HasEdge(store, *other, from, to))
      {
        store.links.emplace_back(store.NumberOf(piece.piece), store.NumberOf(other->piece));
        return;
      }
    }
  }
}

} // namespace gridfem
