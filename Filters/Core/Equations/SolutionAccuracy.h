// How accurate a solution is: the error of its space, and the error that the iteration leaves.
// Multigrid starts from the solution of the next coarser level, so both can be observed during the
// iteration.
#ifndef GridFEM_SolutionAccuracy_h
#define GridFEM_SolutionAccuracy_h

#include "Krylov/ConjugateGradients.h"
#include "Spaces/SpaceLevels.h"

#include <limits>
#include <vector>

namespace gridfem
{

/// Errors of a solution. With several columns, they are the errors of the worst column. NaN where
/// nothing is known.
struct SolutionAccuracy
{
  static constexpr double Unknown = std::numeric_limits<double>::quiet_NaN();

  // |u - exact| / |u| on the surface, with u taken without its mean over the surface. Within a
  // factor of two if it is trusted.
  double discretization = Unknown;
  double largest = Unknown; // the largest error at a point, in units of the solution
  // |u - the space's own solution| / |u|. Within a factor of three in four of five cases.
  double algebraic = Unknown;
  /// Whether the levels are nested and their differences show errors that fall with the square of
  /// the cell size. On hats above a grid, the first two errors are then within a factor of three on
  /// most surfaces. They are ten to twenty times too large on some surfaces with very unequal
  /// triangles. If not trusted, the surface or the data are not resolved, or the levels are too
  /// coarse. The error of the space may then be several times as large.
  bool isTrusted = false;

  /// Returns no errors at all, from which KeepWorse starts.
  static SolutionAccuracy Exact() { return { 0.0, 0.0, 0.0, true }; }
};

/// The larger one of two errors. It is unknown (NaN) if one of them is unknown.
double LargerOrUnknown(double a, double b);

/// Combines the errors of several solves: keeps the worst of each kind. An error is unknown if one
/// of them is unknown.
void KeepWorse(const SolutionAccuracy& accuracy, SolutionAccuracy& kept);

/// How an error follows from the difference of two levels.
enum class ErrorOrder
{
  Second,  // a third of the difference
  Observed // as three levels show; held values or a bend of the surface leave nothing smooth
};

/// Watches an iteration that starts near the solution of the next coarser level, for
/// SolveOptions::measureBy. Keeps references.
class AccuracyWatch
{
public:
  /// @param nested    the coarser solution, prolonged
  /// @param coarser   its difference from the solution of the level below; no columns: there is
  ///   none
  /// @param accuracy wanted ratio of the algebraic error to the error of the space; 0: only watches
  AccuracyWatch(const SpaceLevels& space, MultiVector nested, const MultiVector& coarser,
    double accuracy, int threads);

  ColumnMeasures operator()(const Iterate& iterate);

  /// The errors of the solution. The algebraic error is unknown if the iteration was not watched.
  /// @param solution  the result of the iteration
  /// @param size      |u| of each column, without its mean over the surface
  /// @param scale     of the columns; both still contain it
  SolutionAccuracy Result(const MultiVector& solution, const Columns& size,
    const Eigen::RowVectorXd& scale, ErrorOrder order) const;

private:
  Columns Norms(const MultiVector& u) const;
  Columns Rates(const Columns& step) const;

  const SpaceLevels& space_;
  const MultiVector nested_;
  const double accuracy_;
  const int threads_;
  double steps_ = 3.0;   // difference of the levels over the error of the finer level
  Columns coarserError_; // of the next coarser level; empty: unknown
  int calls_ = 0;
  Columns size_;           // |u|
  Columns discretization_; // absolute
  Columns lastStep_;       // |the last correction|
  Columns algebraic_;      // absolute, of the last correction other than zero
};

} // namespace gridfem

#endif
