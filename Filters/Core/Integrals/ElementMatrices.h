// Element matrices: for each patch, the integrals of products of its functions. Eight functions
// have 36 such products. [T (4.1), (4.2)] In grid units, mass is in squared cell sides and
// stiffness is dimensionless.
#ifndef GridFEM_ElementMatrices_h
#define GridFEM_ElementMatrices_h

#include "Base/Job.h"
#include "Grid/GridFunctions.h"
#include "Integrals/QuadratureRule.h"

#include <vector>

namespace gridfem
{

/// Number of entries of a symmetric element matrix, stored as its upper triangle row by row.
constexpr int ElementEntries = FunctionsPerPatch * (FunctionsPerPatch + 1) / 2;

/// Position of entry (row, column) in the packed upper triangle. The order of the arguments does
/// not matter.
template<int Functions = FunctionsPerPatch>
constexpr int PackedIndex(int row, int column)
{
  return row <= column ? row * Functions - row * (row - 1) / 2 + (column - row)
                       : PackedIndex<Functions>(column, row);
}

template<int Functions>
using BasicElementMatrix = std::array<double, Functions*(Functions + 1) / 2>;

template<int Functions>
struct BasicElementMatrices
{
  Array<BasicElementMatrix<Functions>> mass; // ∫ b_i b_j
  Array<BasicElementMatrix<Functions>> stiffness; // ∫ <∇b_i, ∇b_j> tangential + s ∫ ∂n b_i ∂n b_j
};

using ElementMatrix = BasicElementMatrix<FunctionsPerPatch>;
using ElementMatrices = BasicElementMatrices<FunctionsPerPatch>;

/// Selects the matrices that receive new values. The others stay unchanged.
enum class ElementParts
{
  Both,
  Mass
};

/// The weight s of |∂n u|² in the stiffness, in (0, 1] (normal-gradient stabilization: Burman,
/// Hansbo, Larson, Massing 2018). On a nearly flat piece of surface, a function can almost vanish
/// although its coefficients do not. Its energy is the square of the surface's roughness. For
/// coordinates in single precision, this is as small as rounding errors. Such functions are neither
/// zero nor determined, and they stop any solver.
/// The default raises their energy to a level that double precision can resolve. It changes
/// solutions by at most its square root, and in general by at most its own size. With 1e-2, the
/// number of iterations to any tolerance does not grow with the depth. The error of the space then
/// is 1.1 to 1.4 times as large on scans and parts. On spheres and cubes, where the error is
/// smallest, it is two to four times as large. Its rate of convergence does not change. [NUMERICS
/// §6; Testing/Benchmarks]
constexpr double DefaultNormalStabilization = 1e-12;

/// Integrates over every piece, with `rule` on every triangle of its fan. [T Alg. 4.1]
/// Pieces of zero area contribute nothing. Cost O(clipped triangles x points); same bits for any
/// number of threads.
/// @param weight  weight w of the mass on each source triangle, ∫ w b_i b_j; null: 1
/// @param tensor  symmetric tensor T in the plane of each source triangle, ∫ <∇b_i, T ∇b_j>; null:
///   the projection to the plane
ElementMatrices IntegrateElements(const GridFunctions& space, const QuadratureRule& rule,
  const Job& job = {}, double normalStabilization = DefaultNormalStabilization,
  const std::vector<double>* weight = nullptr,
  const std::vector<Eigen::Matrix3d>* tensor = nullptr);

/// Galerkin coarsening: interpolates every patch's matrix and adds it to the matrix of its parent.
/// [T (4.6)] Same bits for any number of threads.
/// @param result  receives one entry per patch of `coarse`, in place if its size is already right
void CoarsenElements(const PatchLevel& fine, const PatchLevel& coarse,
  const ElementMatrices& elements, ElementMatrices& result, int threads = 0,
  ElementParts parts = ElementParts::Both);

/// The weights with which the functions of a parent cell give the coefficients of its child's
/// functions in `octant`. The coefficient of the child's function c is Σ_p weights[c][p] times the
/// coefficient of the parent's function p.
template<int Functions>
using BasicOctantWeights = std::array<std::array<double, Functions>, Functions>;
using OctantWeights = BasicOctantWeights<FunctionsPerPatch>;
template<int Functions = FunctionsPerPatch>
const BasicOctantWeights<Functions>& ChildWeights(int octant);
template<>
const OctantWeights& ChildWeights<FunctionsPerPatch>(int octant);

} // namespace gridfem

#endif
