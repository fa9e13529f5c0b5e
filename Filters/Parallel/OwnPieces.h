// Removes the data of other ranks from the functions on a clipped mesh.
#ifndef GridFEM_OwnPieces_h
#define GridFEM_OwnPieces_h

#include "Grid/GridFunctions.h"

namespace gridfem
{

/// Keeps the pieces of the patches first .. last, which are then numbered from 0, and the cut
/// points of these pieces. Input points stay; if they are in other patches, they have no patch. A
/// removed piece is recorded by its cell and triangle if the triangle also has pieces that stay.
void KeepPieces(Index first, Index last, GridFunctions& functions);

} // namespace gridfem

#endif
