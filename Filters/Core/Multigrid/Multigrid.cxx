#include "Multigrid/Multigrid.h"

#include "Base/Errors.h"
#include "Base/PrecisionTraits.h"
#include "Multigrid/SmootherSequence.h"

#include <algorithm>
#include <array>
#include <string>

namespace gridfem
{
namespace
{

/// Neither the cycle nor the measure of the residual sees the directions that are left out. On a
/// part with flat faces, where they are in a quarter of the patches, eigenvalues moved by 7e-7 at a
/// tolerance of 1e-6. On a brain, where they are in 0.4 % of the patches, eigenvalues moved by
/// 2e-10.
constexpr double UnresolvedShare = 1e-2;

void CheckSweeps(int pre, int post)
{
  if (pre < 0 || post < 0)
  {
    throw InvalidInput("The number of smoothing sweeps must not be negative.");
  }
}

void CheckLevels(const std::vector<MultigridLevel>& levels, const MultigridOptions& options)
{
  if (levels.empty())
  {
    throw InvalidInput("A multigrid hierarchy needs at least one level.");
  }
  CheckSweeps(options.preSweeps, options.postSweeps);
  for (std::size_t l = 0; l < levels.size(); ++l)
  {
    if (levels[l].smoothing)
    {
      CheckSweeps(levels[l].smoothing->preSweeps, levels[l].smoothing->postSweeps);
    }
    const SparseMatrix& A = levels[l].A;
    const SparseMatrix& P = levels[l].prolongation;
    const bool isCoarsest = l + 1 == levels.size();
    if (A.rows != A.columns ||
        (!isCoarsest && (P.rows != A.rows || P.columns != levels[l + 1].A.rows)))
    {
      throw InvalidInput(
        "The matrix or the prolongation of level " + std::to_string(l) + " has the wrong shape.");
    }
  }
}

template<class Real>
std::unique_ptr<BasicSmoother<Real>> MakePatches(
  const SparseMatrix& A, const PatchOrder& order, const MultigridOptions& options)
{
  if constexpr (!PrecisionTraits<Real>::IsSingle)
  {
    return MakePatchSmoother(A, order, options.threads, options.precision);
  }
  else
  {
    return MakeSinglePatchSmoother(A, order, options.threads);
  }
}

} // namespace

template<class Real>
BasicMultigrid<Real>::BasicMultigrid(
  std::vector<MultigridLevel> levels, const MultigridOptions& options)
  : options_(options)
{
  CheckLevels(levels, options_);
  for (std::size_t l = 0; l + 1 < levels.size(); ++l)
  {
    if (levels[l].restriction->rows == 0)
    {
      levels[l].restriction = Transpose(levels[l].prolongation, options_.threads);
    }
  }
  if constexpr (!PrecisionTraits<Real>::IsSingle)
  {
    levels_ = std::move(levels);
    this->BuildSolvers();
  }
  else
  {
    this->ConvertLevels(std::move(levels));
  }
}

/// Converts the levels to levels in single precision.
template<class Real>
void BasicMultigrid<Real>::ConvertLevels(std::vector<MultigridLevel> levels)
{
  const int threads = options_.threads;
  double patches = 0.0;
  double unresolved = 0.0;
  for (MultigridLevel& level : levels)
  {
    const bool isCoarsest = &level == &levels.back();
    MultigridLevel from = std::move(level); // its memory is freed before the next one is made
    BasicMultigridLevel<Real>& to = levels_.emplace_back();
    to.A = InSinglePrecision(from.A, threads);
    if (isCoarsest)
    {
      coarse_ = CoarseSolver(from.A, threads);
      break;
    }
    to.prolongation = InSinglePrecision(from.prolongation, threads);
    to.restriction = InSinglePrecision(from.restriction, threads);
    to.smoothing = from.smoothing;
    to.distributed = from.distributed;
    to.smoother = this->MakeSmoother(from);
    std::array<double, 2> counts{ double(from.order.dof.Count() + from.groups.dof.Count()),
      double(to.smoother->UnresolvedPatches()) };
    SumOverProcesses(from.Rows(), counts);
    patches += counts[0];
    unresolved += counts[1];
  }
  isReliable_ = unresolved <= UnresolvedShare * patches;
  isSingle_.assign(levels_.size(), 0);
}

template<class Real>
void BasicMultigrid<Real>::Update(const std::function<void(std::size_t, SparseMatrix&)>& refill)
{
  for (std::size_t l = 0; l < levels_.size(); ++l)
  {
    refill(l, levels_[l].A);
  }
  this->BuildSolvers();
}

template<class Real>
void BasicMultigrid<Real>::BuildSolvers()
{
  for (std::size_t l = 0; !this->IsCoarsest(l); ++l)
  {
    MultigridLevel& level = levels_[l];
    if (!level.smoother || !level.smoother->Refill(level.A, level.order, options_.threads))
    {
      level.smoother.reset(); // its memory is freed before the new one is built
      level.smoother = this->MakeSmoother(level);
    }
  }
  coarse_ = CoarseSolver(levels_.back().A, options_.threads);
  this->FindSingleLevels();
}

/// Finds the levels that sweep in single precision. Collective: if one process has a smoother in
/// single precision, all processes treat the level so.
template<class Real>
void BasicMultigrid<Real>::FindSingleLevels()
{
  std::vector<double> single(levels_.size());
  std::transform(levels_.begin(), levels_.end(), single.begin(),
    [](const MultigridLevel& level)
    { return level.smoother && level.smoother->IsSingle() ? 1.0 : 0.0; });
  SumOverProcesses(levels_.front().Rows(), single);
  isSingle_.assign(levels_.size(), 0);
  for (std::size_t l = levels_.size(); l-- > 0;)
  {
    isSingle_[l] = single[l] > 0.0 || (l + 1 < levels_.size() && isSingle_[l + 1]);
  }
}

template<class Real>
std::unique_ptr<BasicSmoother<Real>> BasicMultigrid<Real>::MakeSmoother(MultigridLevel& level) const
{
  std::vector<std::unique_ptr<BasicSmoother<Real>>> sequence;
  sequence.push_back(this->MakeFirstSmoother(level));
  if (!level.groups.dof.IsEmpty())
  {
    sequence.push_back(MakePatches<Real>(level.A, level.groups, options_));
  }
  if (level.distributed)
  {
    sequence.push_back(MakeBorderSmoother<Real>(level.distributed));
  }
  return sequence.size() == 1 ? std::move(sequence.front())
                              : MakeSmootherSequence(std::move(sequence));
}

/// Makes the smoother that relaxes all unknowns, in the order of the level.
template<class Real>
std::unique_ptr<BasicSmoother<Real>> BasicMultigrid<Real>::MakeFirstSmoother(
  MultigridLevel& level) const
{
  const SmootherType type = this->SmoothingOf(level.smoothing).smoother;
  if constexpr (!PrecisionTraits<Real>::IsSingle)
  {
    if (type == SmootherType::GaussSeidel)
    {
      return MakeGaussSeidel(level.A, level.order);
    }
    if (type == SmootherType::SliceGaussSeidel)
    {
      return MakeSliceGaussSeidel(level.A, level.order, options_.sweepsPerSynchronization);
    }
    if (options_.precision == FactorPrecision::Mixed && level.groups.dof.IsEmpty())
    {
      bool patternFits = true;
      auto single = MakeStencilSmoother(level.A, level.order, options_.threads, &patternFits);
      if (single)
      {
        return single;
      }
      if (!patternFits)
      {
        level.order.corner.clear(); // stencils are not tried again with other values
      }
    }
  }
  else if (type != SmootherType::Patch)
  {
    throw InvalidInput("A cycle in single precision needs a smoother of patches.");
  }
  return MakePatches<Real>(level.A, level.order, options_);
}

template<class Real>
bool BasicMultigrid<Real>::HasSingleFactors() const
{
  double single = std::any_of(levels_.begin(), levels_.end(),
                    [](const MultigridLevel& level)
                    { return level.smoother && level.smoother->HasSingleFactors(); })
                    ? 1.0
                    : 0.0;
  if (const DistributedRows* distributed = levels_.front().Rows())
  {
    distributed->SumNumbers(&single, 1);
  }
  return single > 0.0;
}

template<class Real>
BasicMultigrid<Real> BasicMultigrid<Real>::InDoublePrecision() const
{
  std::vector<MultigridLevel> levels(levels_.size());
  for (std::size_t l = 0; l < levels_.size(); ++l)
  {
    const MultigridLevel& from = levels_[l];
    levels[l] = { from.A, from.prolongation, from.restriction, from.order, from.groups,
      from.smoothing, from.distributed, nullptr };
  }
  MultigridOptions options = options_;
  options.precision = FactorPrecision::Double;
  return Multigrid(std::move(levels), options);
}

template<class Real>
std::size_t BasicMultigrid<Real>::Memory() const
{
  std::size_t bytes = coarse_.Memory();
  for (const BasicMultigridLevel<Real>& level : levels_)
  {
    bytes += level.A.Memory() + level.prolongation->Memory() + level.restriction->Memory() +
             level.order.dof.unknown.size() * sizeof(Index) +
             (level.order.blockBegin.size() + level.order.colorBegin.size()) * sizeof(Id) +
             level.order.slice.size() * sizeof(Index);
    bytes += level.smoother ? level.smoother->Memory() : 0;
  }
  return bytes;
}

bool FitSinglePrecision(const std::vector<MultigridLevel>& levels, const MultigridOptions& options)
{
  return std::all_of(levels.begin(), levels.end() - 1,
    [&](const MultigridLevel& level)
    {
      const SmootherType type = level.smoothing ? level.smoothing->smoother : options.smoother;
      return type == SmootherType::Patch;
    });
}

template BasicMultigrid<float>::BasicMultigrid(
  std::vector<MultigridLevel>, const MultigridOptions&);
template std::size_t BasicMultigrid<float>::Memory() const;

template BasicMultigrid<double>::BasicMultigrid(
  std::vector<MultigridLevel>, const MultigridOptions&);
template void BasicMultigrid<double>::Update(
  const std::function<void(std::size_t, SparseMatrix&)>&);
template bool BasicMultigrid<double>::HasSingleFactors() const;
template Multigrid BasicMultigrid<double>::InDoublePrecision() const;
template std::size_t BasicMultigrid<double>::Memory() const;

} // namespace gridfem
