// The cells of the gathered surface that triangles on several ranks come from.
#ifndef GridFEM_SourceCells_h
#define GridFEM_SourceCells_h

#include "Input/InputMesh.h"

#include "Parallel/Redistribution.h"

class vtkPolyData;

namespace gridfem
{

/// Returns the number of the cell that each received triangle comes from. It counts the cells of
/// all ranks that are no copies, as PieceJoiner numbers them without global ids. Collective.
/// @param isCounted  the piece is there, and no earlier rank has it
/// @param mesh       the triangles of the piece
std::vector<Id> SourceCells(const Communicator& ranks, const Redistribution& distribution,
  vtkPolyData* piece, bool isCounted, const InputMesh& mesh);

} // namespace gridfem

#endif
