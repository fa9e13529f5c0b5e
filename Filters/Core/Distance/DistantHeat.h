// Heat that has spread from its sources for a time t: (M + t L) u = b, u ~ exp(-distance /
// sqrt(t)). It has the same relative accuracy everywhere, even where very little of it arrives.
//
// The error of a Krylov iteration is a fraction of the largest value, and heat falls by many powers
// of ten. Relaxing one patch involves only its neighbors, so its error is a fraction of the local
// heat. Patches are therefore relaxed in the order in which heat reaches them, some layers at a
// time, until the first of these layers settle. Later layers change them little.
#ifndef GridFEM_DistantHeat_h
#define GridFEM_DistantHeat_h

#include "Algebra/SparseMatrix.h"
#include "Base/Job.h"
#include "Multigrid/CoarseSolver.h"
#include "Multigrid/PatchInverses.h"

#include <optional>
#include <vector>

namespace gridfem
{

class FiniteElementSpace;

struct HeatField
{
  MultiVector coefficients; // one column; 0 on components without a source
  /// Number of functions on components with sources that heat did not reach, because it would be
  /// below the smallest number, 1e-308.
  Id unreached = 0;
  double sweeps = 0.0;    // number of relaxed patches over the number of patches
  bool converged = false; // no patch changes by more than some hundredths of its heat
};

/// The equation for one time, ready for any number of sources. Const methods are safe to call from
/// several threads.
class DistantHeat
{
public:
  /// A layer is settled when no patch changes by more than this fraction of its heat. Changes halve
  /// from sweep to sweep, so errors have the same size. Distances are then off by about 1e-4 of
  /// their range.
  static constexpr double SmallChange = 3e-3;

  /// Largest change of a final sweep over all patches that counts as converged, in units of the
  /// change above. It is larger than 1 because some layers were left early.
  static constexpr double LastChange = 10.0;

  /// @param space  a space whose patches resolve their neighborhood, such as a grid's
  /// @param level  level of the space on which the equation is solved. √t should be two to four
  ///   distances between its functions. With less they oscillate, with more relaxation takes long
  /// @param t      in squared units of length; > 0
  /// Throws Aborted, and InvalidInput when there is no such level.
  DistantHeat(const FiniteElementSpace& space, std::size_t level, double t, const Job& job = {},
    double change = SmallChange);

  /// The equation on one part of a surface; other processes have the rest.
  /// @param A        M / t + L, complete in the rows of the patches' unknowns
  /// @param patches  patches that are relaxed here; all other unknowns keep their values
  DistantHeat(SparseMatrix A, const UnknownGroups& patches, double t, double change, int threads);

  /// The heat of these sources.
  /// @param load  one column: Σ b_i(source), b_i the functions of the finest level
  /// @return      coefficients on the finest level
  /// Throws InvalidInput when its rows do not fit, and Aborted. Same bits for any number of
  /// threads.
  HeatField From(const MultiVector& load, const Job& job = {}) const;

  /// Continues from heat that is already there. The load and the heat belong to the level.
  HeatField Continue(const MultiVector& load, MultiVector heat, const Job& job = {}) const;

  /// The largest change of a patch relative to its heat, when each patch is relaxed once more.
  double ChangeOf(const MultiVector& load, MultiVector heat) const;

  /// M / t + L on the level.
  const SparseMatrix& Matrix() const { return A_; }

private:
  /// Patches in the order in which heat reaches them, cut into layers.
  struct Layers
  {
    std::vector<Index> patch;
    std::vector<Id> begin; // size: layers + 1

    Id Count() const { return static_cast<Id>(begin.size()) - 1; }
  };

  void Factor(const UnknownGroups& patches, int threads);
  HeatField OnLevel(const MultiVector& load, MultiVector before, const Job& job) const;
  std::vector<Index> StepsFromSources(const MultiVector& load, const MultiVector& u) const;
  Layers LayersByRank(const std::vector<double>& rank) const;
  Layers LayersBySteps(const std::vector<Index>& steps) const;
  Layers LayersByHeat(const MultiVector& u, Id count, const std::vector<Index>& patches) const;
  double HeatOf(Index patch, const MultiVector& u) const;
  void FetchAfter(const Layers& layers, Id k) const;
  double Relax(Index patch, const MultiVector& b, MultiVector& u) const;
  Id March(const Layers& layers, double change, const MultiVector& b, MultiVector& u,
    const Job& job) const;
  Id CountUnreached(const Layers& layers, const MultiVector& u) const;

  std::vector<SharedMatrix> prolongations_; // from level l + 1 to l, down to the level
  std::vector<SharedMatrix> restrictions_;
  SparseMatrix A_;
  // sqrt(A_ii), the weight of a coefficient. A function with hardly any surface may have a large
  // coefficient that means nothing.
  std::vector<double> size_;
  std::optional<PatchInverses> patches_;
  std::optional<CoarseSolver> direct_; // a start on the coarsest level, where t may be very large
  double t_;
  double change_;
};

} // namespace gridfem

#endif
