// Finds triangles that a mesh has several times.
#ifndef GridFEM_CopiedTriangles_h
#define GridFEM_CopiedTriangles_h

#include "Grid/TriangleMesh.h"

#include <vector>

namespace gridfem
{

/// Marks each triangle that has the corners of an earlier one, in any order, by 1. Triangles with
/// two equal corners are no copies. Cost O(n).
/// @param pointClass  welded id of each point; empty: every point is its own class
/// @return  a mark for each triangle; empty if there is no copy
std::vector<char> CopiedTriangles(
  const TriangleMesh& mesh, const Array<Index>& pointClass = Array<Index>());

/// Keeps the first of several triangles with the same corners, so that a face that is there twice
/// counts once.
/// @param sourceCell  a number for each triangle; loses those of the others
void DropCopies(TriangleMesh& mesh, std::vector<Id>& sourceCell);

} // namespace gridfem

#endif
