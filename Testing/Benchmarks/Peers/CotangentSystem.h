// The classical system of the peers: piecewise linear hat functions on the mesh, consistent area
// mass and cotangent stiffness [T (3.9), (3.10)]. One thread assembles it row by row as fast as
// possible.
#ifndef GridFEM_Benchmarks_CotangentSystem_h
#define GridFEM_Benchmarks_CotangentSystem_h

#include "Grid/TriangleMesh.h"

#include <Eigen/SparseCore>

#include <vector>

namespace gridfem::benchmarks
{

/// Symmetric, both triangles stored, indices of each column ascending: it may be read by rows too.
using SymmetricMatrix = Eigen::SparseMatrix<double>;

/// World units. Both matrices have one pattern.
struct CotangentSystem
{
  SymmetricMatrix mass;      // L²
  SymmetricMatrix stiffness; // dimensionless
  std::vector<int> row;      // per mesh point; -1 for points without a triangle
};

/// Triangles without area are left out. Cost O(triangles), one thread.
CotangentSystem AssembleCotangents(const TriangleMesh& mesh);

/// λM + L.
SymmetricMatrix Combine(const CotangentSystem& hats, double lambda);

/// Values at the points of the mesh as values of the rows.
Eigen::MatrixXd ToRows(const CotangentSystem& hats, const MultiVector& values);

} // namespace gridfem::benchmarks

#endif
