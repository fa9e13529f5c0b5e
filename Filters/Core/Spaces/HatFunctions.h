// The hat functions of a triangle mesh: continuous, linear on every triangle, 1 at one point and 0
// at all others. They are the finest level of the hybrid solver. [T §3.2, §4.2 Hat-Basis
// Incorporation]
#ifndef GridFEM_HatFunctions_h
#define GridFEM_HatFunctions_h

#include "Grid/TriangleMesh.h"

#include <vector>

namespace gridfem
{

struct HatOptions
{
  bool weldCoincidentPoints = true; // coincident points share one function
  double unitLength = 1.0;          // world units; all integrals are in it. > 0
  int threads = 0;                  // 0: all
};

/// A corner of a triangle, packed: 3 triangle + corner.
struct TriangleCorner
{
  Index packed;
  Id Triangle() const { return packed / 3; }
  int Corner() const { return static_cast<int>(packed % 3); }
};

/// Triangles flatter than 1e-10 of their longest edge have no direction and take no part: points
/// that have no other triangles have no function.
struct HatFunctions
{
  double unitLength = 1.0;
  std::vector<Index> ofPoint; // per mesh point: its function; -1 where there is none
  /// Triangles around function i: corners[begin[i] .. begin[i + 1]), ascending.
  Array<Index> begin;
  std::vector<TriangleCorner> corners;
  std::vector<Index> component; // per function; triangles that share a function are connected
  Index numberOfComponents = 0;

  Index Count() const { return static_cast<Index>(component.size()); }
};

/// Numbers the functions along a Morton curve, so that neighbours are near in memory. Throws
/// InvalidInput when the unit is not a positive number or there are more than 2^31 - 1 functions.
/// Cost O(points + triangles); the same for any number of threads.
HatFunctions NumberHatFunctions(const TriangleMesh& mesh, const HatOptions& options = {});

/// A triangle as the hat functions see it, in their unit of length.
struct HatTriangle
{
  std::array<Vec3, 3> edge; // opposite to corner k, from corner k + 1 to k + 2
  Vec3 areaVector;          // along the normal, its length is twice the area
  double area;

  HatTriangle(const TriangleMesh& mesh, Id triangle, double unitLength);

  bool IsFlat() const;

  /// ∇φ_k; not for flat triangles.
  Vec3 Gradient(int k) const { return areaVector.cross(edge[k]) / areaVector.squaredNorm(); }
};

/// Values of the functions at the mesh's points: rows = points, columns as `coefficients`; 0 at
/// points without a function.
MultiVector ValuesAtPoints(
  const HatFunctions& hats, const MultiVector& coefficients, int threads = 0);

/// Gradients on the triangles, world units: rows = triangles, three columns for each of the
/// coefficients'; 0 on flat triangles.
MultiVector GradientsOnTriangles(const HatFunctions& hats, const TriangleMesh& mesh,
  const MultiVector& coefficients, int threads = 0);

/// How many triangles that carry functions have become flat in a mesh whose points have moved.
Id CountFlattened(const HatFunctions& hats, const TriangleMesh& moved, int threads = 0);

} // namespace gridfem

#endif
