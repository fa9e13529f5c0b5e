// Meshes the tests and examples make themselves. All are deterministic.
#ifndef GridFEM_Testing_Meshes_h
#define GridFEM_Testing_Meshes_h

#include "Grid/TriangleMesh.h"

#include <string>

namespace gridfem::testing
{

/// Latitude-longitude sphere with poles on z: `longitudes` x `latitudes` interior points plus the
/// two poles. 140 x 69, radius 0.5, centre (.5,.5,.5) is the sphere of thesis Table 4.3.
TriangleMesh LatLongSphere(
  int longitudes, int latitudes, double radius = 0.5, const Vec3& centre = { 0.5, 0.5, 0.5 });

/// Octahedron with every edge cut into `subdivisions` parts, projected: 8 n² triangles, 4 n² + 2
/// points; centred at 0.
TriangleMesh GeodesicSphere(int subdivisions, double radius = 1.0);

/// Surface of an axis-aligned box, every face cut into n x n squares of two triangles.
TriangleMesh Box(int n, const Vec3& low = { 0, 0, 0 }, const Vec3& high = { 1, 1, 1 });

/// Flat rectangle [0,width] x [0,height] in the plane z = 0, nx x ny squares of two triangles.
TriangleMesh FlatRectangle(int nx, int ny, double width = 1.0, double height = 1.0);

/// Trefoil tube: around the (2,3) knot on the torus of radii 2 and 1, whose strands come as near as
/// 1.663. The default radius leaves 0.063 between the tube's strands: they nearly touch.
TriangleMesh TrefoilTube(int along, int around, double tubeRadius = 0.8);

/// Torus with the given radii; genus 1.
TriangleMesh Torus(int along, int around, double radius, double tubeRadius);

/// counts^3 unit cubes, `gap` apart, disjoint (thesis Fig. 6.5 with counts = 6).
TriangleMesh CubeArray(int counts, int facesPerEdge, double gap);

/// Two parallel flat sheets at distance `gap`.
TriangleMesh TwoSheets(int n, double gap);

/// A belt pulley of outer radius 1 and genus 1: a surface of revolution around z of a hub, a thin
/// web and a rim with a V groove. 0 < wallThickness <= 0.2.
TriangleMesh Pulley(int around, double wallThickness);

/// Every triangle into four by its edge midpoints; shared midpoints are one point.
TriangleMesh SubdivideInPlane(const TriangleMesh& mesh);

/// Every triangle gets its own three points (as an STL file has them).
TriangleMesh Unweld(const TriangleMesh& mesh);

/// p -> scale * R p + shift with R the rotation by `angle` (radians) about `axis`.
TriangleMesh Transform(const TriangleMesh& mesh, const Vec3& axis, double angle, double scale = 1.0,
  const Vec3& shift = { 0, 0, 0 });

/// One mesh of both; points of b follow those of a.
TriangleMesh Join(const TriangleMesh& a, const TriangleMesh& b);

/// Reads a binary-little-endian PLY, ASCII or binary STL (corners unwelded), OFF or OBJ triangle
/// mesh of the real data sets. Throws std::runtime_error. Only for tests of Core, which know no
/// VTK.
TriangleMesh ReadMesh(const std::string& path);

/// Path of a file in the folder of real meshes, or empty when there is none.
/// (Environment GRIDFEM_DATA_DIR, else ../shared/data beside the source tree.)
std::string RealMesh(const std::string& name);

} // namespace gridfem::testing

#endif
