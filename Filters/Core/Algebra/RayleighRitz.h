// Rayleigh-Ritz: the best approximations of eigenpairs of L x = θ M x inside the span of a few
// vectors. The span may be dependent and M may be singular on it: dependent directions are found
// and left out. Used by the block iteration and, with all unit vectors, by the dense coarse solve.
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

/// The lowest pairs of stiffness c = θ mass c, at most `wanted`; fewer when fewer exist. Both are
/// symmetric positive semi-definite, of equal size; what both map to zero does not count. Solved
/// as the largest pairs of mass c = μ (stiffness + shift mass) c, μ = 1 / (θ + shift): rounding
/// then harms the highest pairs, not the lowest, and directions with mass zero are harmless.
/// @param shift     > 0, about the size of the lowest values of θ
/// @param smallest  pivot of an independent direction; see PrecisionTraits::DependentPivot
RitzPairs SolvePencil(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass, double shift,
  Index wanted, double smallest = PrecisionTraits<double>::DependentPivot);

} // namespace gridfem

#endif
