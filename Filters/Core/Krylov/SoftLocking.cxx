#include "Krylov/SoftLocking.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gridfem
{
namespace
{

/// A converged column has to work again if its value moves by more than this many tolerances.
constexpr double WakeFactor = 10.0;

/// A converged column is measured again if its squared residual grows by more than this factor.
constexpr double GrowthFactor = 1.5;

} // namespace

void SoftLocking::Start(const Eigen::VectorXd& values)
{
  const std::size_t size = static_cast<std::size_t>(values.size());
  measure_.resize(size, 1.0);
  settledAt_.resize(size, -1.0);
  settledNorm_.resize(size, 0.0);
  atWork_.clear();
  for (Index j = 0; j < static_cast<Index>(size); ++j)
  {
    const double drift = std::abs(values[j] - settledAt_[j]);
    if (settledAt_[j] < 0.0 || drift > WakeFactor * tolerance_ * values[j])
    {
      atWork_.push_back(j);
    }
  }
}

void SoftLocking::StartWanted()
{
  atWork_.resize(std::min<std::size_t>(wanted_, measure_.size()));
  std::iota(atWork_.begin(), atWork_.end(), 0);
}

bool SoftLocking::Update(const ResidualMeasures& measures, const Eigen::VectorXd& values)
{
  bool done = true;
  for (std::size_t j = 0; j < atWork_.size(); ++j)
  {
    const Index column = atWork_[j];
    const double value = values[column];
    measure_[column] = this->Relative(measures.energy[j], value);
    const bool converged = this->IsConverged(column);
    settledAt_[column] = converged ? value : -1.0;
    settledNorm_[column] = measures.norm[j];
    done = done && (converged || column >= wanted_);
  }
  return done;
}

/// Keeps the columns at work for which condition(place, column) holds, and returns their places.
template<class Condition>
std::vector<Index> SoftLocking::KeepWhere(Condition&& condition)
{
  std::vector<Index> kept;
  std::vector<Index> places;
  for (Index j = 0; j < static_cast<Index>(atWork_.size()); ++j)
  {
    if (condition(j, atWork_[j]))
    {
      kept.push_back(atWork_[j]);
      places.push_back(j);
    }
  }
  atWork_ = std::move(kept);
  return places;
}

std::vector<Index> SoftLocking::DropConverged()
{
  return this->KeepWhere([&](Index, Index column) { return !this->IsConverged(column); });
}

void SoftLocking::DropUnmoved(const Eigen::VectorXd& norm)
{
  this->KeepWhere([&](Index place, Index column)
    { return !(norm[place] <= GrowthFactor * settledNorm_[column]); });
}

} // namespace gridfem
