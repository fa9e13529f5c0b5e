// The metric of a disk: lengths, angles and areas of its triangles, without regard to its place in
// space.
#ifndef GridFEM_DiskMetric_h
#define GridFEM_DiskMetric_h

#include "Shape/OpenedSurface.h"

namespace gridfem
{

using Vec2 = Eigen::Vector2d;

/// A triangle by the lengths of its sides. Side k runs from corner k to the next corner.
struct SideLengths
{
  std::array<double, 3> length;

  double Area() const;              // [Kahan, Miscalculating area and angles of a triangle]
  double AngleAt(int corner) const; // radians
  double CotangentAt(int corner) const;

  /// The corners in the plane: the first is the origin, and the second lies on the x axis.
  std::array<Vec2, 3> InPlane() const;
};

/// Returns the sides of all triangles. If a triangle has no area, all sides become longer by the
/// same tiny length that gives it one [Sharp and Crane 2020, mollification].
std::vector<SideLengths> MeasureTriangles(const Disk& disk);

/// How a map to the plane distorts a triangle.
struct ChartDistortion
{
  /// The largest change of the angle between two directions, degrees. 0: angles stay. 180: the
  /// triangle collapses or is flipped.
  double angle;
  double area; // binary logarithm of the ratio of areas: 0 if it stays, 1 if it doubles
  bool isFlipped;
};

/// @param plane  a row of two coordinates for each vertex
std::vector<ChartDistortion> MeasureDistortion(
  const Disk& disk, const std::vector<SideLengths>& sides, const MultiVector& plane);

/// Total area of the triangles in the plane, negative if flipped. Filled holes do not count.
double AreaInPlane(const Disk& disk, const MultiVector& plane);

} // namespace gridfem

#endif
