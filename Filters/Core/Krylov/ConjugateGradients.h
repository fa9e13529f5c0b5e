// Iterative solution of A x = b with a preconditioner, for several right-hand sides at once.
#ifndef GridFEM_ConjugateGradients_h
#define GridFEM_ConjugateGradients_h

#include "Base/Progress.h"
#include "Krylov/LinearOperator.h"

#include <functional>
#include <string>
#include <vector>

namespace gridfem
{

/// The state of an iteration, for a measure of the caller's own.
struct Iterate
{
  const MultiVector& x;
  const MultiVector& correction; // B r, which is added to x when the iteration ends
  /// Smallest Ritz value of B A that conjugate gradients have found, per right-hand side. Each
  /// cycle reduces the slowest component of the error by the factor 1 - this value. NaN before the
  /// first step and in SolveCycles.
  const Columns& slowest;
};

/// A measure per right-hand side, and the value that it has to reach.
struct ColumnMeasures
{
  Columns value;
  Columns wanted;
};

struct SolveOptions
{
  double tolerance = 1e-8;     // on the measure of IterationRecord chosen below; > 0
  int maximumIterations = 100; // >= 1
  /// The measure that has to fall below the tolerance: the energy estimate sqrt(rᵀBr) or the
  /// residual |r|.
  enum class Measure
  {
    Energy,
    Residual
  } measure = Measure::Energy;
  /// When an iteration ends as stagnated, before maximumIterations.
  enum class GiveUp
  {
    Never,
    AtStandstill, // Stagnation::IsAtStandstill
    WhenTooSlow   // Stagnation::IsTooSlow: for a caller who has a better cycle to go on with
  } giveUp = GiveUp::Never;
  /// Optional measure of the caller's own. A column is done when this measure or the tolerance says
  /// so. It is called once before each iteration and once at the end. Finished columns come with a
  /// correction of 0.
  std::function<ColumnMeasures(const Iterate&)> measureBy;
};

/// Measures of x before the correction B r of this iteration. Each is the largest over the
/// right-hand sides.
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

/// Why an iteration ended. Several right-hand sides report the last of their reasons in this order.
enum class SolveEnd
{
  Converged,
  IterationLimit,
  NotFinite,  // a right-hand side is not finite
  Stagnation, // see SolveOptions::GiveUp
  Breakdown   // a direction without positive energy, or numbers that grow without bound
};

struct SolveReport
{
  /// Returns a report without a solve, which has converged and from which KeepWorse starts.
  static SolveReport Solved()
  {
    SolveReport report;
    report.converged = true;
    report.end = SolveEnd::Converged;
    return report;
  }

  bool converged = false; // end == Converged
  SolveEnd end = SolveEnd::IterationLimit;
  int iterations = 0;
  std::vector<IterationRecord> history; // iteration 0 is the start
  double convergenceFactor = 0.0;       // mean reduction of the energy measure per iteration
  int doubleSince = -1;                 // iteration of the fallback to double precision; -1: none
  std::string where;                    // the device of the cycles; see Multigrid::Where
};

/// The value of `convergenceFactor`.
double MeanFactor(const SolveReport& report);

/// Appends the history of one solve to the history of the solves before it.
void Append(const SolveReport& step, SolveReport& report);

/// Keeps the report of the worse of two solves: the solve that has not converged, or else the solve
/// with more iterations.
void KeepWorse(SolveReport report, SolveReport& kept);

/// Keeps an iteration out of directions that are solved by other means, such as the constants of
/// each component. A must map the range of `solution` to the range of `residual`. The two are each
/// other's transposes. Both empty: no projection.
struct Projection
{
  std::function<void(MultiVector&)> solution; // removes the direction from x and from B r
  std::function<void(MultiVector&)> residual; // removes it from b and from b - A x
};

/// Preconditioned conjugate gradients. Each column has its own steps and stops on its own. Starts
/// from x, or from zero if x is very far from the solution.
/// A column that has converged by energy still takes its last correction B r, which the measure has
/// computed. The correction lowers the energy of the error once more. A column with b = 0 gives x =
/// 0. NaN in b or a breakdown ends the iteration with converged = false and the last finite x.
/// Throws Aborted.
SolveReport SolveConjugateGradients(const LinearOperator& A, const Preconditioner& B,
  const MultiVector& b, MultiVector& x, const SolveOptions& options, const Projection& project = {},
  const Progress& progress = {});

/// Repeats x += B (b - A x): cycles without conjugate gradients.
SolveReport SolveCycles(const LinearOperator& A, const Preconditioner& B, const MultiVector& b,
  MultiVector& x, const SolveOptions& options, const Projection& project = {},
  const Progress& progress = {});

} // namespace gridfem

#endif
