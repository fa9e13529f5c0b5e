// The classical system the peers solve: piecewise linear hat functions on the mesh, consistent area
// mass and cotangent stiffness [T (3.9), (3.10)], assembled row by row as fast as one thread can.
#ifndef GridFEM_Benchmarks_HatMatrices_h
#define GridFEM_Benchmarks_HatMatrices_h

#include "TriangleMesh.h"

#include <Eigen/SparseCore>

#include <vector>

namespace gridfem::benchmarks
{

/// Symmetric, both triangles stored, indices of each column ascending: it may be read by rows too.
using HatMatrix = Eigen::SparseMatrix<double>;

/// World units. Both matrices have one pattern.
struct HatMatrices
{
  HatMatrix mass;       // L²
  HatMatrix stiffness;  // dimensionless
  std::vector<int> row; // per mesh point; -1 for points without a triangle
};

/// Triangles without area are left out. Cost O(triangles), one thread.
HatMatrices AssembleHats(const TriangleMesh& mesh);

/// λM + L.
HatMatrix Combine(const HatMatrices& hats, double lambda);

/// Values at the points of the mesh as values of the rows.
Eigen::MatrixXd ToRows(const HatMatrices& hats, const MultiVector& values);

} // namespace gridfem::benchmarks

#endif
