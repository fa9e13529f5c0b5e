// The points that clipping makes.
#ifndef GridFEM_CutPoints_h
#define GridFEM_CutPoints_h

#include "Grid/TriangleClipper.h"

namespace gridfem
{

/// Makes room for so many cuts of mesh edges after the input points, none of them made yet.
void AllocateEdgeCuts(Id cuts, int threads, ClippedMesh& clipped);

/// Sets a cut point and its position.
/// @param point  its number among all points
inline void PlaceCutPoint(
  Id point, const CutPoint& cut, const ClipInput& input, ClippedMesh& clipped)
{
  const auto& corner = input.triangles[cut.triangle];
  clipped.cutPoints[point - clipped.numberOfInputPoints] = cut;
  const std::array<double, 3> weight = cut.Weights();
  clipped.position[point] = weight[0] * clipped.position[corner[0]] +
                            weight[1] * clipped.position[corner[1]] +
                            weight[2] * clipped.position[corner[2]];
}

/// Where several planes cut an edge in one point only one of its numbers is made: drops the others.
void DropUnmadeCutPoints(int threads, ClippedMesh& clipped);

} // namespace gridfem

#endif
