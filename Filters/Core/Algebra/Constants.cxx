#include "Algebra/Constants.h"

#include "Base/Parallel.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gridfem
{
namespace
{

/// A sum over all rows is split into at most this many parts, for any number of threads.
constexpr Id MostSums = 16;
constexpr Id RowsPerComponent = 64;

/// If a component has less than this share of the mass, its area may be only rounding.
constexpr double Rounding = 1e-14;

/// Squared extent of a component, in cells, that is a speck with such a share of the mass.
constexpr double LargestSpeck = 1e-9;

/// How far each component extends. With b the values of all functions at a place, M is ∫ b bᵀ, and
/// its row sums are ∫ b. On a component at one place, M has therefore no other eigenvector. Returns
/// the rest of M's trace, as a share.
/// @param rowSum  of the mass
std::vector<double> ExtentsOf(const SparseMatrix& mass, const std::vector<double>& rowSum,
  const std::vector<Index>& component, Index count)
{
  std::vector<double> trace(count, 0.0);
  std::vector<double> square(count, 0.0);
  std::vector<double> product(count, 0.0); // of the row sums with M times them
  for (Index i = 0; i < mass.rows; ++i)
  {
    const Index c = component[i];
    square[c] += rowSum[i] * rowSum[i];
    for (Id k = mass.rowBegin[i]; k < mass.rowBegin[i + 1]; ++k)
    {
      product[c] += rowSum[i] * mass.value[k] * rowSum[mass.column[k]];
      trace[c] += mass.column[k] == i ? mass.value[k] : 0.0;
    }
  }
  for (Index c = 0; c < count; ++c)
  {
    trace[c] = 1.0 - product[c] / square[c] / trace[c];
  }
  return trace;
}

} // namespace

Constants::Constants(const SparseMatrix& mass, std::vector<Index> component,
  Index numberOfComponents, int threads, const DistributedRows* distributed,
  std::vector<char> isHeld)
  : component_(std::move(component)), isHeld_(std::move(isHeld)), threads_(threads),
    distributed_(distributed)
{
  weight_.assign(mass.rows, 0.0);
  mass_.assign(numberOfComponents, 0.0);
  for (Index i = 0; i < mass.rows; ++i)
  {
    for (Id k = mass.rowBegin[i]; k < mass.rowBegin[i + 1]; ++k)
    {
      weight_[i] += mass.value[k];
    }
  }
  for (std::size_t i = 0; i < weight_.size(); ++i)
  {
    mass_[component_[i]] += weight_[i];
  }
  const auto components = static_cast<Index>(mass_.size());
  SumOverProcesses(distributed_, mass_);
  const double total = std::accumulate(mass_.begin(), mass_.end(), 0.0);
  const auto isLarge = [&](Index c) { return mass_[c] > Rounding * total; };
  std::vector<double> extent; // where one is small
  for (Index c = 0; c < components; ++c)
  {
    if (!isLarge(c) && mass_[c] > 0.0 && extent.empty() && !distributed_)
    {
      extent = ExtentsOf(mass, weight_, component_, components);
    }
    // A line's area is rounding, however long it is. A speck has a small area, too.
    if (!isLarge(c) && (extent.empty() || !(mass_[c] > 0.0) || extent[c] >= LargestSpeck))
    {
      mass_[c] = 0.0;
    }
    else if (!this->IsHeld(c))
    {
      massive_.push_back(c);
    }
  }
}

template<class Real>
void Constants::Remove(Block<Real> X) const
{
  const MultiVector mean = this->Means<Real>(X);
  ParallelRanges(X.rows(), threads_,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        if (mass_[component_[i]] > 0.0)
        {
          X.row(i) -= mean.row(component_[i]).cast<Real>();
        }
        else
        {
          X.row(i).setZero();
        }
      }
    });
}

template void Constants::Remove(Block<float>) const;
template void Constants::Remove(Block<double>) const;

template<class Real>
MultiVector Constants::Means(const ConstBlock<Real>& X) const
{
  const Id components = static_cast<Id>(mass_.size());
  // Each part has a sum for every component. The number of parts is small enough that they take
  // only a fraction of the memory of X.
  const Id sums = std::clamp<Id>(X.rows() / (RowsPerComponent * components + 1), 1, MostSums);
  MultiVector mean = ParallelSum(
    X.rows(), threads_, MultiVector(MultiVector::Zero(components, X.cols())),
    [&](Id begin, Id end)
    {
      MultiVector sum = MultiVector::Zero(components, X.cols());
      for (Id i = begin; i < end; ++i)
      {
        sum.row(component_[i]) += weight_[i] * X.row(i).template cast<double>();
      }
      return sum;
    },
    X.rows() / sums + 1);
  SumOverProcesses(distributed_, mean);
  for (Id c = 0; c < components; ++c)
  {
    const bool hasConstant = mass_[c] > 0.0 && !this->IsHeld(static_cast<Index>(c));
    mean.row(c) *= hasConstant ? 1.0 / mass_[c] : 0.0;
  }
  return mean;
}

void Constants::Deflate(Eigen::MatrixXd& mass) const
{
  for (Id j = 0; j < mass.cols(); ++j)
  {
    const double total = mass_[component_[j]];
    if (total > 0.0 && this->IsHeld(component_[j]))
    {
      continue;
    }
    for (Id i = 0; i < mass.rows(); ++i)
    {
      if (component_[i] == component_[j])
      {
        mass(i, j) = total > 0.0 ? mass(i, j) - weight_[i] * weight_[j] / total : 0.0;
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
