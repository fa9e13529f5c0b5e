#include "Equations/ColumnScales.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{

Eigen::RowVectorXd ScalesOf(
  const MultiVector& first, const MultiVector& second, const DistributedRows* distributed)
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
  if (distributed)
  {
    largest = distributed->Gather(largest).colwise().maxCoeff();
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
  const DistributedRows* distributed)
{
  solution *= scale.cwiseInverse().asDiagonal();
  if (report.converged && (CountNotFinite(solution, distributed) > 0.0).any())
  {
    report.converged = false;
    report.end = SolveEnd::Breakdown;
  }
}

Columns CountNotFinite(const MultiVector& x, const DistributedRows* distributed)
{
  Columns count(x.cols());
  for (Id c = 0; c < x.cols(); ++c)
  {
    count[c] = double(x.rows() - x.col(c).array().isFinite().count());
  }
  SumOverProcesses(distributed, count);
  return count;
}

} // namespace gridfem
