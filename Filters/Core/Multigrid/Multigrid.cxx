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

/// A copy of levels without smoothers. It shares patterns and prolongations.
std::vector<MultigridLevel> CopyLevels(const std::vector<MultigridLevel>& levels)
{
  std::vector<MultigridLevel> copy;
  for (const MultigridLevel& from : levels)
  {
    copy.push_back({ from.A, from.prolongation, from.restriction, from.order, from.groups,
      from.smoothing, from.distributed, nullptr });
  }
  return copy;
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

/// Moves the cycles to a device if there is one, or takes new values of the matrices there.
template<class Real>
void BasicMultigrid<Real>::UseDevice(const std::vector<MultigridLevel>& levels)
{
  spare_.reset();
  if (device_ && !device_->Update(levels, whyNotOnDevice_))
  {
    device_.reset();
  }
  else if (!device_ && whyNotOnDevice_.empty())
  {
    device_ = DeviceHierarchy::Make(levels, options_, whyNotOnDevice_);
  }
  if (device_)
  {
    spare_ = std::make_unique<Spare>();
  }
}

/// Converts the levels to levels in single precision.
template<class Real>
void BasicMultigrid<Real>::ConvertLevels(std::vector<MultigridLevel> levels)
{
  const int threads = options_.threads;
  isSingle_.assign(levels.size(), 0);
  coarse_ = CoarseSolver(levels.back().A, threads);
  this->UseDevice(levels);
  if (device_)
  {
    for (const MultigridLevel& level : levels)
    {
      levels_.emplace_back().A = InSinglePrecision(level.A, threads);
    }
    spare_->levels = std::move(levels);
    return;
  }
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
  coarse_ = CoarseSolver(levels_.back().A, options_.threads);
  this->UseDevice(levels_);
  if (device_)
  {
    isSingle_.assign(levels_.size(), 0);
    return;
  }
  for (std::size_t l = 0; !this->IsCoarsest(l); ++l)
  {
    MultigridLevel& level = levels_[l];
    if (!level.smoother || !level.smoother->Refill(level.A, level.order, options_.threads))
    {
      level.smoother.reset(); // its memory is freed before the new one is built
      level.smoother = this->MakeSmoother(level);
    }
  }
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
  if (device_)
  {
    return true;
  }
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
  MultigridOptions options = options_;
  options.precision = FactorPrecision::Double;
  return Multigrid(CopyLevels(levels_), options);
}

template<class Real>
std::string BasicMultigrid<Real>::Where() const
{
  const std::string failure = device_ ? device_->Failure() : whyNotOnDevice_;
  return failure.empty() ? "GPU: " + device_->Name() : "CPU: " + failure;
}

/// The same hierarchy on the CPU, once the device has failed.
template<class Real>
auto BasicMultigrid<Real>::OnCpu() const -> const BasicMultigrid&
{
  std::call_once(spare_->isMade,
    [&]
    {
      MultigridOptions options = options_;
      options.device = DeviceChoice::Cpu;
      if constexpr (PrecisionTraits<Real>::IsSingle)
      {
        spare_->onCpu = std::make_unique<const BasicMultigrid>(CopyLevels(spare_->levels), options);
      }
      else
      {
        spare_->onCpu = std::make_unique<const BasicMultigrid>(CopyLevels(levels_), options);
      }
    });
  return *spare_->onCpu;
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

template auto BasicMultigrid<float>::OnCpu() const -> const BasicMultigrid<float>&;
template auto BasicMultigrid<double>::OnCpu() const -> const BasicMultigrid<double>&;
template BasicMultigrid<float>::BasicMultigrid(
  std::vector<MultigridLevel>, const MultigridOptions&);
template std::size_t BasicMultigrid<float>::Memory() const;
template std::string BasicMultigrid<float>::Where() const;
template std::string BasicMultigrid<double>::Where() const;

template BasicMultigrid<double>::BasicMultigrid(
  std::vector<MultigridLevel>, const MultigridOptions&);
template void BasicMultigrid<double>::Update(
  const std::function<void(std::size_t, SparseMatrix&)>&);
template bool BasicMultigrid<double>::HasSingleFactors() const;
template Multigrid BasicMultigrid<double>::InDoublePrecision() const;
template std::size_t BasicMultigrid<double>::Memory() const;

} // namespace gridfem
