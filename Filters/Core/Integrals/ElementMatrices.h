// Element matrices: per patch 36 integrals of products of its eight functions. [T (4.1), (4.2)]
// Grid units: mass in cell sides squared, stiffness dimensionless.
#ifndef GridFEM_ElementMatrices_h
#define GridFEM_ElementMatrices_h

#include "Base/Job.h"
#include "Grid/GridFunctions.h"
#include "Integrals/QuadratureRule.h"

#include <vector>

namespace gridfem
{

/// Entries of a symmetric element matrix, upper triangle row by row.
constexpr int ElementEntries = FunctionsPerPatch * (FunctionsPerPatch + 1) / 2;

/// Position of entry (row, column) in the packed upper triangle; order of the arguments is free.
constexpr int PackedIndex(int row, int column)
{
  return row <= column ? row * FunctionsPerPatch - row * (row - 1) / 2 + (column - row)
                       : PackedIndex(column, row);
}

using ElementMatrix = std::array<double, ElementEntries>;

struct ElementMatrices
{
  Array<ElementMatrix> mass;      // ∫ b_i b_j
  Array<ElementMatrix> stiffness; // ∫ <∇b_i, ∇b_j> tangential + s ∫ ∂n b_i ∂n b_j
};

/// Which of both get new values; the others stay what they are.
enum class ElementParts
{
  Both,
  Mass
};

/// The weight s of |∂n u|² in the stiffness (normal-gradient stabilisation: Burman, Hansbo, Larson,
/// Massing 2018), in (0, 1]. On a nearly flat piece of surface a function can be almost zero
/// although its coefficients are not; its energy is the square of the surface's roughness, which
/// for coordinates in single precision is as small as rounding. Such functions are neither zero nor
/// known and stop any solver. The default lifts their energy to what double precision can resolve
/// and changes solutions by no more than its root, in general by no more than itself. With 1e-2 the
/// iterations to any tolerance do not grow with the depth, and the error of the space is 1.1 to 1.4
/// times as large on scans and parts, two to four times on spheres and cubes, whose own is the
/// smallest; its rate stays. [NUMERICS §6; Testing/Benchmarks]
constexpr double DefaultNormalStabilization = 1e-12;

/// Integrates over every piece with `rule` on every triangle of its fan. [T Alg. 4.1]
/// Pieces of zero area contribute nothing. Cost O(clipped triangles x points); same bits for any
/// number of threads.
/// @param weight  of the mass on each source triangle, ∫ w b_i b_j; null: 1
/// @param tensor  symmetric, in the plane of each source triangle, ∫ <∇b_i, T ∇b_j>; null: the
///                projection to the plane
ElementMatrices IntegrateElements(const GridFunctions& space, const QuadratureRule& rule,
  const Job& job = {}, double normalStabilization = DefaultNormalStabilization,
  const std::vector<double>* weight = nullptr,
  const std::vector<Eigen::Matrix3d>* tensor = nullptr);

/// Galerkin coarsening: adds every patch's matrix, interpolated, to its parent's. [T (4.6)]
/// Same bits for any number of threads.
/// @param result  gets one entry per patch of `coarse`, in place where it has its size already
void CoarsenElements(const PatchLevel& fine, const PatchLevel& coarse,
  const ElementMatrices& elements, ElementMatrices& result, int threads = 0,
  ElementParts parts = ElementParts::Both);

/// Weights with which the eight functions of a parent cell make up those of the child in `octant`:
/// value of the child's corner c = Σ_p weights[c][p] value of the parent's corner p.
using OctantWeights = std::array<std::array<double, FunctionsPerPatch>, FunctionsPerPatch>;
const OctantWeights& ChildWeights(int octant);

} // namespace gridfem

#endif
