// The common part of conjugate gradients and repeated cycles.
#ifndef GridFEM_SolverIteration_h
#define GridFEM_SolverIteration_h

#include "Krylov/ConjugateGradients.h"
#include "Krylov/Stagnation.h"

#include <vector>

namespace gridfem
{

/// The residual r, the correction z = B r, their measures, and the columns that still iterate. All
/// other columns of r and z are zero, so that they neither change x nor spread NaN. Keeps
/// references to its arguments.
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

  /// Counts an iteration and reports progress. Throws Aborted.
  void Begin(const Progress& progress);

  /// Computes r = b - A x in the columns that iterate.
  void ComputeResidual();

  /// Computes z = B r and its measures, and retires the columns that are done.
  void Measure();

  /// Ends the iteration of a column. A column that has converged by energy also takes z, which is
  /// already there.
  void Retire(Id column, SolveEnd end);

  /// Checks converged columns against their true residual, because an updated residual drifts away
  /// by rounding. Columns that have not really converged iterate again, from z.
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
  void EndIfStagnant();
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
  bool takesLast_ = true;     // a finished column takes z
  Columns reference_;         // reference of the energy; see IterationRecord
  Columns residualOfZero_;
  Columns energy_;     // relative to reference_
  Columns residual_;   // relative to residualOfZero_
  ColumnMeasures own_; // of options_.measureBy; empty without it
  Stagnation stagnation_;
  SolveReport report_;
};

} // namespace gridfem

#endif
