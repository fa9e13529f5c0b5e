// The distance from a curve close to it, where the surface is nearly flat: what a distance along
// the surface starts from on both sides.
#ifndef GridFEM_CurveDistance_h
#define GridFEM_CurveDistance_h

#include "Problems/SurfaceCurve.h"

#include <vector>

namespace gridfem
{

/// Per point the distance through space from the nearest segment of the curve, with the sign of its
/// side; NaN where it is more than the limit, but for the corners of triangles that the curve runs
/// through. Segments are handed from point to point, as long as the distance grows, and from each
/// the next one along the curve is taken as long as it is nearer: sheets that are near in space do
/// not feel each other.
/// @param limit  world units
/// Cost O(segments + k log k) for k points within the limit.
std::vector<double> DistancesNear(
  const SurfaceCurve& curve, const TriangleMesh& mesh, double limit, int threads = 0);

} // namespace gridfem

#endif
