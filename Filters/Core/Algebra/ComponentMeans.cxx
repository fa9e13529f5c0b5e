#include "Algebra/ComponentMeans.h"

#include "Algebra/RowKernels.h"

namespace gridfem
{

ComponentMeans::ComponentMeans(const std::vector<Index>& component,
  const std::vector<double>& integral, Index numberOfComponents, int threads,
  const DistributedRows* distributed)
  : component_(component), integral_(integral), area_(numberOfComponents, 0.0), threads_(threads),
    distributed_(distributed)
{
  for (std::size_t i = GhostRows(distributed); i < component_.size(); ++i)
  {
    area_[component_[i]] += integral_[i];
  }
  SumOverProcesses(distributed_, area_);
}

/// Returns Σ weight(i) x_i over every component, divided by the component's area.
template<class Weight>
MultiVector ComponentMeans::WeightedMeans(const MultiVector& x, Weight&& weight) const
{
  const MultiVector zero = MultiVector::Zero(static_cast<Id>(area_.size()), x.cols());
  const Id ghosts = GhostRows(distributed_); // rows that other processes count
  const auto sumRange = [&](Id begin, Id end)
  {
    MultiVector sum = zero;
    ForEachChunk(x.cols(),
      [&](auto chunk)
      {
        for (Index i = static_cast<Index>(ghosts + begin); i < ghosts + end; ++i)
        {
          chunk.Row(sum.data(), component_[i]) += weight(i) * chunk.Row(x.data(), i);
        }
      });
    return sum;
  };
  // Each range has at least as many rows as there are components, so the partial sums take less
  // memory than x.
  const Id range = std::max(DefaultBlockSize, zero.rows());
  MultiVector mean =
    ParallelSum(x.rows() - ghosts, ThreadsFor(x.size(), threads_), zero, sumRange, range);
  SumOverProcesses(distributed_, mean);
  for (Id k = 0; k < mean.rows(); ++k)
  {
    if (area_[k] > 0.0)
    {
      mean.row(k) /= area_[k];
    }
    else
    {
      mean.row(k).setZero();
    }
  }
  return mean;
}

/// Computes x_i += weight(i) times the mean of the component of i.
template<class Weight>
void ComponentMeans::AddWeighted(const MultiVector& mean, MultiVector& x, Weight&& weight) const
{
  ParallelRanges(x.rows(), ThreadsFor(x.size(), threads_),
    [&](Id begin, Id end)
    {
      ForEachChunk(x.cols(),
        [&](auto chunk)
        {
          for (Index i = static_cast<Index>(begin); i < end; ++i)
          {
            chunk.Row(x.data(), i) += weight(i) * chunk.Row(mean.data(), component_[i]);
          }
        });
    });
}

MultiVector ComponentMeans::OfIntegrals(const MultiVector& load) const
{
  return this->WeightedMeans(load, [](Index) { return 1.0; });
}

MultiVector ComponentMeans::OfFunction(const MultiVector& coefficients) const
{
  return this->WeightedMeans(coefficients, [this](Index i) { return integral_[i]; });
}

void ComponentMeans::AddConstants(const MultiVector& mean, MultiVector& coefficients) const
{
  this->AddWeighted(
    mean, coefficients, [this](Index i) { return area_[component_[i]] > 0.0 ? 1.0 : 0.0; });
}

void ComponentMeans::SubtractIntegrals(const MultiVector& mean, MultiVector& load) const
{
  this->AddWeighted(mean, load, [this](Index i) { return -integral_[i]; });
}

Columns ComponentMeans::SquaredSpread(const MultiVector& mean) const
{
  const Eigen::Map<const Eigen::VectorXd> area(area_.data(), static_cast<Id>(area_.size()));
  const double total = area.sum();
  if (!(total > 0.0))
  {
    return Columns::Zero(mean.cols());
  }
  const Eigen::RowVectorXd ofAll = area.transpose() * mean / total;
  const Eigen::VectorXd spread = (mean.rowwise() - ofAll).cwiseAbs2().transpose() * area;
  return spread.array();
}

} // namespace gridfem
