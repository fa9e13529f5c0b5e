// Writes the surface that is joined from pieces.
#ifndef GridFEM_JoinedPieces_h
#define GridFEM_JoinedPieces_h

#include "Pieces/PieceArrays.h"

namespace gridfem
{

/// Writes the cells, ordered by their kinds.
/// @param pointPlace  the point of the whole, per point of the pieces
/// @param cellSource  the cell of the pieces, per cell of the whole
/// @param kindEnd     the number of cells of the whole up to each kind
void WriteJoinedCells(const Pieces& pieces, const Numbering& points,
  const std::vector<vtkIdType>& pointPlace, const std::vector<vtkIdType>& cellSource,
  const std::array<vtkIdType, CellKinds>& kindEnd, vtkPolyData* whole);

/// Writes point arrays, or cell arrays, and the active attributes of the first piece.
/// @param sources  the point or cell of the pieces, per point or cell of the whole
void WriteJoinedArrays(const Pieces& pieces, const std::vector<ArraysOfPieces>& arrays,
  const Numbering& numbering, const std::vector<vtkIdType>& sources, AttributesOf attributesOf,
  vtkPolyData* whole);

/// Marks hidden cells: they stay, and stay hidden.
void WriteHiddenCells(const Pieces& pieces, const Numbering& cells,
  const std::vector<vtkIdType>& sources, vtkPolyData* whole);

} // namespace gridfem

#endif
