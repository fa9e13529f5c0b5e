// Finds edges along which a surface has to be cut so that it becomes a disk.
#ifndef GridFEM_CutGraph_h
#define GridFEM_CutGraph_h

#include "Shape/ConnectedTriangles.h"

namespace gridfem
{

/// Returns half edges to cut, one of each edge. The triangles have to be one connected component.
/// Every boundary loop counts as one node. A tree of shortest paths leads from one node to all
/// others. Handles are cut along the shortest loops that consist of two paths of the tree and an
/// edge between them [Erickson and Whittlesey 2005]. The node is on the handle that is nearest to
/// the first loop. The other cuts run from each loop of the boundary along the tree. Extra cuts
/// lead to the points farthest from all cuts.
/// @param extraCuts  number of extra cuts; at least eight are made if loops and other cuts are
///   short for the area
std::vector<HalfEdge> FindCuts(const ConnectedTriangles& triangles, const std::vector<Vec3>& points,
  bool hasHandles, int extraCuts);

} // namespace gridfem

#endif
