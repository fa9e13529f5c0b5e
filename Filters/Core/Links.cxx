#include "Links.h"

#include <algorithm>

namespace gridfem
{

namespace
{

/// Links of one edge. `pieces` is sorted and unique, so it is grouped by cell.
void LinkStar(
  const std::vector<Id>& pieces, const std::vector<Id>& pieceCell, std::vector<PieceLink>& links)
{
  std::vector<Id> firstOfCell;
  for (const Id piece : pieces)
  {
    if (!firstOfCell.empty() && pieceCell[firstOfCell.back()] == pieceCell[piece])
    {
      links.push_back({ firstOfCell.back(), piece });
      continue;
    }
    for (const Id other : firstOfCell)
    {
      links.push_back({ other, piece });
    }
    firstOfCell.push_back(piece);
  }
}

} // namespace

void LinkStars(
  std::vector<EdgeUse>& uses, const std::vector<Id>& pieceCell, std::vector<PieceLink>& links)
{
  std::sort(uses.begin(), uses.end(),
    [](const EdgeUse& a, const EdgeUse& b)
    { return a.edge != b.edge ? a.edge < b.edge : a.piece < b.piece; });
  std::vector<Id> pieces;
  for (std::size_t k = 0; k < uses.size(); ++k)
  {
    if (pieces.empty() || pieces.back() != uses[k].piece)
    {
      pieces.push_back(uses[k].piece);
    }
    if (k + 1 == uses.size() || uses[k + 1].edge != uses[k].edge)
    {
      LinkStar(pieces, pieceCell, links);
      pieces.clear();
    }
  }
}

} // namespace gridfem
