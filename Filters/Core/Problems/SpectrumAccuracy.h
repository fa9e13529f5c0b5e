// How well a list of eigenvalues is known: the error of the space by comparison of two levels, the
// depth for a wanted accuracy, and whether the list ends inside a multiplet.
#ifndef GridFEM_SpectrumAccuracy_h
#define GridFEM_SpectrumAccuracy_h

#include "Base/Types.h"

#include <vector>

namespace gridfem
{

/// Whether neighbouring eigenvalues a <= b, b the one after the first `count`, count as a multiplet
/// that the grid has split: closer than a quarter of the mean distance b / count, and than 1 %.
bool IsMultiplet(double a, double b, Id count);

/// About the size of the lowest value of a connected surface: by area as on a sphere, by length
/// where it is so thin that the area says nothing. A shift far above the values would cost their
/// digits.
double LowestValue(double area, double side);

/// Relative errors of eigenvalues as those of the surface. The error is O(h²), so that of the next
/// coarser level is four times as large, and a third of the difference is the error of `fine`. The
/// squared residuals, the error of the iteration, are added. At most 1, which stands for unknown:
/// pairs that the coarser level does not have.
/// @param coarse     values of the next coarser level, ascending; may be fewer
/// @param residuals  one per wanted pair, at most as many as `fine`
std::vector<double> EstimateErrors(
  const Eigen::VectorXd& coarse, const Eigen::VectorXd& fine, const std::vector<double>& residuals);

/// The depth at which all these errors, made at `depth`, should be at most `accuracy`: a level
/// divides them by four. At least `depth`, at most MaximumDepth. Throws InvalidInput for an
/// accuracy outside (0, 1).
int DepthForAccuracy(const std::vector<double>& estimatedErrors, int depth, double accuracy);

/// The least depth whose space, of about `functionsAt5` functions at depth 5, should give `modes`
/// eigenvalues to this accuracy, before anything is computed.
int FirstDepthForAccuracy(double functionsAt5, Id modes, double accuracy);

} // namespace gridfem

#endif
