// The triangles of a clipped mesh: every piece is a fan of them.
#ifndef GridFEM_ClippedFans_h
#define GridFEM_ClippedFans_h

#include "Base/Parallel.h"
#include "Grid/Clip.h"

namespace gridfem
{

/// Calls body(piece, begin, end) for all pieces. begin .. end is the piece's fan among all
/// triangles.
template<class Body>
void ForEachFan(const ClippedMesh& clipped, int threads, Body&& body)
{
  ParallelRanges(clipped.NumberOfPieces(), threads,
    [&](Id first, Id last)
    {
      for (Id piece = first; piece < last; ++piece)
      {
        // A piece of n corners has n - 2 triangles.
        body(piece, clipped.FirstTriangle(piece), clipped.FirstTriangle(piece + 1));
      }
    });
}

} // namespace gridfem

#endif
