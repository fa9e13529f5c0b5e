#include "Equations/PenalizedLevels.h"

#include "Equations/PointConstraints.h"

#include <utility>

namespace gridfem
{

PenalizedLevels::PenalizedLevels(
  const SpaceLevels& space, RowPenalty penalty, std::unique_ptr<const PenalizedLevels> nested)
  : space_(space), penalty_(std::move(penalty)), nested_(std::move(nested))
{
}

void PenalizedLevels::FillMatrix(
  std::size_t level, double a, double b, SparseMatrix& matrix, const Job& job) const
{
  space_.FillMatrix(level, a, b, matrix, job);
  if (b == 0.0)
  {
    return;
  }
  const DistributedRows* const distributed = space_.Distributed(0);
  if (distributed && !space_.Distributed(level))
  {
    penalty_.AddSumTo(level, b, *distributed, matrix, job.threads);
  }
  else
  {
    penalty_.AddTo(level, b, matrix, job.threads);
  }
}

Components PenalizedLevels::ComponentsOf(std::size_t level, const Job& job) const
{
  Components components = space_.ComponentsOf(level, job);
  components.isHeld = HeldComponents(space_, 0.0, penalty_.Rows(level), components);
  return components;
}

} // namespace gridfem
