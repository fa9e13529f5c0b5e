// Area mass and cotangent stiffness of the hat functions. [T (3.9), (3.10)]
#ifndef GridFEM_HatMatrices_h
#define GridFEM_HatMatrices_h

#include "Algebra/SparseMatrix.h"
#include "Spaces/HatFunctions.h"

namespace gridfem
{

/// Both matrices have the same pattern: functions that share a triangle. Each row of the stiffness
/// sums to 0. Negative cotangents are kept; the matrix is positive semi-definite all the same,
/// being a sum of element matrices that are.
struct HatMatrices
{
  SparseMatrix mass;            // ∫ φ_i φ_j, unit of length squared
  SparseMatrix stiffness;       // ∫ <∇φ_i, ∇φ_j>, dimensionless
  std::vector<double> integral; // ∫ φ_i, the lumped mass
};

/// Cost O(triangles); same bits for any number of threads, and bitwise symmetric.
HatMatrices AssembleHatMatrices(
  const TriangleMesh& mesh, const HatFunctions& hats, int threads = 0);

/// a M + b L
SparseMatrix Combine(const HatMatrices& matrices, double a, double b, int threads = 0);

} // namespace gridfem

#endif
