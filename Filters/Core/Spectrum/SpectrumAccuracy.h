// The accuracy of a list of eigenvalues. Three levels are compared to find the error of the space,
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
/// from the length if the surface is very thin. A shift far above the values would cost their
/// digits.
double LowestValue(double area, double side);

struct EigenvalueErrors
{
  std::vector<double> relative;
  std::vector<char> isTrusted; // whether three levels show that the error falls as it should
};

/// The values of the same modes on three levels. NaN where a level does not have the mode.
struct ValuesOnLevels
{
  Eigen::VectorXd finest;
  Eigen::VectorXd next;      // of half the resolution
  Eigen::VectorXd afterNext; // of a quarter
};

/// Relative errors of the finest eigenvalues as approximations of the eigenvalues of the surface.
/// From level to level the error falls by four on smooth surfaces, and by two at thin edges. The
/// ratio of the two differences shows the rate, which is never assumed to be better than four. The
/// squared residuals, the error of the iteration, are added. An error of 1 stands for unknown: the
/// next level does not have the mode.
///
/// An error is trusted if the ratio shows that the differences fall, and if the first difference is
/// below 0.3 of the value. An unresolved surface has differences that stay or grow, and larger ones
/// tell no rate.
/// @param residuals  one per wanted mode, at most as many as there are values
EigenvalueErrors EstimateErrors(const ValuesOnLevels& values, const std::vector<double>& residuals);

/// The depth at which all these errors should be at most `accuracy`, if they were found at `depth`.
/// Each level divides them by four. At least `depth`, at most MaximumDepth. Throws InvalidInput for
/// an accuracy outside (0, 1).
int DepthForAccuracy(const std::vector<double>& estimatedErrors, int depth, double accuracy);

/// The least depth that should give `modes` eigenvalues to this accuracy, before anything is
/// computed. The space has about `functionsAt5` functions at depth 5.
int FirstDepthForAccuracy(double functionsAt5, Id modes, double accuracy);

} // namespace gridfem

#endif
