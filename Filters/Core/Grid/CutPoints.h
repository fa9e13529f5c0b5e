// Creates the points that clipping makes.
#ifndef GridFEM_CutPoints_h
#define GridFEM_CutPoints_h

#include "Grid/TriangleClipper.h"

namespace gridfem
{

/// Makes room for `cuts` cuts of mesh edges after the input points. None of the cut points is made
/// yet.
void AllocateEdgeCuts(Id cuts, int threads, ClippedMesh& clipped);

/// Stores a cut point and its position.
/// @param point  the id of the point among all points
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

/// Removes the ids of cut points that were never made. If several planes cut an edge in one point,
/// the point gets only one id.
void DropUnmadeCutPoints(int threads, ClippedMesh& clipped);

} // namespace gridfem

#endif
