// Finds the seams of a surface that ranks share.
#ifndef GridFEM_RankSeams_h
#define GridFEM_RankSeams_h

#include "Grid/Seams.h"
#include "Parallel/Communicator.h"

namespace gridfem
{

/// Collective. The seams of the surface of all ranks, the same on every rank and for any partition.
/// Every rank receives the open edges of the whole surface. The borders of pieces are not open.
/// @param own  triangles of this rank; no two ranks have the same triangle
Seams FindSeams(const Communicator& ranks, const TriangleMesh& own, int threads = 0);

} // namespace gridfem

#endif
