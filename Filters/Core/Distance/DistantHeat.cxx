#include "Distance/DistantHeat.h"

#include "Base/Errors.h"
#include "Spaces/FiniteElementSpace.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gridfem
{
namespace
{

constexpr double Infinite = std::numeric_limits<double>::infinity();

/// Heat below this counts as 0. It leaves room above the numbers that do not hold all their digits.
constexpr double SmallestHeat = 1e-290;

/// Number of layers that are relaxed together. Heat from farther away changes a direction by less
/// than rounding.
constexpr Id LayersAtOnce = 16;

/// Tolerance of the first march, which only finds the order for the next one.
constexpr double RoughChange = 0.5;

constexpr int MostMarches = 12;
constexpr int MostSweepsPerStep = 100;

} // namespace

/// Prefetches the patches that come soon after patch k of the order. They may lie anywhere in
/// memory, and the rows of a patch are known only when the patch is in the cache.
EIGEN_ALWAYS_INLINE void DistantHeat::FetchAfter(const Layers& layers, Id k) const
{
  constexpr Id Ahead = 3;
  if (k + 2 * Ahead < static_cast<Id>(layers.patch.size()))
  {
    patches_->FetchInverse(layers.patch[k + 2 * Ahead]);
    patches_->FetchRows(RowView(A_), layers.patch[k + Ahead]);
  }
}

DistantHeat::DistantHeat(
  const FiniteElementSpace& space, std::size_t level, double t, const Job& job, double change)
  : t_(t), change_(change)
{
  if (level >= space.NumberOfLevels())
  {
    throw InvalidInput("There is no level " + std::to_string(level) + ".");
  }
  for (std::size_t l = 0; l < level; ++l)
  {
    prolongations_.push_back(space.Prolongation(l));
    restrictions_.push_back(space.Restriction(l));
  }
  A_ = space.Matrix(level, 1.0 / t, 1.0, job);
  if (level > 0 && level + 1 == space.NumberOfLevels())
  {
    direct_.emplace(A_, job.threads);
  }
  this->Factor(space.Relaxation(level, {}).order.dof, job.threads);
}

DistantHeat::DistantHeat(
  SparseMatrix A, const UnknownGroups& patches, double t, double change, int threads)
  : A_(std::move(A)), t_(t), change_(change)
{
  this->Factor(patches, threads);
}

void DistantHeat::Factor(const UnknownGroups& patches, int threads)
{
  size_ = A_.Diagonal(threads);
  for (double& size : size_)
  {
    size = std::sqrt(std::max(0.0, size));
  }
  patches_.emplace(A_, patches, threads, FactorPrecision::Mixed);
}

/// The number of functions on the way of the heat to each function; -1 on components without a
/// source.
std::vector<Index> DistantHeat::StepsFromSources(
  const MultiVector& load, const MultiVector& u) const
{
  std::vector<Index> steps(A_.rows, -1);
  std::vector<Index> reached;
  for (Index i = 0; i < A_.rows; ++i)
  {
    if (load(i, 0) != 0.0 || u(i, 0) != 0.0)
    {
      steps[i] = 0;
      reached.push_back(i);
    }
  }
  for (std::size_t next = 0; next < reached.size(); ++next)
  {
    const Index i = reached[next];
    for (Id k = A_.rowBegin[i]; k < A_.rowBegin[i + 1]; ++k)
    {
      const Index j = A_.column[k];
      if (steps[j] < 0)
      {
        steps[j] = steps[i] + 1;
        reached.push_back(j);
      }
    }
  }
  return steps;
}

/// Cuts patches into layers by rank. A layer holds the ranks between two whole numbers. Patches
/// with an infinite rank are left out.
DistantHeat::Layers DistantHeat::LayersByRank(const std::vector<double>& rank) const
{
  Layers layers;
  for (Index p = 0; p < static_cast<Index>(rank.size()); ++p)
  {
    if (rank[p] < Infinite)
    {
      layers.patch.push_back(p);
    }
  }
  std::sort(layers.patch.begin(), layers.patch.end(),
    [&](Index a, Index b) { return rank[a] != rank[b] ? rank[a] < rank[b] : a < b; });
  double next = -Infinite;
  for (std::size_t k = 0; k < layers.patch.size(); ++k)
  {
    if (rank[layers.patch[k]] >= next)
    {
      layers.begin.push_back(static_cast<Id>(k));
      next = std::floor(rank[layers.patch[k]]) + 1.0;
    }
  }
  layers.begin.push_back(static_cast<Id>(layers.patch.size()));
  return layers;
}

DistantHeat::Layers DistantHeat::LayersBySteps(const std::vector<Index>& steps) const
{
  std::vector<double> rank(patches_->Count());
  for (std::size_t p = 0; p < rank.size(); ++p)
  {
    const UnknownGroup unknowns = patches_->Unknowns(static_cast<Id>(p));
    const double sum = std::accumulate(unknowns.begin(), unknowns.end(), 0.0,
      [&](double before, Index i) { return before + steps[i]; });
    rank[p] = steps[unknowns[0]] < 0 ? Infinite : sum / double(unknowns.size());
  }
  return this->LayersByRank(rank);
}

/// Orders patches from the most heat to the least, in about `count` layers.
DistantHeat::Layers DistantHeat::LayersByHeat(
  const MultiVector& u, Id count, const std::vector<Index>& patches) const
{
  std::vector<double> rank(patches_->Count(), Infinite);
  double least = Infinite;
  double most = -Infinite;
  for (const Index p : patches)
  {
    rank[p] = -std::log(std::max(SmallestHeat, this->HeatOf(p, u)));
    least = std::min(least, rank[p]);
    most = std::max(most, rank[p]);
  }
  const double scale = most > least ? static_cast<double>(count) / (most - least) : 0.0;
  for (const Index p : patches)
  {
    rank[p] = scale * (rank[p] - least);
  }
  return this->LayersByRank(rank);
}

double DistantHeat::HeatOf(Index patch, const MultiVector& u) const
{
  double heat = 0.0;
  for (const Index i : patches_->Unknowns(patch))
  {
    heat = std::max(heat, std::abs(u(i, 0)) * size_[i]);
  }
  return heat;
}

/// Relaxes one patch.
/// @return  the largest change over the heat of the patch; infinite for a change that is NaN
double DistantHeat::Relax(Index patch, const MultiVector& b, MultiVector& u) const
{
  const UnknownGroup unknowns = patches_->Unknowns(patch);
  std::array<double, LargestGroup> before;
  for (Id k = 0; k < unknowns.size(); ++k)
  {
    before[k] = u(unknowns[k], 0);
  }
  patches_->Relax(patch, RowView(A_), b.data(), u.data(), ColumnChunk<1, 1>());
  double heat = SmallestHeat;
  double change = 0.0;
  double sum = 0.0; // of the changes; it keeps NaN, which std::max drops
  for (Id k = 0; k < unknowns.size(); ++k)
  {
    const Index i = unknowns[k];
    double& value = u(i, 0);
    value = std::abs(value) * size_[i] < SmallestHeat ? 0.0 : value;
    heat = std::max(heat, std::abs(value) * size_[i]);
    const double moved = std::abs(value - before[k]) * size_[i];
    sum += moved;
    change = std::max(change, moved);
  }
  return std::isnan(sum) ? std::numeric_limits<double>::infinity() : change / heat;
}

/// Relaxes the patches layer after layer, until they settle.
/// @return  number of relaxations
Id DistantHeat::March(
  const Layers& layers, double change, const MultiVector& b, MultiVector& u, const Job& job) const
{
  Id relaxed = 0;
  for (Id first = 0; first < layers.Count();)
  {
    job.Check(static_cast<double>(first) / static_cast<double>(layers.Count()));
    const Id last = std::min(layers.Count(), first + LayersAtOnce);
    Id settled = first;
    for (int sweep = 0; settled == first && sweep < MostSweepsPerStep; ++sweep)
    {
      for (Id layer = first; layer < last; ++layer)
      {
        double largest = 0.0;
        for (Id k = layers.begin[layer]; k < layers.begin[layer + 1]; ++k)
        {
          this->FetchAfter(layers, k);
          largest = std::max(largest, this->Relax(layers.patch[k], b, u));
        }
        settled += settled == layer && largest <= change ? 1 : 0;
      }
      relaxed += layers.begin[last] - layers.begin[first];
    }
    first = std::max(settled, first + 1);
  }
  return relaxed;
}

Id DistantHeat::CountUnreached(const Layers& layers, const MultiVector& u) const
{
  std::vector<char> isUnreached(A_.rows, 0);
  for (const Index p : layers.patch)
  {
    for (const Index i : patches_->Unknowns(p))
    {
      isUnreached[i] = 1;
    }
  }
  for (const Index p : layers.patch)
  {
    if (this->HeatOf(p, u) > SmallestHeat)
    {
      for (const Index i : patches_->Unknowns(p))
      {
        isUnreached[i] = 0;
      }
    }
  }
  return std::count(isUnreached.begin(), isUnreached.end(), 1);
}

/// Solves on the level.
/// @param before  heat that is already there; 0: none
HeatField DistantHeat::OnLevel(const MultiVector& load, MultiVector before, const Job& job) const
{
  const MultiVector b = load / t_;
  HeatField heat;
  heat.coefficients = std::move(before);
  MultiVector& u = heat.coefficients;
  const Layers bySteps = this->LayersBySteps(this->StepsFromSources(load, u));
  const bool isEverywhere = std::all_of(
    bySteps.patch.begin(), bySteps.patch.end(), [&](Index p) { return this->HeatOf(p, u) > 0.0; });
  Id relaxed = 0;
  if (direct_)
  {
    direct_->Solve(b, u, job.threads);
  }
  else if (!isEverywhere)
  {
    relaxed = this->March(bySteps, RoughChange, b, u, job.Part(0.0, 0.2));
  }
  double done = 0.2;
  for (int march = 0; march < MostMarches && !heat.converged; ++march)
  {
    // One march is usually enough. Heat that came from behind its front needs another order.
    const double next = 1.0 - 0.2 * (1.0 - done);
    const Layers byHeat = this->LayersByHeat(u, bySteps.Count(), bySteps.patch);
    relaxed += this->March(byHeat, change_, b, u, job.Part(done, next));
    double change = 0.0;
    for (const Index p : byHeat.patch)
    {
      change = std::max(change, this->Relax(p, b, u));
    }
    relaxed += static_cast<Id>(byHeat.patch.size());
    heat.converged = change <= LastChange * change_;
    done = next;
  }
  heat.sweeps = double(relaxed) / std::max(1.0, double(bySteps.patch.size()));
  heat.unreached = this->CountUnreached(bySteps, u);
  return heat;
}

HeatField DistantHeat::Continue(const MultiVector& load, MultiVector heat, const Job& job) const
{
  if (load.rows() != A_.rows || heat.rows() != A_.rows)
  {
    throw InvalidInput("The load or the heat does not fit the matrix.");
  }
  return this->OnLevel(load, std::move(heat), job);
}

double DistantHeat::ChangeOf(const MultiVector& load, MultiVector heat) const
{
  const MultiVector b = load / t_;
  double change = 0.0;
  for (Index p = 0; p < static_cast<Index>(patches_->Count()); ++p)
  {
    change = std::max(change, this->Relax(p, b, heat));
  }
  return change;
}

HeatField DistantHeat::From(const MultiVector& load, const Job& job) const
{
  const Index rows = prolongations_.empty() ? A_.rows : prolongations_.front()->rows;
  if (load.rows() != rows || load.cols() != 1)
  {
    throw InvalidInput("The load has " + std::to_string(load.rows()) + " rows for " +
                       std::to_string(rows) + " functions.");
  }
  MultiVector b = load;
  MultiVector taken;
  for (const SharedMatrix& restriction : restrictions_)
  {
    Multiply(restriction, b, taken, job.threads);
    b.swap(taken);
  }
  HeatField heat = this->OnLevel(b, MultiVector::Zero(A_.rows, 1), job);
  for (auto p = prolongations_.rbegin(); p != prolongations_.rend(); ++p)
  {
    Multiply(*p, heat.coefficients, taken, job.threads);
    heat.coefficients.swap(taken);
  }
  return heat;
}

} // namespace gridfem
