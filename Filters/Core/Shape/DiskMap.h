// Maps a disk to the plane.
#ifndef GridFEM_DiskMap_h
#define GridFEM_DiskMap_h

#include "Shape/DiskMetric.h"

#include <Eigen/SparseCholesky>

#include <memory>

namespace gridfem
{

/// Maps of one disk. All of them solve systems with the cotangent stiffness of the hat functions of
/// the disk, because a map that is linear on each triangle can be checked for folds. The boundary
/// has its own rows, and the same two matrices serve many right-hand sides. So they are factored,
/// by one thread; the same bits result on any number of threads.
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
  /// a triangle is turned over, weights below a hundredth become a hundredth. Such a map has no
  /// folds except by rounding [Tutte 1963, Floater 1997].
  MultiVector ToCircle(const Job& job);

  /// A map that changes lengths as little as possible. Steps fit a rotation to every triangle, and
  /// then the map to all rotations [Liu et al. 2008, local/global; As Rigid As Possible]. A step
  /// becomes shorter if it would turn a triangle over.
  /// @param plane  the map at the start
  MultiVector Isometric(MultiVector plane, const Job& job);

  const std::vector<SideLengths>& Sides() const { return sides_; }

private:
  using Matrix = Eigen::SparseMatrix<double>;
  using Factor = Eigen::SimplicialLDLT<Matrix>;

  MultiVector Extend(const Eigen::MatrixXd& onBoundary, const Job& job = {});
  MultiVector SolvePinned(const Eigen::MatrixXd& b, const Job& job = {});
  Eigen::MatrixXd LayOutBoundary(const Job& job);
  bool HasTurned(const MultiVector& plane) const;

  const Disk& disk_;
  std::vector<SideLengths> sides_;
  std::vector<Index> row_; // of each vertex among the inner ones; ~place on the loop
  Index inner_ = 0;        // number of inner vertices
  Matrix stiffness_;       // of all vertices
  Matrix toBoundary_;      // rows of inner vertices, columns of the loop
  std::unique_ptr<Factor> ofInner_;
  std::unique_ptr<Factor> pinned_; // without vertex 0
};

} // namespace gridfem

#endif
