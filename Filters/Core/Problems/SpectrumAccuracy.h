// The accuracy of a list of eigenvalues. Two levels are compared to find the error of the space,
// and the depth for a wanted accuracy. Another test finds whether the list ends inside a multiplet.
#ifndef GridFEM_SpectrumAccuracy_h
#define GridFEM_SpectrumAccuracy_h

#include "Base/Types.h"

#include <vector>

namespace gridfem
{

/// Whether neighboring eigenvalues a <= b count as a multiplet that the grid has split. There are
/// `count` eigenvalues up to a. The two count as a multiplet if they are closer than a quarter of
/// the mean distance b / count, and closer than 1 %.
bool IsMultiplet(double a, double b, Id count);

/// Approximate lowest value of a connected surface. It follows from the area as on a sphere, or
/// from the length if the surface is so thin that the area says nothing. A shift far above the
/// values would cost their digits.
double LowestValue(double area, double side);

/// Relative errors of eigenvalues as approximations of the surface's. The error is O(h²), so the
/// next coarser level has four times the error, and the error of `fine` is a third of the
/// difference. The squared residuals, the error of the iteration, are added. Errors are at most 1,
/// which stands for unknown: the coarser level does not have the pair.
/// @param coarse     values of the next coarser level, ascending; may be fewer
/// @param residuals  one per wanted pair, at most as many as `fine`
std::vector<double> EstimateErrors(
  const Eigen::VectorXd& coarse, const Eigen::VectorXd& fine, const std::vector<double>& residuals);

/// The depth at which all these errors, made at `depth`, should be at most `accuracy`. Each level
/// divides them by four. At least `depth`, at most MaximumDepth. Throws InvalidInput for an
/// accuracy outside (0, 1).
int DepthForAccuracy(const std::vector<double>& estimatedErrors, int depth, double accuracy);

/// The least depth that should give `modes` eigenvalues to this accuracy, before anything is
/// computed. The space has about `functionsAt5` functions at depth 5.
int FirstDepthForAccuracy(double functionsAt5, Id modes, double accuracy);

} // namespace gridfem

#endif
