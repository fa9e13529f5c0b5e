// The distance from a curve in its neighborhood, where the surface is nearly flat. A distance along
// the surface starts from it on both sides.
#ifndef GridFEM_CurveDistance_h
#define GridFEM_CurveDistance_h

#include "Distance/StraightDistance.h"
#include "Distance/SurfaceCurve.h"

#include <vector>

namespace gridfem
{

/// The straight pieces of the curve, world units.
std::vector<Segment> PiecesOf(const SurfaceCurve& curve, const TriangleMesh& mesh);

/// Returns the distance of each point, through space, from the nearest segment of the curve. Its
/// sign is the side of the point. It is NaN beyond the limit, except at corners of triangles that
/// the curve crosses. Points hand their nearest segment to their neighbors as long as the distance
/// grows. Each point then follows the curve from that segment as long as it gets nearer. Sheets
/// that are close in space therefore do not affect each other.
/// @param limit  world units
/// Cost O(segments + k log k) for k points within the limit.
std::vector<double> DistancesNear(
  const SurfaceCurve& curve, const TriangleMesh& mesh, double limit, int threads = 0);

} // namespace gridfem

#endif
