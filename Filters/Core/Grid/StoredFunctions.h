// Checks tables of patches and functions that come from a file. A wrong number in range would
// otherwise be solved, converge, and give a wrong result.
#ifndef GridFEM_StoredFunctions_h
#define GridFEM_StoredFunctions_h

#include "Grid/PatchLevel.h"

namespace gridfem
{

/// Throws InvalidInput naming the first patch, piece or function that breaks a rule:
/// - Every function belongs to one lattice point, and each of its patches has it at this point. A
///   patch therefore names no function twice. Without connectivity, a lattice point has one
///   function, and a cell has one patch.
/// - Pieces that share an edge are in one patch if they are in one cell. Otherwise their patches
///   share the functions of their common corners.
/// Tables may join more than the pieces do, because a filter may have removed triangles.
/// @param clipped     with links
/// @param piecePatch  the patch of each piece
void RequireStoredFunctions(const ClippedMesh& clipped, const Array<Index>& piecePatch,
  const PatchLevel& finest, FunctionSupport support);

} // namespace gridfem

#endif
