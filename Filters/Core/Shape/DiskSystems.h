// Linear systems of the maps of a disk.
#ifndef GridFEM_DiskSystems_h
#define GridFEM_DiskSystems_h

#include "Base/Job.h"
#include "Shape/DiskMetric.h"

#include <Eigen/SparseCholesky>

#include <memory>
#include <vector>

namespace gridfem
{

using DiskMatrix = Eigen::SparseMatrix<double>;

/// Returns the stiffness of the hat functions, with cotangents of angles.
/// @param weight  a factor for each triangle
DiskMatrix CotangentStiffness(
  const Disk& disk, const std::vector<SideLengths>& sides, const std::vector<double>& weight);

/// Factors of a matrix without the row and column of vertex 0, where all solutions are 0.
class PinnedSystem
{
public:
  /// Matrices may follow one another if their entries are at the same places.
  /// @return whether the matrix has factors
  bool Factor(const DiskMatrix& matrix, const Job& job);

  MultiVector Solve(const Eigen::MatrixXd& b, const Job& job) const;

private:
  std::unique_ptr<Eigen::SimplicialLDLT<DiskMatrix>> factors_;
};

/// The part of a matrix between the inner vertices of a disk. Values on the loop are given.
class InnerSystem
{
public:
  /// Keeps a reference to the disk. Throws InvalidInput if the matrix has no factors.
  InnerSystem(const Disk& disk, const DiskMatrix& matrix, const Job& job);

  /// Returns the solution at all vertices, with 0 on the loop.
  /// @param b  one row for each vertex; those of the loop do not count
  MultiVector Solve(const Eigen::MatrixXd& b, const Job& job) const;

  /// Solves with 0 on the right-hand side.
  /// @param onLoop  a row for each vertex of the loop
  MultiVector Extend(const Eigen::MatrixXd& onLoop, const Job& job) const;

private:
  Eigen::MatrixXd SolveInner(const Eigen::MatrixXd& b) const;

  const Disk& disk_;
  std::vector<Index> row_; // of each vertex among the inner ones; ~place on the loop
  Index inner_ = 0;        // number of inner vertices
  DiskMatrix toLoop_;      // rows of inner vertices, columns of the loop
  Eigen::SimplicialLDLT<DiskMatrix> factors_;
};

/// Throws InvalidInput: a matrix has no factors.
[[noreturn]] void RefuseSystem();

} // namespace gridfem

#endif
