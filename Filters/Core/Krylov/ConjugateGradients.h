// Iterative solution of A x = b with a preconditioner, for several right-hand sides at once.
#ifndef GridFEM_ConjugateGradients_h
#define GridFEM_ConjugateGradients_h

#include "Base/Progress.h"
#include "Krylov/LinearOperator.h"

#include <functional>
#include <vector>

namespace gridfem
{

/// An iteration where it is looked at.
struct Iterate
{
  const MultiVector& x;
  const MultiVector& correction; // B r, which x takes when the iteration ends
  /// Per right-hand side the smallest Ritz value of B A that conjugate gradients have found: what
  /// is slowest to converge is reduced by 1 - this at each cycle. Not a number before the first
  /// step and for cycles alone.
  const Columns& slowest;
};

/// Per right-hand side, and what it has to fall to.
struct ColumnMeasures
{
  Columns value;
  Columns wanted;
};

struct SolveOptions
{
  double tolerance = 1e-8;     // on the stopping measure as in IterationRecord; > 0
  int maximumIterations = 100; // >= 1
  /// What has to fall below the tolerance: the energy estimate sqrt(rᵀBr) or the residual |r|.
  enum class Measure
  {
    Energy,
    Residual
  } measure = Measure::Energy;
  /// What ends an iteration before maximumIterations, as stagnated.
  enum class GiveUp
  {
    Never,
    AtStandstill, // Stagnation::IsAtStandstill
    WhenTooSlow   // Stagnation::IsTooSlow: for those who can go on with a better cycle
  } giveUp = GiveUp::Never;
  /// A measure of its own, where it is set. A column is done when this or the tolerance says so.
  /// Called once before each iteration and at the end; columns that are done already come with a
  /// correction of 0.
  std::function<ColumnMeasures(const Iterate&)> measureBy;
};

/// The state of x before the correction B r of that iteration; the largest over the right-hand
/// sides.
struct IterationRecord
{
  int iteration;
  /// sqrt(rᵀBr) over the size of the solution: an estimate of the relative error in the energy norm
  /// |·|_A. From a start of zero the size is sqrt(bᵀBb). From another start x it is the lower bound
  /// bᵀx / |x|_A, unless x is farther from the solution than this bound; then it is sqrt(bᵀBb) too.
  double energy;
  double residual;  // |r| / |b|
  double own = 0.0; // the value of SolveOptions::measureBy
};

/// Why an iteration ended; of several right-hand sides, what comes last here.
enum class SolveEnd
{
  Converged,
  IterationLimit,
  NotFinite,  // a right-hand side is not
  Stagnation, // see SolveOptions::GiveUp
  Breakdown   // a direction without positive energy, or numbers without bounds
};

struct SolveReport
{
  bool converged = false; // end == Converged
  SolveEnd end = SolveEnd::IterationLimit;
  int iterations = 0;
  std::vector<IterationRecord> history; // iteration 0 is the start
  double convergenceFactor = 0.0;       // mean reduction of the energy measure per iteration
  int doubleSince = -1;                 // iteration of the fall-back to double precision; -1: none
};

/// What `convergenceFactor` is.
double MeanFactor(const SolveReport& report);

/// One history of steps that follow each other.
void Append(const SolveReport& step, SolveReport& report);

/// Of several solves: what has not converged, or else has taken more iterations, replaces `kept`.
void KeepWorse(SolveReport report, SolveReport& kept);

/// Keeps an iteration out of directions that are solved otherwise, such as the constants of each
/// component. A must map what `solution` keeps to what `residual` keeps; the two are each other's
/// transposes. Both empty: no projection.
struct Projection
{
  std::function<void(MultiVector&)> solution; // removes the direction from x and from B r
  std::function<void(MultiVector&)> residual; // removes it from b and from b - A x
};

/// Preconditioned conjugate gradients; each column has its own steps, and stops
/// on its own. Starts from x, or from zero where x is far beyond. A column that has converged by
/// energy still takes its last correction B r, which was computed for the measure: it lowers the
/// energy of the error once more. A column with b = 0 gives x = 0. NaN in b or a breakdown ends the
/// iteration with converged = false and the last finite x. Throws Aborted.
SolveReport SolveConjugateGradients(const LinearOperator& A, const Preconditioner& B,
  const MultiVector& b, MultiVector& x, const SolveOptions& options, const Projection& project = {},
  const Progress& progress = {});

/// x += B (b - A x), repeated: cycles alone.
SolveReport SolveCycles(const LinearOperator& A, const Preconditioner& B, const MultiVector& b,
  MultiVector& x, const SolveOptions& options, const Projection& project = {},
  const Progress& progress = {});

} // namespace gridfem

#endif
