// Decides whether an iteration still makes progress.
#ifndef GridFEM_Stagnation_h
#define GridFEM_Stagnation_h

#include <vector>

namespace gridfem
{

/// Watches a measure that has to fall to a tolerance within a given number of iterations. Only the
/// lowest measure so far counts, because the measures of conjugate gradients go up and down.
class Stagnation
{
public:
  /// Iterations over which the pace is measured. Shorter pieces of a history do not predict the
  /// rest: conjugate gradients with a good preconditioner are slow for some ten iterations before
  /// they gain speed.
  static constexpr int PaceWindow = 20;
  /// The pace is judged only after this many iterations, or after half of those allowed. In a flow
  /// whose metric degenerates, the first forty of the sixty sufficient iterations are slow.
  static constexpr int Patience = 50;
  /// Iterations without a new lowest measure that count as a standstill. With a good preconditioner
  /// there were at most five iterations between two lowest measures. With Gauss-Seidel cycles there
  /// may be hundreds, and the iteration then goes on.
  static constexpr int StandstillWindow = 50;

  /// @param tolerance > 0
  Stagnation(double tolerance, int maximumIterations)
    : tolerance_(tolerance), maximumIterations_(maximumIterations)
  {
  }

  /// Called once per iteration. The first measure describes the start. NaN counts as no progress.
  void Add(double measure);

  /// True if, at the mean pace of the last PaceWindow iterations, the remaining iterations do not
  /// reach the tolerance. Always false before Patience.
  bool IsTooSlow() const;

  /// True if the last StandstillWindow iterations have not lowered the measure.
  bool IsAtStandstill() const;

private:
  double tolerance_;
  int maximumIterations_;
  std::vector<double> lowest_; // the lowest measure after every iteration
};

} // namespace gridfem

#endif
