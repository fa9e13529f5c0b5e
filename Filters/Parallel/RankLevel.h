// A level that several ranks divide, for the cycle: the patches on the borders between ranks, and
// the transfer to the next coarser level.
#ifndef GridFEM_RankLevel_h
#define GridFEM_RankLevel_h

#include "Grid/PatchLevel.h"
#include "Multigrid/DistributedLevel.h"
#include "Parallel/RankRows.h"

#include <functional>
#include <memory>
#include <vector>

namespace gridfem
{

/// The patches of a level, grouped by the number of ranks that touch their functions: this rank
/// alone, one other rank, or more.
std::vector<PatchLevel> PatchesByRanks(const PatchLevel& level, const LevelNumbering& numbering);

/// The patches that a rank relaxes at the same time as other ranks, as places among the functions
/// of the border.
struct BorderStep
{
  PatchOrder single; // for Gauss-Seidel before the patches
  PatchOrder patches;
  double damping = 1.0; // factor of the corrections
};

/// The unknowns of a level that are relaxed together with other ranks, and their patches.
struct LevelBorder
{
  std::vector<Index> functions; // ascending; includes all functions that several ranks hold
  /// Makes the steps for the matrix of these functions, the same number on all ranks.
  std::function<std::vector<BorderStep>(const SparseMatrix& matrix)> steps;
};

/// Collective. The border for the result of PatchesByRanks, with up to two steps: patches that one
/// other rank touches, and patches that more ranks touch. Corrections are divided by the number of
/// ranks, so that together they do not overshoot.
LevelBorder BorderOfPatches(
  const Communicator& ranks, const LevelNumbering& numbering, const std::vector<PatchLevel>& parts);

/// Collective. The border of hats: functions that several ranks hold, and functions coupled to
/// them. Each is relaxed by its owner in groups as on one rank (GroupByCoupling). Ranks with
/// coupled functions take turns. They need the complete relaxation, because a matrix of hats
/// without a stiffness is far from the grid's matrix, and the grid's corrections alone are too
/// poor.
/// @param A  this rank's part of the matrix
LevelBorder BorderOfGroups(
  const Communicator& ranks, const LevelNumbering& numbering, const SparseMatrix& A, int threads);

/// The smoother and the transfer of a distributed level. A sweep relaxes the patches of a rank's
/// cells in steps. Patches without functions of other ranks do not touch patches of other ranks.
/// All ranks relax them at the same time, without a message, with the result of one rank. The
/// patches of the border follow, each step from the remaining residual. A backward sweep is the
/// adjoint of a forward sweep. Residuals are not weighted. A weighted part would not be consistent
/// where the matrix is singular on a few functions, as on small flat pieces.
class RankLevel : public DistributedLevel
{
public:
  /// Collective. Keeps references to the rows.
  /// @param coarse   rows of the next coarser level; null: all ranks hold it whole
  /// @param A        this rank's part of the matrix
  RankLevel(const Communicator& ranks, const LevelNumbering& numbering, const RankRows& rows,
    const RankRows* coarse, LevelBorder border, const SparseMatrix& A, int threads);

  const DistributedRows& Rows() const override { return rows_; }
  void SumCoarse(Block<float> x) const override;
  void SumCoarse(Block<double> x) const override;
  const std::vector<Index>& Border() const override { return border_; }
  void Relax(Id columns, SweepDirection direction,
    const std::function<void(MultiVector& part)>& residual,
    const std::function<void(const MultiVector& correction)>& correct) const override;

private:
  struct Step
  {
    std::unique_ptr<Smoother> smoother;
    double damping;
  };

  Communicator ranks_;
  const RankRows& rows_;
  const RankRows* coarse_;
  int threads_;
  std::vector<Index> border_; // functions of patches that touch other ranks, ascending
  // Rows and columns of these functions:
  std::unique_ptr<RankRows> borderRows_;
  SparseMatrix matrix_;     // complete
  std::vector<Step> steps_; // the same number on all ranks
};

} // namespace gridfem

#endif
