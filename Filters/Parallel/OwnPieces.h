// Takes what belongs to other ranks out of the functions on a clipped mesh.
#ifndef GridFEM_OwnPieces_h
#define GridFEM_OwnPieces_h

#include "Grid/GridFunctions.h"

namespace gridfem
{

/// Keeps the pieces of the patches first .. last, which are numbered from 0 then, and of the cut
/// points those of these pieces. Input points stay; other patches' points have none. Of the other
/// pieces it is kept where they are that belong to the same triangles.
void KeepPieces(Index first, Index last, GridFunctions& functions);

} // namespace gridfem

#endif
