// An independent reference: piecewise linear hat functions on the mesh itself, with cotangent
// stiffness and area mass [T (3.9), (3.10)], factored by Eigen. It shares no code with Core except
// the mesh type.
#ifndef GridFEM_Testing_HatSystem_h
#define GridFEM_Testing_HatSystem_h

#include "Grid/TriangleMesh.h"

#include <Eigen/SparseCore>

#include <vector>

namespace gridfem::testing
{

struct HatSystem
{
  Eigen::SparseMatrix<double> mass;      // world units, L²
  Eigen::SparseMatrix<double> stiffness; // dimensionless
  /// The row of each point in the matrices, or -1 for points without a triangle. Coincident points
  /// share a row.
  std::vector<int> row;
};

/// Builds the matrices. Triangles without area are left out.
HatSystem BuildHatSystem(const TriangleMesh& mesh);

/// Solves (λM + L) u = λ M f. f and u have one row per mesh point.
Eigen::MatrixXd SolveHatPoisson(
  const TriangleMesh& mesh, const HatSystem& system, double lambda, const Eigen::MatrixXd& f);

/// Returns the smallest `count` eigenvalues of L x = α M x, by subspace iteration, to about 1e-8.
std::vector<double> HatEigenvalues(const HatSystem& system, int count);

} // namespace gridfem::testing

#endif
