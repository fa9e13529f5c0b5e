// Temporary storage for the pieces of triangles, before they are sorted by cell.
#ifndef GridFEM_ClipBuffer_h
#define GridFEM_ClipBuffer_h

#include "Base/Errors.h"
#include "Base/Parallel.h"
#include "Grid/Clip.h"

#include <atomic>
#include <vector>

namespace gridfem
{

/// The pieces of all threads are numbered together; the numbers are handed out in chunks of this
/// size. A number identifies its piece until all pieces are sorted. Results do not depend on the
/// numbers.
constexpr Index PiecesPerChunk = 4096;

/// The pieces made by one thread, in the order of clipping.
/// Corner ids: input points and cuts of mesh edges have their global id;
/// -1 - k is interior point k.
/// The alignment keeps two threads from sharing a cache line, because threads write to their stores
/// all the time.
struct alignas(CacheLine) ClipBuffer
{
  Array<MortonKey> key;
  Array<Index> triangle;
  Array<Index> cornerBegin; // one entry more than there are pieces
  Array<Index> corner;
  Array<CutPoint> interior; // points where two planes cut a triangle
  Array<Link> links;        // numbers of pieces of one triangle that share an edge
  std::vector<Index> chunk; // the chunk number of every PiecesPerChunk pieces

  Index Size() const { return static_cast<Index>(key.size()); }
  Index NumberOf(Index piece) const
  {
    return PiecesPerChunk * chunk[piece / PiecesPerChunk] + piece % PiecesPerChunk;
  }

  /// Appends a piece without corners. Throws InvalidInput when there are too many pieces.
  /// @param nextChunk  the lowest chunk number that no store has taken
  /// @return the index of the piece in this store
  Index Append(MortonKey cell, Index source, std::atomic<Index>& nextChunk)
  {
    const Index piece = this->Size();
    if (piece % PiecesPerChunk == 0)
    {
      const Index next = nextChunk++;
      RequireIndices((next + 1.0) * PiecesPerChunk, "pieces");
      chunk.push_back(next);
    }
    key.push_back(cell);
    triangle.push_back(source);
    return piece;
  }
};

} // namespace gridfem

#endif
