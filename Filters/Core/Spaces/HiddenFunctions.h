// The nearly invisible functions of a level: the distance to the surface times a smooth function φ.
// They vanish on a flat piece of surface but for what the grid cannot interpolate, with energy
// h²|∇φ|². The same function of a coarser grid has (2h)²|∇φ|², so a hierarchy of B-splines corrects
// them by a quarter per level. Here is one that knows their size on the finest grid: with D the
// distances of the grid's corners, D P are the functions in question and Pᵀ D A D P, coarsened
// further as usual, are their energies.
#ifndef GridFEM_HiddenFunctions_h
#define GridFEM_HiddenFunctions_h

#include "Spaces/LevelOperators.h"

#include <algorithm>
#include <vector>

namespace gridfem
{

/// Signed distance of every function's corner from the surface in its support: the mean over its
/// patches' planes, weighted with ∫ b_i; cell sides. Planes are found in the element matrices: the
/// stiffness of the three coordinates is ∫ I - n nᵀ. Their sides agree where neighbours are less
/// than 45 degrees apart and is arbitrary otherwise. 0 for functions without area. Cost O(patches),
/// partly serial; same bits for any number of threads.
std::vector<double> CornerHeights(const PatchLevel& level, const FunctionPlaces& places,
  const ElementMatrices& elements, int threads = 0);

/// Share of the area, in [0, 1], where the surface is flat over four of the finest cells: there the
/// second coarser level still has hidden functions. Cost O(patches of that level); same bits for
/// any number of threads.
double FlatShare(const LevelOperators& system, int threads = 0);

/// ∫ I - n nᵀ over a patch: the stiffness of the coordinates, which are sums of the corners'
/// functions.
Eigen::Matrix3d StiffnessOfCoordinates(const ElementMatrix& stiffness);

/// D (M + L) D of one patch, D the diagonal matrix of the factors at its corners.
ElementMatrix ScaledEnergy(
  const ElementMatrices& elements, Id patch, const std::array<double, FunctionsPerPatch>& factor);

/// The hierarchy for the hidden functions of the finest level, with A = M + L. None where the
/// system has one level.
HiddenLevels BuildHiddenLevels(
  const GridFunctions& space, const LevelOperators& system, int threads = 0);

/// The size of a M + b L on hidden functions in units of M + L: the least of which the correction
/// is never too large. It is nearly exact for a <= b, because hidden functions are parabolas t (1 -
/// t) across cells, of which ∫ u² is a tenth of ∫ u'². So one hierarchy serves every λ.
inline double SizeOnHidden(double a, double b)
{
  return std::max(a, b);
}

} // namespace gridfem

#endif
