#include "Parallel/RankSmoother.h"

#include "Spaces/PatchOrdering.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

namespace gridfem
{

namespace
{

/// Patches whose functions this rank has alone, shares with one other, with more.
constexpr Index Kinds = 3;

/// A level with the same functions.
PatchLevel WithoutPatches(const PatchLevel& level)
{
  PatchLevel none;
  none.depth = level.depth;
  none.numberOfFunctions = level.numberOfFunctions;
  return none;
}

/// How many ranks touch a function of the patch, at most.
Index RanksAt(const std::array<Index, FunctionsPerPatch>& patch, const LevelNumbering& numbering)
{
  Index most = 1;
  for (const Index function : patch)
  {
    most = std::max(most, numbering.touching[function]);
  }
  return most;
}

std::vector<PatchLevel> PatchesByRanks(const PatchLevel& level, const LevelNumbering& numbering)
{
  std::vector<PatchLevel> parts(Kinds, WithoutPatches(level));
  for (Id patch = 0; patch < level.NumberOfPatches(); ++patch)
  {
    PatchLevel& part = parts[std::min(RanksAt(level.dof[patch], numbering), Kinds) - 1];
    part.cell.push_back(level.cell[patch]);
    part.dof.push_back(level.dof[patch]);
  }
  return parts;
}

std::vector<Index> SharedFunctions(const LevelNumbering& numbering)
{
  std::vector<Index> shared;
  for (Index function = 0; function < numbering.Functions(); ++function)
  {
    if (numbering.touching[function] > 1)
    {
      shared.push_back(function);
    }
  }
  return shared;
}

double RowProduct(const SparseMatrix& A, Index row, const MultiVector& x)
{
  double sum = 0.0;
  for (Id k = A.rowBegin[row]; k < A.rowBegin[row + 1]; ++k)
  {
    sum += A.value[k] * x(A.column[k], 0);
  }
  return sum;
}

} // namespace

RankSmoother::RankSmoother(const Communicator& ranks, Mat matrix, const SparseMatrix& own,
  const LevelNumbering& numbering, const PatchLevel& level, const MultigridOptions& options)
  : threads_(options.threads), foreign_(numbering.foreign), shared_(SharedFunctions(numbering)),
    matrix_(WholeRows(ranks, matrix, numbering, shared_, own)),
    exchange_(ranks, numbering, shared_), sum_(exchange_.Make())
{
  double most = 1.0;
  ranks.Together(
    [&]
    {
      for (const Index touching : numbering.touching)
      {
        most = std::max(most, double(touching));
      }
    });
  ranks.Maximum(&most, 1);
  ranks.Together(
    [&]
    {
      const std::vector<PatchLevel> parts = PatchesByRanks(level, numbering);
      const auto smootherOf = [&](const PatchLevel& part)
      { return MakePatchSmoother(matrix_, OrderPatches(part), threads_, options.precision); };
      alone_ = smootherOf(parts[0]);
      for (int kind = 1; kind < std::min(most, double(Kinds)); ++kind)
      {
        steps_.push_back({ smootherOf(parts[kind]), 1.0 / (kind == 1 ? 2.0 : most) });
      }
      this->FindFunctions(numbering, level);
      ownShared_ = SomeRows(own, shared_);
      entries_.resize(shared_.size());
      for (MultiVector* x : { &b_, &x_, &residual_, &change_ })
      {
        x->setZero(numbering.Functions(), 1);
      }
    });
}

void RankSmoother::FindFunctions(const LevelNumbering& numbering, const PatchLevel& level)
{
  for (const auto& patch : level.dof)
  {
    if (RanksAt(patch, numbering) == 1)
    {
      continue;
    }
    std::copy_if(patch.begin(), patch.end(), std::back_inserter(near_),
      [&](Index function) { return numbering.touching[function] == 1; });
  }
  std::sort(near_.begin(), near_.end());
  near_.erase(std::unique(near_.begin(), near_.end()), near_.end());
}

/// Runs what is not collective: other ranks wait for this one's messages, whatever happens in it.
template<class Body>
void RankSmoother::Keep(Body&& body)
{
  try
  {
    body();
  }
  catch (...)
  {
    failure_ = std::current_exception();
  }
}

void RankSmoother::Load(Vec b, Vec x)
{
  const auto load = [&](Vec vector, MultiVector& entries)
  {
    const PetscScalar* values = nullptr;
    Check(VecGetArrayRead(vector, &values));
    std::copy_n(values, entries.rows() - foreign_, entries.data() + foreign_);
    Check(VecRestoreArrayRead(vector, &values));
  };
  load(b, b_);
  load(x, x_);
  if (!steps_.empty())
  {
    exchange_.Spread(x, entries_);
    for (Index k = 0; k < foreign_; ++k) // all of which are shared
    {
      x_(k, 0) = entries_[k];
    }
  }
}

void RankSmoother::Store(Vec x) const
{
  VectorEntries entries(x);
  for (Id k = foreign_; k < x_.rows(); ++k)
  {
    entries[k - foreign_] = x_(k, 0);
  }
}

void RankSmoother::RelaxAlone(SweepDirection direction)
{
  this->Keep([&] { alone_->Sweep(matrix_, b_, x_, direction, threads_); });
}

/// Where corrections of patches with shared functions look at it. Every rank has the rows of shared
/// functions in part.
void RankSmoother::FindResidual()
{
  for (std::size_t k = 0; k < shared_.size(); ++k)
  {
    entries_[k] = RowProduct(ownShared_, static_cast<Index>(k), x_);
  }
  exchange_.Add(entries_, sum_);
  {
    VectorEntries sum(sum_);
    for (std::size_t k = foreign_; k < shared_.size(); ++k)
    {
      sum[shared_[k] - foreign_] = b_(shared_[k], 0) - sum[shared_[k] - foreign_];
    }
  }
  exchange_.Spread(sum_, entries_);
  for (std::size_t k = 0; k < shared_.size(); ++k)
  {
    residual_(shared_[k], 0) = entries_[k];
  }
  for (const Index function : near_)
  {
    residual_(function, 0) = b_(function, 0) - RowProduct(matrix_, function, x_);
  }
}

void RankSmoother::RelaxShared(const Step& step, SweepDirection direction)
{
  this->FindResidual();
  for (const auto& functions : { std::cref(shared_), std::cref(near_) })
  {
    for (const Index function : functions.get())
    {
      change_(function, 0) = 0.0;
    }
  }
  this->Keep([&] { step.smoother->Sweep(matrix_, residual_, change_, direction, threads_); });
  for (const Index function : near_)
  {
    x_(function, 0) += step.damping * change_(function, 0);
  }
  for (std::size_t k = 0; k < shared_.size(); ++k)
  {
    entries_[k] = step.damping * change_(shared_[k], 0);
  }
  exchange_.Add(entries_, sum_);
  exchange_.Spread(sum_, entries_);
  for (std::size_t k = 0; k < shared_.size(); ++k)
  {
    x_(shared_[k], 0) += entries_[k];
  }
}

void RankSmoother::Sweep(Vec b, Vec x, SweepDirection direction)
{
  this->Load(b, x);
  if (direction == SweepDirection::Forward)
  {
    this->RelaxAlone(direction);
    for (const Step& step : steps_)
    {
      this->RelaxShared(step, direction);
    }
  }
  else
  {
    for (auto step = steps_.rbegin(); step != steps_.rend(); ++step)
    {
      this->RelaxShared(*step, direction);
    }
    this->RelaxAlone(direction);
  }
  this->Store(x);
  if (failure_)
  {
    std::rethrow_exception(std::exchange(failure_, nullptr));
  }
}

} // namespace gridfem
