// The distance through space from points and segments. No path along a surface is shorter.
#ifndef GridFEM_StraightDistance_h
#define GridFEM_StraightDistance_h

#include "Grid/TriangleMesh.h"

#include <array>
#include <vector>

namespace gridfem
{

/// The two ends of a straight line. They are equal for a single point.
using Segment = std::array<Vec3, 2>;

double DistanceFromSegment(const Segment& segment, const Vec3& place);

/// Finds the nearest of many segments. A query visits the few boxes of a tree that are near enough.
class SegmentTree
{
public:
  /// Cost O(n log n).
  explicit SegmentTree(std::vector<Segment> segments);

  /// The distance from the nearest segment; infinite if there is none.
  double DistanceFrom(const Vec3& place) const;

private:
  /// A box around some segments. Its first child is the next box.
  struct Box
  {
    Vec3 low;
    Vec3 high;
    Index begin;
    Index end;
    Index secondChild; // 0: the box has no children
  };

  Index Build(Index begin, Index end);

  std::vector<Segment> segments_;
  std::vector<Box> boxes_;
};

/// The distance from the nearest segment at every point of the mesh. It is 0 without a segment, as
/// the lower bound of a distance that nothing is known about. Same bits for any order of the
/// segments and any number of threads.
std::vector<double> DistancesThroughSpace(
  const TriangleMesh& mesh, std::vector<Segment> segments, int threads);

/// The places where paths from the sources begin. They are the sources themselves, and the rims of
/// the regions whose triangles have sources at all corners. Sources within such a region are left
/// out.
/// @param isSource  per point of the mesh
std::vector<Segment> RimOfSources(
  const TriangleMesh& mesh, const std::vector<char>& isSource, int threads);

} // namespace gridfem

#endif
