// Rayleigh-Ritz: the best approximations of eigenpairs of L x = θ M x within the span of a few
// vectors. The vectors may be linearly dependent, and M may be singular on their span: dependent
// directions are detected and left out. Used by the block iteration and, with all unit vectors, by
// the dense coarse solve.
#ifndef GridFEM_RayleighRitz_h
#define GridFEM_RayleighRitz_h

#include "Base/PrecisionTraits.h"
#include "Base/Types.h"

#include <vector>

namespace gridfem
{

struct RitzPairs
{
  Eigen::VectorXd values;       // ascending
  Eigen::MatrixXd coefficients; // one column per pair, orthonormal in the mass matrix
};

/// Returns the lowest pairs of stiffness c = θ mass c: `wanted` of them, or fewer if fewer exist.
/// Both matrices are symmetric positive semi-definite and of equal size. Vectors that both matrices
/// map to zero do not count.
/// It solves for the largest pairs of mass c = μ (stiffness + shift mass) c with μ =
/// 1 / (θ + shift). Rounding then harms the highest pairs, not the lowest, and directions without
/// mass are harmless.
/// @param shift     > 0, about the size of the lowest values of θ
/// @param smallest  smallest pivot of an independent direction; see PrecisionTraits::DependentPivot
RitzPairs SolvePencil(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass, double shift,
  Index wanted, double smallest = PrecisionTraits<double>::DependentPivot);

} // namespace gridfem

#endif
