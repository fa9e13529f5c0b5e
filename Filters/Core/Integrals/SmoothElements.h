// Element matrices of the quadratic B-splines of a grid. [T §7.2]
#ifndef GridFEM_SmoothElements_h
#define GridFEM_SmoothElements_h

#include "Integrals/ElementMatrices.h"

namespace gridfem
{

using SmoothElementMatrix = BasicElementMatrix<SmoothFunctionsPerPatch>;
using SmoothElementMatrices = BasicElementMatrices<SmoothFunctionsPerPatch>;

/// Lowest degree of a quadrature rule for products of quadratic functions. The products on a tilted
/// triangle have degree 12. Lower terms decide the order of the error.
constexpr int SmoothQuadratureDegree = 6;

/// Lowest weight s of |∂n u|² for quadratic functions. On a surface, 27 functions of a cell act
/// like nine. The weights of the first two derivatives along the normal determine the others. With
/// 1e-3 cycles need about ten iterations to 1e-8 on any surface. [NUMERICS §7]
constexpr double SmoothStabilization = 1e-3;

/// Weights of the integrals on each source triangle; null: those of the mesh itself.
struct SmoothWeights
{
  const std::vector<double>* mass = nullptr;            // w of ∫ w b_i b_j
  const std::vector<Eigen::Matrix3d>* tensor = nullptr; // T of ∫ <∇b_i, T ∇b_j>, in the plane
  const std::vector<double>* normal = nullptr;          // multiplies the weights along the normal
};

/// Integrates over every piece like IntegrateElements. The stiffness also contains |∂nn u|² with
/// the weight s / 5, in grid units. Without it, functions that grow like the square of the distance
/// from the surface would have no weight.
SmoothElementMatrices IntegrateSmoothElements(const GridFunctions& grid, const QuadratureRule& rule,
  double normalStabilization, const SmoothWeights& weights = {}, const Job& job = {});

/// Galerkin coarsening, like CoarsenElements for trilinear functions.
void CoarsenElements(const SmoothLevel& fine, const SmoothLevel& coarse,
  const SmoothElementMatrices& elements, SmoothElementMatrices& result, int threads = 0);

template<>
const BasicOctantWeights<SmoothFunctionsPerPatch>& ChildWeights<SmoothFunctionsPerPatch>(
  int octant);

} // namespace gridfem

#endif
