// A mesh whose points have moved: its size and shape, and how the map from the mesh distorts.
// [T §5.1, §6.2.3]
#ifndef GridFEM_MovedSurface_h
#define GridFEM_MovedSurface_h

#include "Grid/SurfaceEdges.h"

namespace gridfem
{

/// In units of the points; about the centroid, so that it does not depend on the place.
struct SurfaceSize
{
  double area = 0.0;
  double volume = 0.0;          // enclosed, of an open surface that of the cone to the centroid;
                                // negative where the triangles are turned inwards
  Vec3 centroid = Vec3::Zero(); // of the area

  /// π^(1/3) (6 |volume|)^(2/3) / area: 1 for a sphere, less for every other closed surface.
  double Sphericity() const;
};

/// Cost O(triangles); same bits for any number of threads, as for all below.
SurfaceSize SizeOf(const std::vector<Vec3>& points, const std::vector<std::array<Id, 3>>& triangles,
  int threads = 0);

/// What the map from a triangle of the mesh to where it has gone does.
struct MapDistortion
{
  /// Per triangle: its area over what it was; 1 on triangles that had none.
  std::vector<double> areaRatio;
  /// Per triangle: the larger over the smaller stretch of the map, from 1 (angles are kept) to
  /// LargestRatio; 1 on triangles that had no area.
  std::vector<double> stretchRatio;

  static constexpr double LargestRatio = 1e7;
};

/// @param moved  the points of the mesh, where they are now
MapDistortion DistortionOf(
  const TriangleMesh& mesh, const std::vector<Vec3>& moved, int threads = 0);

/// Means at the points of values on the triangles around them, weighted by the triangles' area in
/// the mesh; `none` at points without a triangle that has an area.
std::vector<double> MeansAtPoints(
  const TriangleMesh& mesh, const std::vector<double>& onTriangles, double none, int threads = 0);

/// The mean over the mesh, weighted by its area.
double MeanOverSurface(
  const TriangleMesh& mesh, const std::vector<double>& onTriangles, int threads = 0);

/// Unit normals; 0 for triangles without an area.
std::vector<Vec3> NormalsOfTriangles(const TriangleMesh& mesh);

/// Sums of the area vectors of the triangles around each point: three columns.
MultiVector AreaVectorsAtPoints(
  const std::vector<Vec3>& points, const std::vector<std::array<Id, 3>>& triangles);

/// Rows of three numbers as unit vectors; 0 for 0.
std::vector<Vec3> UnitVectors(const MultiVector& rows, int threads = 0);

/// Unit normals at the points, of the triangles around them weighted by area; 0 where they cancel.
std::vector<Vec3> NormalsAtPoints(const std::vector<Vec3>& points,
  const std::vector<std::array<Id, 3>>& triangles, int threads = 0);

/// Whether the surface is closed, in one piece and without handles, coincident points counting as
/// one: what the conformalised flow makes a sphere of.
bool IsLikeASphere(const TriangleMesh& mesh, int threads = 0);

struct SurfaceBoundary
{
  std::vector<TriangleEdge> edges; // of one triangle, ascending
  std::vector<Id> points;          // their ends, and what counts as one with these, ascending
};

/// @param weldCoincidentPoints  coincident points count as one
SurfaceBoundary BoundaryOf(const TriangleMesh& mesh, bool weldCoincidentPoints, int threads = 0);

} // namespace gridfem

#endif
