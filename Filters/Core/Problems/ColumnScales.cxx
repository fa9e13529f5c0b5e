#include "Problems/ColumnScales.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{

Eigen::RowVectorXd ScalesOf(const MultiVector& first, const MultiVector& second)
{
  constexpr int LargestExponent = 1000;
  Eigen::RowVectorXd scale(first.cols());
  for (Id c = 0; c < first.cols(); ++c)
  {
    double largest = first.rows() > 0 ? first.col(c).cwiseAbs().maxCoeff() : 0.0;
    if (second.rows() > 0)
    {
      largest = std::max(largest, second.col(c).cwiseAbs().maxCoeff());
    }
    const bool isUsable = largest > 0.0 && std::isfinite(largest);
    const int exponent = isUsable ? -std::ilogb(largest) : 0;
    scale[c] = std::ldexp(1.0, std::clamp(exponent, -LargestExponent, LargestExponent));
  }
  return scale;
}

void RemoveScales(const Eigen::RowVectorXd& scale, MultiVector& solution, SolveReport& report)
{
  solution *= scale.cwiseInverse().asDiagonal();
  if (report.converged && !solution.allFinite())
  {
    report.converged = false;
    report.end = SolveEnd::Breakdown;
  }
}

} // namespace gridfem
