#include "Constants.h"

#include "Parallel.h"

#include <cmath>

namespace gridfem
{
namespace
{

/// Columns are handled in groups of this size where a loop over rows has to be serial.
constexpr Id ColumnGroup = 16;

} // namespace

Constants::Constants(
  const SparseMatrix& mass, std::vector<Index> component, Index numberOfComponents, int threads)
  : component_(std::move(component)), threads_(threads)
{
  weight_.assign(mass.rows, 0.0);
  mass_.assign(numberOfComponents, 0.0);
  double total = 0.0;
  for (Index i = 0; i < mass.rows; ++i)
  {
    for (Id k = mass.rowBegin[i]; k < mass.rowBegin[i + 1]; ++k)
    {
      weight_[i] += mass.value[k];
    }
    mass_[component_[i]] += weight_[i];
    total += weight_[i];
  }
  for (Index c = 0; c < numberOfComponents; ++c)
  {
    if (mass_[c] > 1e-14 * total)
    {
      massive_.push_back(c);
    }
    else
    {
      mass_[c] = 0.0;
    }
  }
}

void Constants::Remove(Eigen::Ref<MultiVector> X) const
{
  const Id rows = X.rows();
  ParallelRanges(
    X.cols(), threads_,
    [&](Id begin, Id end)
    {
      MultiVector mean = MultiVector::Zero(static_cast<Id>(mass_.size()), end - begin);
      for (Id i = 0; i < rows; ++i)
      {
        mean.row(component_[i]) += weight_[i] * X.row(i).segment(begin, end - begin);
      }
      for (std::size_t c = 0; c < mass_.size(); ++c)
      {
        mean.row(static_cast<Id>(c)) *= mass_[c] > 0.0 ? 1.0 / mass_[c] : 0.0;
      }
      for (Id i = 0; i < rows; ++i)
      {
        X.row(i).segment(begin, end - begin) -= mean.row(component_[i]);
      }
    },
    ColumnGroup);
}

void Constants::Deflate(Eigen::MatrixXd& mass) const
{
  for (Id j = 0; j < mass.cols(); ++j)
  {
    const double total = mass_[component_[j]];
    for (Id i = 0; i < mass.rows(); ++i)
    {
      if (total > 0.0 && component_[i] == component_[j])
      {
        mass(i, j) -= weight_[i] * weight_[j] / total;
      }
    }
  }
}

MultiVector Constants::Vectors(Index count) const
{
  MultiVector result = MultiVector::Zero(static_cast<Id>(component_.size()), count);
  std::vector<Index> column(mass_.size(), -1);
  for (Index j = 0; j < count; ++j)
  {
    column[massive_[j]] = j;
  }
  for (std::size_t i = 0; i < component_.size(); ++i)
  {
    const Index j = column[component_[i]];
    if (j >= 0)
    {
      result(static_cast<Id>(i), j) = 1.0 / std::sqrt(mass_[component_[i]]);
    }
  }
  return result;
}

} // namespace gridfem
