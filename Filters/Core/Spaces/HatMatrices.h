// Area mass and cotangent stiffness of the hat functions. [T (3.9), (3.10)]
#ifndef GridFEM_HatMatrices_h
#define GridFEM_HatMatrices_h

#include "Algebra/SparseMatrix.h"
#include "Integrals/DirectionalElements.h"
#include "Integrals/TriangleMetric.h"
#include "Spaces/HatFunctions.h"

namespace gridfem
{

/// The matrices of the hat functions. Both have the same pattern: functions that share a triangle.
/// Each row of the stiffness sums to 0. Negative cotangents are kept. The stiffness is still
/// positive semi-definite, because it is a sum of positive semi-definite element matrices.
struct HatMatrices
{
  SparseMatrix mass;            // ∫ φ_i φ_j, in squared units of length
  SparseMatrix stiffness;       // ∫ <∇φ_i, ∇φ_j>, dimensionless
  std::vector<double> integral; // ∫ φ_i, the lumped mass
};

/// Weights of the integrals over every triangle.
struct HatWeights
{
  const TriangleMetric* metric = nullptr; // null: the metric of the mesh
  /// Weights of the mass, and of the stiffness along and across a direction; null: 1. The weights
  /// of the stiffness are ignored in a metric and without directions.
  const std::vector<ElementWeights>* weights = nullptr;
  const std::vector<Vec3>* direction = nullptr;
};

/// Assembles the matrices. Cost O(triangles); same bits for any number of threads, and bitwise
/// symmetric.
HatMatrices AssembleHatMatrices(const TriangleMesh& mesh, const HatFunctions& hats,
  const HatWeights& weights = {}, int threads = 0);

/// Returns the sum over the triangles of scale * stiffness * u, with the same weights.
/// @param scale  one number per triangle; empty: 1
/// @param u      rows = functions; the result has its size
/// Throws InvalidInput when a number of rows does not fit. Same bits for any number of threads.
MultiVector MultiplyHats(const TriangleMesh& mesh, const HatFunctions& hats,
  const HatWeights& weights, const std::vector<double>& scale, const MultiVector& u,
  int threads = 0);

} // namespace gridfem

#endif
