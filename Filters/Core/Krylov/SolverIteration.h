// What conjugate gradients and repeated cycles have in common.
#ifndef GridFEM_SolverIteration_h
#define GridFEM_SolverIteration_h

#include "Krylov/ConjugateGradients.h"
#include "Krylov/Stagnation.h"

#include <vector>

namespace gridfem
{

/// The residual r, z = B r, their measures, and which columns still iterate. The columns of r and z
/// that do not are zero, so that they neither change x nor spread NaN. Keeps references.
class SolverIteration
{
public:
  SolverIteration(const LinearOperator& A, const Preconditioner& B, const MultiVector& b,
    MultiVector& x, const SolveOptions& options, const Projection& project);

  bool CanGoOn() const
  {
    return this->IsActive() && report_.iterations < options_.maximumIterations;
  }
  bool IsActive() const { return isActive_.any(); }
  bool IsActive(Id column) const { return isActive_[column]; }

  /// Counts an iteration and reports progress; throws Aborted.
  void Begin(const Progress& progress);

  /// r = b - A x in the columns that iterate.
  void ComputeResidual();

  /// z = B r and its measures; retires columns that are done.
  void Measure();

  /// Ends the iteration of a column. One that has converged by energy takes z, which is there.
  void Retire(Id column, SolveEnd end);

  /// Looks at the true residual of converged columns: an updated one drifts away by rounding. Those
  /// that were wrong iterate again, from z.
  void Confirm();

  SolveReport Finish();

  MultiVector r;
  MultiVector z;
  Columns rz;      // rᵀz of the columns that iterate
  Columns slowest; // see Iterate

private:
  void MeasureZero();
  void Precondition(const MultiVector& residual, MultiVector& correction, Columns& energy) const;
  void SetReference(const Columns& workOfStart);
  void Judge();
  void JudgePace();
  bool IsSolved(Id column) const;
  void Record();

  const LinearOperator& A_;
  const Preconditioner& B_;
  const MultiVector& b_;
  MultiVector& x_;
  const SolveOptions& options_;
  const Projection& project_;

  Eigen::Array<bool, Eigen::Dynamic, 1> isActive_;
  std::vector<SolveEnd> end_; // per column; IterationLimit while it iterates
  bool takesLast_ = true;     // a column that is done takes z
  Columns reference_;         // of the energy; see IterationRecord
  Columns residualOfZero_;
  Columns energy_;     // relative to the first
  Columns residual_;   // relative to the second
  ColumnMeasures own_; // of options_.measureBy; empty without
  Stagnation stagnation_;
  SolveReport report_;
};

} // namespace gridfem

#endif
