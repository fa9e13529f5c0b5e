// Maps a disk to the plane.
#ifndef GridFEM_DiskMap_h
#define GridFEM_DiskMap_h

#include "Shape/DiskSystems.h"

#include <memory>

namespace gridfem
{

/// Maps of one disk, with the area of the surface. All of them solve systems with the cotangent
/// stiffness of the hat functions of the disk, because a map that is linear on each triangle can be
/// checked for folds. The boundary has its own rows, and one matrix serves many right-hand sides.
/// So it is factored, by one thread; the same bits result on any number of threads.
class DiskMap
{
public:
  /// Keeps a reference.
  explicit DiskMap(const Disk& disk);

  /// A map that keeps angles, as far as triangles allow, and the scale along the boundary
  /// [Sawhney and Crane 2017, Boundary First Flattening]. Their last step extends one coordinate
  /// from the boundary and conjugates it. Here, both coordinates are extended, and the mean with
  /// their conjugates leaves out the part that mirrors angles. Turning the disk therefore turns the
  /// map.
  MultiVector Conformal(const Job& job);

  /// A harmonic map whose boundary runs around a circle, each edge with its share of the length. If
  /// a triangle is flipped, weights below a hundredth become a hundredth. Such a map has no folds
  /// except by rounding [Tutte 1963, Floater 1997].
  MultiVector ToCircle(const Job& job);

  /// Whether a map flips a triangle.
  bool HasFlipped(const MultiVector& plane) const;

  const std::vector<SideLengths>& Sides() const { return sides_; }

private:
  const InnerSystem& Inner(const Job& job);
  Eigen::MatrixXd LayOutBoundary(const Job& job);
  MultiVector WithAreaOfSurface(MultiVector plane) const;

  const Disk& disk_;
  std::vector<SideLengths> sides_;
  DiskMatrix stiffness_; // of all vertices
  std::unique_ptr<InnerSystem> inner_;
};

} // namespace gridfem

#endif
