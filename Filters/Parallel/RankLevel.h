// A level that several ranks divide, for the cycle: patches on the borders between ranks, and the
// way to the next coarser level.
#ifndef GridFEM_RankLevel_h
#define GridFEM_RankLevel_h

#include "Grid/PatchLevel.h"
#include "Multigrid/DividedLevel.h"
#include "Parallel/RankRows.h"

#include <functional>
#include <memory>
#include <vector>

namespace gridfem
{

/// Patches of a level by the ranks that touch their functions: this rank alone, one other rank,
/// more.
std::vector<PatchLevel> PatchesByRanks(const PatchLevel& level, const LevelNumbering& numbering);

/// What a rank relaxes at the same time as other ranks, places among the functions of the border.
struct BorderStep
{
  PatchOrder single; // for Gauss-Seidel, before the patches
  PatchOrder patches;
  double damping = 1.0; // of corrections
};

/// Unknowns of a level that are relaxed with those of other ranks, and in which patches.
struct LevelBorder
{
  std::vector<Index> functions; // ascending; with all that several ranks hold
  /// Steps for the matrix of these: as many on all ranks.
  std::function<std::vector<BorderStep>(const SparseMatrix& matrix)> steps;
};

/// Collective. Of PatchesByRanks, in up to two steps: patches that one other rank meets, and those
/// that more do. Corrections are divided by the number of ranks, so that together they do not
/// overshoot.
LevelBorder BorderOfPatches(
  const Communicator& ranks, const LevelNumbering& numbering, const std::vector<PatchLevel>& parts);

/// Collective. Functions that several ranks hold, and those coupled to them, each relaxed by its
/// owner in groups as on one rank (GroupByCoupling). Ranks whose functions are coupled take turns:
/// a matrix of hats without a stiffness is too far from that of the grid for corrections of the
/// grid to do without the whole relaxation.
/// @param A  what this rank adds to the matrix
LevelBorder BorderOfGroups(
  const Communicator& ranks, const LevelNumbering& numbering, const SparseMatrix& A, int threads);

/// A sweep relaxes the patches of a rank's cells one after the other, in steps. Patches without a
/// function of another rank do not meet those of other ranks: all ranks relax them at once, as one
/// rank would, without a message. Then those of the border, each step from the residual that is
/// left. A backward sweep is the adjoint of a forward one. Residuals are not weighted: a part of a
/// residual would not be consistent where the matrix is singular on a few functions, as on small
/// flat pieces.
class RankLevel : public DividedLevel
{
public:
  /// Collective. Keeps references to the rows.
  /// @param coarse   rows of the next coarser level; null: all ranks hold it whole
  /// @param A        what this rank adds to the matrix
  RankLevel(const Communicator& ranks, const LevelNumbering& numbering, const RankRows& rows,
    const RankRows* coarse, LevelBorder border, const SparseMatrix& A, int threads);

  const DividedRows& Rows() const override { return rows_; }
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
  std::vector<Index> border_; // functions of patches that other ranks meet, ascending
  // Rows and columns of these:
  std::unique_ptr<RankRows> borderRows_;
  SparseMatrix matrix_;     // which lacks nothing
  std::vector<Step> steps_; // the same number on all ranks
};

} // namespace gridfem

#endif
