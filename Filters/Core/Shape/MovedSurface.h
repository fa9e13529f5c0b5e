// A mesh whose points have moved: its size and shape, and the distortion of the map from the mesh.
// [T §5.1, §6.2.3]
#ifndef GridFEM_MovedSurface_h
#define GridFEM_MovedSurface_h

#include "Grid/SurfaceEdges.h"

namespace gridfem
{

/// Size of a surface, in units of its points. It refers to the centroid, so it does not depend on
/// the place.
struct SurfaceSize
{
  double area = 0.0;
  // Enclosed volume; an open surface has the volume of the cone to the centroid. Negative if the
  // triangles face inward.
  double volume = 0.0;
  Vec3 centroid = Vec3::Zero(); // of the area

  /// π^(1/3) (6 |volume|)^(2/3) / area: 1 for a sphere, less for every other closed surface.
  double Sphericity() const;
};

/// Size of a surface. Cost O(triangles); same bits for any number of threads, as for all functions
/// below.
SurfaceSize SizeOf(const std::vector<Vec3>& points, const std::vector<std::array<Id, 3>>& triangles,
  int threads = 0);

/// Distortion of the map from each triangle of the mesh to its moved triangle.
struct MapDistortion
{
  /// The new area of each triangle over its old area; 1 on triangles that had no area.
  std::vector<double> areaRatio;
  /// The larger over the smaller stretch of the map on each triangle. It ranges from 1 (angles are
  /// kept) to LargestRatio. It is 1 on triangles that had no area.
  std::vector<double> stretchRatio;

  static constexpr double LargestRatio = 1e7;
};

/// @param moved  the current points of the mesh
MapDistortion DistortionOf(
  const TriangleMesh& mesh, const std::vector<Vec3>& moved, int threads = 0);

/// Means at the points of the values on adjacent triangles, weighted by the triangles' area in the
/// mesh. Points without a triangle that has an area get `none`.
std::vector<double> MeansAtPoints(
  const TriangleMesh& mesh, const std::vector<double>& onTriangles, double none, int threads = 0);

/// The mean over the mesh, weighted by area.
double MeanOverSurface(
  const TriangleMesh& mesh, const std::vector<double>& onTriangles, int threads = 0);

/// Unit normals; 0 for triangles without an area.
std::vector<Vec3> NormalsOfTriangles(const TriangleMesh& mesh);

/// The sum of the area vectors of the triangles around each point: three columns.
MultiVector AreaVectorsAtPoints(
  const std::vector<Vec3>& points, const std::vector<std::array<Id, 3>>& triangles);

/// Rows of three numbers as unit vectors; a zero row stays zero.
std::vector<Vec3> UnitVectors(const MultiVector& rows, int threads = 0);

/// Unit normals at the points, averaged over adjacent triangles with weights by area; 0 where they
/// cancel.
std::vector<Vec3> NormalsAtPoints(const std::vector<Vec3>& points,
  const std::vector<std::array<Id, 3>>& triangles, int threads = 0);

/// Whether the surface is closed, in one piece and without handles. Coincident points count as one.
/// The conformalized flow turns such a surface into a sphere.
bool IsLikeASphere(const TriangleMesh& mesh, int threads = 0);

struct SurfaceBoundary
{
  std::vector<TriangleEdge> edges; // edges of one triangle, ascending
  std::vector<Id> points;          // their ends, and points welded to them, ascending
};

/// The boundary of a mesh.
/// @param weldCoincidentPoints  coincident points count as one
SurfaceBoundary BoundaryOf(const TriangleMesh& mesh, bool weldCoincidentPoints, int threads = 0);

} // namespace gridfem

#endif
