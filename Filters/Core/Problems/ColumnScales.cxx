#include "Problems/ColumnScales.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{

Eigen::RowVectorXd ScalesOf(
  const MultiVector& first, const MultiVector& second, const DividedRows* divided)
{
  constexpr int LargestExponent = 1000;
  Eigen::RowVectorXd largest = Eigen::RowVectorXd::Zero(first.cols());
  for (const MultiVector* block : { &first, &second })
  {
    if (block->rows() > 0)
    {
      largest = largest.cwiseMax(block->cwiseAbs().colwise().maxCoeff());
    }
  }
  if (divided)
  {
    largest = divided->Gather(largest).colwise().maxCoeff();
  }
  Eigen::RowVectorXd scale(first.cols());
  for (Id c = 0; c < first.cols(); ++c)
  {
    const bool isUsable = largest[c] > 0.0 && std::isfinite(largest[c]);
    const int exponent = isUsable ? -std::ilogb(largest[c]) : 0;
    scale[c] = std::ldexp(1.0, std::clamp(exponent, -LargestExponent, LargestExponent));
  }
  return scale;
}

void RemoveScales(const Eigen::RowVectorXd& scale, MultiVector& solution, SolveReport& report,
  const DividedRows* divided)
{
  solution *= scale.cwiseInverse().asDiagonal();
  if (report.converged && (CountNotFinite(solution, divided) > 0.0).any())
  {
    report.converged = false;
    report.end = SolveEnd::Breakdown;
  }
}

Columns CountNotFinite(const MultiVector& x, const DividedRows* divided)
{
  Columns count(x.cols());
  for (Id c = 0; c < x.cols(); ++c)
  {
    count[c] = double(x.rows() - x.col(c).array().isFinite().count());
  }
  SumOverProcesses(divided, count);
  return count;
}

} // namespace gridfem
