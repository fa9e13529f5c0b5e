// How far a surface is from another one, as the Metro tool has it: from its points to the nearest
// place on the triangles of the other.
#ifndef GridFEM_Benchmarks_SurfaceDistance_h
#define GridFEM_Benchmarks_SurfaceDistance_h

#include "Grid/TriangleMesh.h"

namespace gridfem::benchmarks
{

double DistanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

struct SurfaceDistance
{
  double largest = 0.0;
  double rms = 0.0; // over the points
};

/// From the points of one embedding of a mesh to the surface of another one, exactly. Fast where
/// points with the same number are near each other: that is where the search begins.
SurfaceDistance DistanceBetween(
  const std::vector<Vec3>& points, const std::vector<Vec3>& others, const TriangleMesh& mesh);

} // namespace gridfem::benchmarks

#endif
