// How good a solution is: the error that its space leaves, and what the iteration leaves of its
// own. Multigrid starts from the solution of the next coarser level, so that both can be seen on
// the way.
#ifndef GridFEM_SolutionAccuracy_h
#define GridFEM_SolutionAccuracy_h

#include "Krylov/ConjugateGradients.h"
#include "Spaces/SpaceLevels.h"

#include <limits>
#include <vector>

namespace gridfem
{

/// Of several columns the worst. Not a number where nothing is known.
struct SolutionAccuracy
{
  static constexpr double Unknown = std::numeric_limits<double>::quiet_NaN();

  double discretization = Unknown; // |u - exact| / |u| on the surface, u without its mean over the
                                   // surface; within a factor of two where it can be trusted
  double largest = Unknown;        // the largest error at a point, in units of the solution
  double algebraic = Unknown;      // |u - the space's own solution| / |u|; in four of five cases
                                   // within a factor of three
  /// Whether the levels are nested and differ as they do where errors fall with the square of the
  /// cell size. On hats above a grid the first two are within a factor of three on most surfaces,
  /// and ten to twenty times too large on some of very unequal triangles. Else the surface or the
  /// data are not resolved, or the levels are too coarse, and the error of the space may be several
  /// times as large.
  bool isTrusted = false;
};

/// Of several solves: the worst of each; `kept` where the other knows nothing.
void KeepWorse(const SolutionAccuracy& accuracy, SolutionAccuracy& kept);

/// What the difference of two levels says of an error.
enum class ErrorOrder
{
  Second,  // a third of it
  Observed // as three levels show: where values are held or a surface bends, nothing is smooth
};

/// Watches an iteration that starts near the solution of the next coarser level, in the sense of
/// SolveOptions::measureBy. Keeps references.
class AccuracyWatch
{
public:
  /// @param nested    the coarser solution, prolonged
  /// @param coarser   how it differs from that of the level below; no columns: there is none
  /// @param accuracy  wanted ratio of the algebraic error to that of the space; 0: only watches
  AccuracyWatch(const SpaceLevels& space, MultiVector nested, const MultiVector& coarser,
    double accuracy, int threads);

  ColumnMeasures operator()(const Iterate& iterate);

  /// The algebraic error is unknown where the iteration was not watched.
  /// @param solution  as the iteration left it
  /// @param size      |u| of each column, without its mean over the surface
  /// @param scale     of the columns, which is still in both
  SolutionAccuracy Result(const MultiVector& solution, const Columns& size,
    const Eigen::RowVectorXd& scale, ErrorOrder order) const;

private:
  Columns Norms(const MultiVector& u) const;
  Columns Rates(const Columns& step) const;

  const SpaceLevels& space_;
  const MultiVector nested_;
  const double accuracy_;
  const int threads_;
  double steps_ = 3.0;   // difference of the levels over the error of the finer one
  Columns coarserError_; // of the next coarser level; empty: unknown
  int calls_ = 0;
  Columns size_;           // |u|
  Columns discretization_; // absolute
  Columns lastStep_;       // |the last correction|
  Columns algebraic_;      // absolute, of the last correction that was not zero
};

} // namespace gridfem

#endif
