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
  const TriangleMesh& mesh, const Array<Index>& pointClass, int threads = 0);

/// Keeps the triangles for which isKept(triangle) is true, in their order.
/// @param sourceCell  a number for each triangle; loses those of the others
template<class IsKept>
void KeepTriangles(TriangleMesh& mesh, std::vector<Id>& sourceCell, IsKept&& isKept)
{
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    if (isKept(t))
    {
      mesh.triangles[kept] = mesh.triangles[t];
      sourceCell[kept++] = sourceCell[t];
    }
  }
  mesh.triangles.resize(kept);
  sourceCell.resize(kept);
}

/// Keeps the first of several triangles with the same corners, so that a repeated face counts once.
/// Returns how many it drops.
/// @param sourceCell  as in KeepTriangles
Id DropCopies(TriangleMesh& mesh, std::vector<Id>& sourceCell, int threads = 0);

} // namespace gridfem

#endif
