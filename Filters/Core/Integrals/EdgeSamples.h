// Samples along segments of triangles. Integrals over boundaries and other curves are sums over
// them.
#ifndef GridFEM_EdgeSamples_h
#define GridFEM_EdgeSamples_h

#include "Algebra/SparseMatrix.h"
#include "Grid/GridFunctions.h"
#include "Grid/SurfaceEdges.h"

#include <vector>

namespace gridfem
{

/// A point of a quadrature rule on [0, 1] that is exact up to degree 5. Trilinear functions are
/// cubic along a line. Quadratic B-splines have degree six, with small last terms.
struct GaussPoint
{
  double position;
  double weight;
};
constexpr GaussPoint GaussPoints[3] = { { 0.1127016653792583, 5.0 / 18.0 }, { 0.5, 8.0 / 18.0 },
  { 0.8872983346207417, 5.0 / 18.0 } };

/// Samples on segments. They integrate a trilinear function times a linear function exactly.
struct EdgeSamples
{
  std::vector<Index> edge;      // index of the segment that contains the sample, ascending
  std::vector<double> position; // 0 at the first end of the segment, 1 at the other
  std::vector<char> isMiddle;   // whether the sample is in the middle of its stretch, on which
                                // functions are not linear
  std::vector<double> length;   // length that the sample represents, world units
  SparseMatrix rows;            // the values of all functions: rows = samples
};

/// Returns ∫ f b_i along the segments: rows = functions, columns as `values`.
/// @param values  f at the samples
MultiVector IntegrateAlong(const EdgeSamples& samples, const MultiVector& values);

/// Samples segments. The faces of cells divide a segment into stretches with three Gauss points
/// each. Triangles without a piece have no area and get no samples. If several processes divide the
/// surface, each process samples only its own pieces.
/// Cost O(pieces + samples log pieces). Throws InvalidInput for a triangle that the mesh does not
/// have.
/// @param level  functions on the finest patches of the space
template<int Functions>
EdgeSamples SampleSegments(const GridFunctions& space, const BasicPatchLevel<Functions>& level,
  const TriangleMesh& mesh, const std::vector<TriangleSegment>& segments);

/// Returns the point of a segment at parameter t in [0, 1], in a triangle with corners a, b and c.
inline Vec3 PointOfSegment(
  const TriangleSegment& segment, double t, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 weight = (1.0 - t) * segment.from + t * segment.to;
  return weight[0] * a + weight[1] * b + weight[2] * c;
}

} // namespace gridfem

#endif
