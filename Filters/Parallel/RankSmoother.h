// The patch smoother on a level that several ranks divide.
#ifndef GridFEM_RankSmoother_h
#define GridFEM_RankSmoother_h

#include "Multigrid/Multigrid.h"
#include "Parallel/RankMatrices.h"

#include <exception>
#include <memory>
#include <vector>

namespace gridfem
{

/// The patches of a rank's cells, relaxed one after the other, in up to three steps. Patches
/// without a function of another rank do not meet those of other ranks: all ranks relax them at
/// once, as one rank would, without a message. Then, from the residual that is left, those with
/// functions of one other rank, and last those where more ranks meet; corrections of these are
/// divided by the number of ranks, so that together they do not overshoot. A backward sweep is the
/// adjoint of a forward one. Residuals are not weighted: a part of a residual would not be
/// consistent where the matrix is singular on a few functions, as on small flat pieces.
class RankSmoother
{
public:
  /// Collective.
  /// @param matrix  of all ranks
  /// @param own     what this rank's patches add to it
  RankSmoother(const Communicator& ranks, Mat matrix, const SparseMatrix& own,
    const LevelNumbering& numbering, const PatchLevel& level, const MultigridOptions& options);

  /// Collective. Improves x for A x = b by one sweep. When the work of this rank throws, it takes
  /// part in all messages first.
  void Sweep(Vec b, Vec x, SweepDirection direction);

private:
  /// Patches that other ranks meet.
  struct Step
  {
    std::unique_ptr<Smoother> smoother;
    double damping;
  };

  void FindFunctions(const LevelNumbering& numbering, const PatchLevel& level);
  void Load(Vec b, Vec x);
  void Store(Vec x) const;
  void RelaxAlone(SweepDirection direction);
  void RelaxShared(const Step& step, SweepDirection direction);
  void FindResidual();
  template<class Body>
  void Keep(Body&& body);

  int threads_;
  Index foreign_;             // functions of other ranks, which come first
  std::vector<Index> shared_; // functions that other ranks touch, too, ascending
  std::vector<Index> near_;   // other functions of patches with shared ones
  SparseMatrix matrix_;       // of all functions that touch this rank's cells; lacks nothing
  SparseMatrix ownShared_;    // what this rank's patches add to the rows of the shared functions
  std::unique_ptr<Smoother> alone_;
  std::vector<Step> steps_; // the same number on all ranks
  LevelVectors exchange_;   // of the shared functions
  PetscVector sum_;
  std::vector<double> entries_; // of the shared functions
  // Of all functions that touch this rank's cells:
  MultiVector b_;
  MultiVector x_;
  MultiVector residual_; // for the shared and near ones
  MultiVector change_;   // zero but for the shared and near ones
  std::exception_ptr failure_;
};

} // namespace gridfem

#endif
