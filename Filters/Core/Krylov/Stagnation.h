// Whether an iteration still gets anywhere.
#ifndef GridFEM_Stagnation_h
#define GridFEM_Stagnation_h

#include <vector>

namespace gridfem
{

/// Watches a measure that has to fall to a tolerance within so many iterations. What counts is the
/// lowest one so far, because the measures of conjugate gradients go up and down.
class Stagnation
{
public:
  /// Shorter pieces of a history say little about the rest: conjugate gradients with a good
  /// preconditioner are slow for some ten iterations before they gain speed.
  static constexpr int PaceWindow = 20;
  /// Before so many iterations, or half of those allowed, the pace is not judged: in a flow whose
  /// metric degenerates it is slow for forty of the sixty iterations that suffice.
  static constexpr int Patience = 50;
  /// With a good preconditioner the gaps between two lowest measures were at most five iterations;
  /// with Gauss-Seidel cycles they may be hundreds, and the iteration then goes on.
  static constexpr int StandstillWindow = 50;

  /// @param tolerance > 0
  Stagnation(double tolerance, int maximumIterations)
    : tolerance_(tolerance), maximumIterations_(maximumIterations)
  {
  }

  /// Once per iteration; the first is that of the start. Not a number counts as no progress.
  void Add(double measure);

  /// After Patience: at the mean pace of the last PaceWindow iterations the tolerance is not
  /// reached within the iterations that are left.
  bool IsTooSlow() const;

  /// The last StandstillWindow iterations have not brought a lower measure.
  bool IsAtStandstill() const;

private:
  double tolerance_;
  int maximumIterations_;
  std::vector<double> lowest_; // after every iteration
};

} // namespace gridfem

#endif
