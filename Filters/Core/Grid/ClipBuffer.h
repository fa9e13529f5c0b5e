// What triangles fall into while they are clipped, before the pieces are sorted by cell.
#ifndef GridFEM_ClipBuffer_h
#define GridFEM_ClipBuffer_h

#include "Base/Errors.h"
#include "Base/Parallel.h"
#include "Grid/Clip.h"

#include <atomic>
#include <vector>

namespace gridfem
{

/// Pieces of all threads have numbers, handed out in chunks. A piece is told by its number until
/// all are sorted; which number it has does not matter.
constexpr Index PiecesPerChunk = 4096;

/// What the triangles fall into that one thread clips, in the order it meets them.
/// Corner ids: input points and cuts of mesh edges have their global id; -1 - k is interior point
/// k.
/// Threads write to their stores all the time, so that no two share a line of the cache.
struct alignas(CacheLine) ClipBuffer
{
  Array<MortonKey> key;
  Array<Index> triangle;
  Array<Index> cornerBegin; // one more than pieces
  Array<Index> corner;
  Array<CutPoint> interior; // points where two planes cut a triangle
  Array<Link> links;        // numbers of pieces of one triangle that share an edge
  std::vector<Index> chunk; // of every PiecesPerChunk pieces

  Index Size() const { return static_cast<Index>(key.size()); }
  Index NumberOf(Index piece) const
  {
    return PiecesPerChunk * chunk[piece / PiecesPerChunk] + piece % PiecesPerChunk;
  }

  /// Appends a piece without corners. Throws InvalidInput when there are too many.
  /// @param nextChunk  the next that no store has
  /// @return its place in the store
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
