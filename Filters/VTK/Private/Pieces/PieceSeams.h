// Joins the seams of a surface that ranks share.
#ifndef GridFEM_PieceSeams_h
#define GridFEM_PieceSeams_h

#include "Input/InputMesh.h"

#include "Parallel/Communicator.h"

namespace gridfem
{

/// Gives points that coincide except for rounding the same coordinates, also in the copies of
/// triangles. Collective. Throws NeedsWholeSurface if there are hanging nodes.
void JoinSeamsOfRanks(const Communicator& ranks, int threads, InputMesh& mesh, InputMesh& copies);

} // namespace gridfem

#endif
