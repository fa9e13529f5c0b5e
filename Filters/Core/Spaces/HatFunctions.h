// The hat functions of a triangle mesh. They are continuous and linear on every triangle, 1 at one
// point and 0 at all others. They are the finest level of the hybrid solver
// [T §3.2, §4.2 Hat-Basis Incorporation].
#ifndef GridFEM_HatFunctions_h
#define GridFEM_HatFunctions_h

#include "Grid/TriangleMesh.h"

#include <vector>

namespace gridfem
{

struct HatOptions
{
  bool weldCoincidentPoints = true; // coincident points share one function
  double unitLength = 1.0;          // unit of all integrals, in world units; > 0
  int threads = 0;                  // 0: all processors
};

/// A corner of a triangle, packed as 3 triangle + corner.
struct TriangleCorner
{
  Index packed;
  Id Triangle() const { return packed / 3; }
  int Corner() const { return static_cast<int>(packed % 3); }
};

/// The hat functions of a mesh and the triangles around them. Triangles flatter than 1e-10 of their
/// longest edge have no plane and are left out. Points with only such triangles have no function.
struct HatFunctions
{
  double unitLength = 1.0;
  std::vector<Index> ofPoint; // the function of each mesh point; -1: none
  /// The triangles around function i are corners[begin[i] .. begin[i + 1]), ascending.
  Array<Index> begin;
  std::vector<TriangleCorner> corners;
  std::vector<Index> component; // of each function; triangles that share a function are connected
  Index numberOfComponents = 0;

  Index Count() const { return static_cast<Index>(component.size()); }
};

/// Numbers the functions along a Morton curve, so that neighbors are close in memory. Throws
/// InvalidInput when the unit is not a positive number or there are more than 2^31 - 1 functions.
/// Cost O(points + triangles); the result is the same for any number of threads.
HatFunctions NumberHatFunctions(const TriangleMesh& mesh, const HatOptions& options = {});

/// The geometry of a triangle, in the unit of length of the hat functions.
struct HatTriangle
{
  std::array<Vec3, 3> edge; // edge[k] is opposite to corner k, from corner k + 1 to k + 2
  Vec3 areaVector;          // along the normal, with twice the area as its length
  double area;

  HatTriangle(const TriangleMesh& mesh, Id triangle, double unitLength);

  bool IsFlat() const;

  /// Returns ∇φ_k. Not valid for flat triangles.
  Vec3 Gradient(int k) const { return areaVector.cross(edge[k]) / areaVector.squaredNorm(); }
};

/// Returns the values of functions at the mesh's points: rows = points, columns as `coefficients`.
/// Points without a function get 0.
MultiVector ValuesAtPoints(
  const HatFunctions& hats, const MultiVector& coefficients, int threads = 0);

/// Returns gradients on the triangles, in world units: rows = triangles, three columns for each
/// column of `coefficients`. Flat triangles get 0.
MultiVector GradientsOnTriangles(const HatFunctions& hats, const TriangleMesh& mesh,
  const MultiVector& coefficients, int threads = 0);

/// Returns how many triangles with functions have become flat in a mesh with moved points.
Id CountFlattened(const HatFunctions& hats, const TriangleMesh& moved, int threads = 0);

} // namespace gridfem

#endif
