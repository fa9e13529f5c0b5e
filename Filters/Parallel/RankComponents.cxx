#include "Parallel/RankComponents.h"

#include <algorithm>

namespace gridfem
{

namespace
{

/// Collective. Per function the lowest number of a function of its component: that of the rank's
/// part at first, and lower ones as neighbours tell them. As many rounds as a component crosses
/// from rank to rank.
std::vector<double> LowestOfComponents(const Communicator& ranks, const LevelNumbering& numbering,
  const LevelVectors& vectors, const PatchLevel& level)
{
  std::vector<Index> part;
  std::vector<double> ofPart;
  std::vector<double> lowest;
  std::vector<double> next;
  ranks.Together(
    [&]
    {
      part = FunctionComponents(level);
      ofPart.resize(part.empty() ? 0 : *std::max_element(part.begin(), part.end()) + 1);
      lowest.assign(numbering.number.begin(), numbering.number.end());
      next.resize(part.size());
    });
  const PetscVector least = vectors.Make();
  for (double change = 1.0; change > 0.0; ranks.Maximum(&change, 1))
  {
    std::fill(ofPart.begin(), ofPart.end(), static_cast<double>(numbering.total));
    for (std::size_t f = 0; f < part.size(); ++f)
    {
      ofPart[part[f]] = std::min(ofPart[part[f]], lowest[f]);
    }
    for (std::size_t f = 0; f < part.size(); ++f)
    {
      next[f] = ofPart[part[f]];
    }
    vectors.TakeLeast(next, least);
    vectors.Spread(least, next);
    change = next == lowest ? 0.0 : 1.0;
    lowest.swap(next);
  }
  return lowest;
}

} // namespace

RankComponents::RankComponents(const Communicator& ranks, const LevelNumbering& numbering,
  const LevelVectors& vectors, const PatchLevel& level, const std::vector<double>& integral)
  : ranks_(ranks)
{
  ranks.Together(
    [&]
    {
      component_.resize(numbering.OwnFunctions());
      integral_.resize(numbering.OwnFunctions());
    });
  const std::vector<double> lowest = LowestOfComponents(ranks, numbering, vectors, level);
  std::vector<double> firsts; // numbers of the first functions of all components, ascending
  for (Index f = numbering.foreign; f < numbering.Functions(); ++f)
  {
    if (lowest[f] == static_cast<double>(numbering.number[f]))
    {
      firsts.push_back(lowest[f]);
    }
  }
  firsts = ranks_.Gather(firsts);
  const PetscVector sum = vectors.Make();
  vectors.Add(integral, sum);
  VectorEntries integrals(sum);
  area_.assign(firsts.size(), 0.0);
  for (Index k = 0; k < numbering.OwnFunctions(); ++k)
  {
    const auto first =
      std::lower_bound(firsts.begin(), firsts.end(), lowest[numbering.foreign + k]);
    component_[k] = static_cast<Index>(first - firsts.begin());
    integral_[k] = integrals[k];
    area_[component_[k]] += integral_[k];
  }
  ranks_.Sum(area_.data(), static_cast<Id>(area_.size()));
}

template<class Weight>
MultiVector RankComponents::WeightedMeans(const MultiVector& x, Weight&& weight) const
{
  MultiVector mean = MultiVector::Zero(this->Count(), x.cols());
  for (std::size_t k = 0; k < component_.size(); ++k)
  {
    mean.row(component_[k]) += weight(k) * x.row(k);
  }
  ranks_.Sum(mean.data(), mean.size());
  for (Id c = 0; c < mean.rows(); ++c)
  {
    mean.row(c) *= area_[c] > 0.0 ? 1.0 / area_[c] : 0.0;
  }
  return mean;
}

MultiVector RankComponents::OfIntegrals(const MultiVector& load) const
{
  return this->WeightedMeans(load, [](std::size_t) { return 1.0; });
}

MultiVector RankComponents::OfFunction(const MultiVector& coefficients) const
{
  return this->WeightedMeans(coefficients, [this](std::size_t k) { return integral_[k]; });
}

void RankComponents::AddConstants(const MultiVector& mean, MultiVector& coefficients) const
{
  for (std::size_t k = 0; k < component_.size(); ++k)
  {
    if (area_[component_[k]] > 0.0)
    {
      coefficients.row(k) += mean.row(component_[k]);
    }
  }
}

void RankComponents::SubtractIntegrals(const MultiVector& mean, MultiVector& load) const
{
  for (std::size_t k = 0; k < component_.size(); ++k)
  {
    load.row(k) -= integral_[k] * mean.row(component_[k]);
  }
}

} // namespace gridfem
