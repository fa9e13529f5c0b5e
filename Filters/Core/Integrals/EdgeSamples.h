// Samples along segments of triangles: what integrals over boundaries and other curves are sums of.
#ifndef GridFEM_EdgeSamples_h
#define GridFEM_EdgeSamples_h

#include "Algebra/SparseMatrix.h"
#include "Grid/GridFunctions.h"
#include "Grid/SurfaceEdges.h"

#include <vector>

namespace gridfem
{

/// Of a rule on [0, 1] that is exact up to degree 5: functions of a grid are cubic along a line.
struct GaussPoint
{
  double position;
  double weight;
};
constexpr GaussPoint GaussPoints[3] = { { 0.1127016653792583, 5.0 / 18.0 }, { 0.5, 8.0 / 18.0 },
  { 0.8872983346207417, 5.0 / 18.0 } };

/// Integrals over the segments of a function of the space times a linear one are exact.
struct EdgeSamples
{
  std::vector<Index> edge;      // of each sample: which of the given segments it is on, ascending
  std::vector<double> position; // 0 at the first end of the segment, 1 at the other
  std::vector<char> isMiddle;   // of a stretch on which functions are not linear
  std::vector<double> length;   // that the sample stands for, world units
  SparseMatrix rows;            // the values of all functions: rows = samples
};

/// ∫ f b_i along the segments: rows = functions, columns as `values`.
/// @param values  f at the samples
MultiVector IntegrateAlong(const EdgeSamples& samples, const MultiVector& values);

/// Segments fall into stretches at the faces of the cells, each with three Gauss points. Triangles
/// without a piece, which have no area, have no samples. Where processes divide the surface, each
/// has the samples on its own pieces, and of the others none.
/// Cost O(pieces + samples log pieces).
/// Throws InvalidInput for a triangle that the mesh does not have.
EdgeSamples SampleSegments(const GridFunctions& space, const TriangleMesh& mesh,
  const std::vector<TriangleSegment>& segments);

/// The point of a segment at t from 0 to 1, of a triangle with these corners.
inline Vec3 PointOfSegment(
  const TriangleSegment& segment, double t, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 weight = (1.0 - t) * segment.from + t * segment.to;
  return weight[0] * a + weight[1] * b + weight[2] * c;
}

} // namespace gridfem

#endif
