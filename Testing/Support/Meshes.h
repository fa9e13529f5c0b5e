// Meshes that tests and examples make themselves. All are deterministic.
#ifndef GridFEM_Testing_Meshes_h
#define GridFEM_Testing_Meshes_h

#include "Grid/TriangleMesh.h"

#include <functional>
#include <string>
#include <vector>

namespace gridfem::testing
{

/// Latitude-longitude sphere with poles on z: `longitudes` x `latitudes` interior points plus the
/// two poles. With 140 x 69 points, radius 0.5 and center (.5,.5,.5), it is the sphere of thesis
/// Table 4.3.
TriangleMesh LatLongSphere(
  int longitudes, int latitudes, double radius = 0.5, const Vec3& center = { 0.5, 0.5, 0.5 });

/// Octahedron projected to a sphere around 0, with every edge cut into `subdivisions` = n parts: 8
/// n² triangles and 4 n² + 2 points.
TriangleMesh GeodesicSphere(int subdivisions, double radius = 1.0);

/// Surface of an axis-aligned box. Every face is cut into n x n squares of two triangles.
TriangleMesh Box(int n, const Vec3& low = { 0, 0, 0 }, const Vec3& high = { 1, 1, 1 });

/// Flat rectangle [0,width] x [0,height] in the plane z = 0, with nx x ny squares of two triangles.
TriangleMesh FlatRectangle(int nx, int ny, double width = 1.0, double height = 1.0);

/// Unit disk in the plane z = 0: fineness x fineness squares, whose square rings become round ones.
TriangleMesh Disk(int fineness);

/// Unit square in the plane z = 0 of two halves, which have `left` and `right` squares along y.
/// Nodes hang between them.
TriangleMesh Halves(int left, int right);

/// Trefoil tube around the (2,3) knot on the torus of radii 2 and 1. The knot's strands come as
/// close as 1.663. The default radius leaves a gap of 0.063 between the tube's strands: they nearly
/// touch.
TriangleMesh TrefoilTube(int along, int around, double tubeRadius = 0.8);

/// Torus with the given radii, of genus 1.
TriangleMesh Torus(int along, int around, double radius, double tubeRadius);

/// counts³ disjoint unit cubes at distance `gap` (thesis Fig. 6.5 with counts = 6).
TriangleMesh CubeArray(int counts, int facesPerEdge, double gap);

/// Two parallel flat sheets at distance `gap`.
TriangleMesh TwoSheets(int n, double gap);

/// A belt pulley of outer radius 1 and genus 1. It is a surface of revolution around z with a hub,
/// a thin web and a rim with a V groove. 0 < wallThickness <= 0.2.
TriangleMesh Pulley(int around, double wallThickness);

/// Moves every point p to map(p).
TriangleMesh Mapped(TriangleMesh mesh, const std::function<Vec3(const Vec3&)>& map);

/// A smooth map that bends every plane.
Vec3 Bend(const Vec3& p);

/// Returns the points 0, step, 2 step, ...
std::vector<Id> EveryPoint(const TriangleMesh& mesh, Id step);

/// Splits every triangle into four at the midpoints of its edges. A shared midpoint is a single
/// point.
TriangleMesh SubdivideInPlane(const TriangleMesh& mesh);

/// Gives every triangle three points of its own, as in an STL file.
TriangleMesh Unweld(const TriangleMesh& mesh);

/// Turns a part of the triangles round, so that they face the other way.
TriangleMesh TurnSome(TriangleMesh mesh, double part, unsigned seed);

/// Maps p to scale * R p + shift, where R is the rotation by `angle` (radians) about `axis`.
TriangleMesh Transform(const TriangleMesh& mesh, const Vec3& axis, double angle, double scale = 1.0,
  const Vec3& shift = { 0, 0, 0 });

/// Joins two meshes into one. The points of b follow the points of a.
TriangleMesh Join(const TriangleMesh& a, const TriangleMesh& b);

/// Reads a triangle mesh of the real data sets: a binary little-endian PLY, ASCII or binary STL
/// (corners unwelded), OFF or OBJ file. Throws std::runtime_error. It is only for tests of Core,
/// which do not use VTK.
TriangleMesh ReadMesh(const std::string& path);

/// Returns the path of a file in the folder of real meshes, or an empty string if there is none.
/// The folder is GRIDFEM_DATA_DIR from the environment, or ../shared/data beside the source tree.
std::string RealMesh(const std::string& name);

} // namespace gridfem::testing

#endif
