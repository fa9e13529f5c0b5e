// Heat that has spread from its sources for a time t, to the same relative accuracy everywhere,
// however little of it arrives: (M + t L) u = b, u ~ exp(-distance / sqrt(t)).
//
// The error of a Krylov iteration is a share of the largest value, and heat falls by many powers of
// ten. Relaxation of one patch looks at its neighbours alone, so that its error is a share of what
// is there. So patches are relaxed in the order in which heat comes to them, some layers at a time,
// until the first of these layers change no more; what comes later changes them little.
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
  /// Functions on components with sources to which no heat came because it would be below the
  /// smallest number, 1e-308.
  Id unreached = 0;
  double sweeps = 0.0;    // patches relaxed over patches
  bool converged = false; // no patch changes by more than some hundredths of the heat it has
};

/// The equation for one time, ready for any number of sources. Const methods are safe to call from
/// several threads.
class DistantHeat
{
public:
  /// A layer is left when no patch of it changes by more of its heat. Changes halve from sweep to
  /// sweep, so that errors are of the same size; they give distances that are off by some 1e-4 of
  /// their range.
  static constexpr double SmallChange = 3e-3;

  /// What a last sweep over all may change when nothing is wrong, of that: some layers were left
  /// early.
  static constexpr double LastChange = 10.0;

  /// @param space  one whose patches settle their neighbourhood: a grid's
  /// @param level  of the space, on which the equation is solved. √t should be two to four
  /// distances
  ///   between its functions: with less they oscillate, with more relaxation takes long
  /// @param t      in squared units of length; > 0
  /// Throws Aborted, and InvalidInput when there is no such level.
  DistantHeat(const FiniteElementSpace& space, std::size_t level, double t, const Job& job = {},
    double change = SmallChange);

  /// The same of a part of a surface that other processes have the rest of.
  /// @param A        M / t + L. Rows of the unknowns of patches lack nothing.
  /// @param patches  that are relaxed here; other unknowns stay as they are
  DistantHeat(SparseMatrix A, const UnknownGroups& patches, double t, double change, int threads);

  /// @param load  one column: Σ b_i(source), b_i the functions of the finest level
  /// @return      coefficients of the finest level
  /// Throws InvalidInput when its rows do not fit, and Aborted. Same bits for any number of
  /// threads.
  HeatField From(const MultiVector& load, const Job& job = {}) const;

  /// From heat that is there already, on the level.
  HeatField Continue(const MultiVector& load, MultiVector heat, const Job& job = {}) const;

  /// The largest change of a patch over its heat, when each is relaxed once more.
  double ChangeOf(const MultiVector& load, MultiVector heat) const;

  /// M / t + L on the level
  const SparseMatrix& Matrix() const { return A_; }

private:
  /// Patches in the order in which heat comes to them, cut into layers.
  struct Layers
  {
    std::vector<Index> patch;
    std::vector<Id> begin; // layers + 1

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
  std::vector<double> size_; // sqrt(A_ii), what a coefficient counts: one whose function has hardly
                             // any surface may be large and says nothing
  std::optional<PatchInverses> patches_;
  std::optional<CoarseSolver> direct_; // a start on the coarsest level, where t may be very large
  double t_;
  double change_;
};

} // namespace gridfem

#endif
