// The cycles of a hierarchy that is already built, and the iteration from the coarsest level on.
#include "Multigrid/Multigrid.h"

#include "Algebra/ColumnUnits.h"
#include "Base/Errors.h"
#include "Base/PrecisionTraits.h"

#include <string>

namespace gridfem
{

/// x += B (b - A x), or x = B b from zero.
template<class Real>
void BasicMultigrid<Real>::CycleLevel(std::size_t l, const Vectors<Real>& b, Vectors<Real>& x,
  bool zeroStart, std::vector<Scratch>& scratch) const
{
  this->Descend(l, b, x, zeroStart, scratch);
  this->Ascend(l, b, x, scratch);
}

/// The first half of a cycle: the first sweeps, and the correction from the next coarser level. On
/// the coarsest level it is the whole solve.
/// @param energy  if not null, from zero: bᵀBb. Let S stand for the first sweeps, S̄ for the first
///   and the last sweeps together, and B' for the coarser levels. Then B = S̄ + (1 - SᵀA) P B' Pᵀ
///   (1 - A S). So bᵀBb = xᵀ(b + r) + (Pᵀr)ᵀ B' (Pᵀr) for x = S b and r = b - A x.
template<class Real>
void BasicMultigrid<Real>::Descend(std::size_t l, const Vectors<Real>& b, Vectors<Real>& x,
  bool zeroStart, std::vector<Scratch>& scratch, Columns* energy) const
{
  const BasicMultigridLevel<Real>& level = levels_[l];
  const int threads = options_.threads;
  if (this->IsCoarsest(l))
  {
    this->SolveCoarsest(b, x);
    if (energy)
    {
      *energy = level.Products(b, x, threads);
    }
    return;
  }
  if (zeroStart)
  {
    SetZero(b.rows(), b.cols(), x, threads);
  }
  const LevelSmoothing smoothing = this->SmoothingOf(level.smoothing);
  Scratch& coarse = scratch[l + 1];
  level.Sweep(b, x, SweepDirection::Forward, smoothing.preSweeps, threads);
  level.RestrictResidual(b, x, scratch[l].residual, coarse.b, energy, threads);
  // The coarsest level is solved directly, so one visit is enough.
  const bool twice = smoothing.cycle == CycleType::W && !this->IsCoarsest(l + 1);
  for (int time = 0; time < (twice ? 2 : 1); ++time)
  {
    this->CycleLevel(l + 1, coarse.b, coarse.x, time == 0, scratch);
  }
  if (energy)
  {
    *energy += levels_[l + 1].Products(coarse.b, coarse.x, threads);
  }
}

/// The second half of a cycle: adds the correction that Descend has found, and does the last
/// sweeps.
template<class Real>
void BasicMultigrid<Real>::Ascend(
  std::size_t l, const Vectors<Real>& b, Vectors<Real>& x, std::vector<Scratch>& scratch) const
{
  if (this->IsCoarsest(l))
  {
    return;
  }
  const BasicMultigridLevel<Real>& level = levels_[l];
  const int sweeps = this->SmoothingOf(level.smoothing).postSweeps;
  level.ProlongAdd(scratch[l + 1].x, x, scratch[l].residual, options_.threads);
  level.Sweep(b, x, SweepDirection::Backward, sweeps, options_.threads);
}

/// The coarsest system has few unknowns and is solved in double precision.
template<class Real>
void BasicMultigrid<Real>::SolveCoarsest(const Vectors<Real>& b, Vectors<Real>& x) const
{
  if constexpr (!PrecisionTraits<Real>::IsSingle)
  {
    coarse_.Solve(b, x, options_.threads);
  }
  else
  {
    MultiVector solution;
    coarse_.Solve(b.template cast<double>(), solution, options_.threads);
    x = solution.template cast<Real>();
  }
}

/// x = B b on the device, or on the CPU if the device fails; see DeviceHierarchy::Precondition.
template<class Real>
void BasicMultigrid<Real>::CorrectOnDevice(
  std::size_t l, const Vectors<Real>& b, Vectors<Real>& x, bool isMeasured) const
{
  if (device_->Precondition(l, b, x, isMeasured))
  {
    return;
  }
  const BasicMultigrid& onCpu = this->OnCpu();
  const typename Pool<Workspace>::Loan workspace(*onCpu.workspace_);
  onCpu.Correct(l, b, x, (*workspace).For(onCpu.levels_.size(), b.cols()));
}

/// x = B b. Levels in single precision get b in units of its columns.
template<class Real>
void BasicMultigrid<Real>::Correct(
  std::size_t l, const Vectors<Real>& b, Vectors<Real>& x, std::vector<Scratch>& scratch) const
{
  if (device_)
  {
    this->CorrectOnDevice(l, b, x, true);
    return;
  }
  if (!isSingle_[l])
  {
    this->CycleLevel(l, b, x, true, scratch);
    return;
  }
  const int threads = options_.threads;
  const Columns unit = InUnits(b, levels_[l].Rows(), scratch[l].b, threads);
  this->CycleLevel(l, scratch[l].b, x, true, scratch);
  Scale(x, unit, x, threads);
}

/// x += B (b - A x). Single precision computes only the correction, so its rounding is small
/// compared to x.
template<class Real>
void BasicMultigrid<Real>::Improve(
  std::size_t l, const Vectors<Real>& b, Vectors<Real>& x, std::vector<Scratch>& scratch) const
{
  if (!device_ && !isSingle_[l])
  {
    this->CycleLevel(l, b, x, false, scratch);
    return;
  }
  const int threads = options_.threads;
  Vectors<Real>& residual = scratch[l].b;
  Vectors<Real>& correction = scratch[l].x;
  levels_[l].Residual(b, x, residual, threads);
  if (device_)
  {
    this->CorrectOnDevice(l, residual, correction, false);
    x += correction;
    return;
  }
  const Columns unit = InUnits(residual, levels_[l].Rows(), residual, threads);
  this->CycleLevel(l, residual, correction, true, scratch);
  AddInUnits(correction, unit, x, threads);
}

template<class Real>
auto BasicMultigrid<Real>::Workspace::For(std::size_t levels, Id wanted) -> std::vector<Scratch>&
{
  if (wanted != columns)
  {
    scratch.clear();
    columns = wanted;
  }
  scratch.resize(levels);
  return scratch;
}

template<class Real>
void BasicMultigrid<Real>::CheckRows(std::size_t level, Id rows) const
{
  const Index unknowns = levels_.at(level).A.rows;
  if (rows != unknowns)
  {
    throw InvalidInput("A right-hand side of " + std::to_string(rows) +
                       " rows does not fit a system of " + std::to_string(unknowns) + " unknowns.");
  }
}

template<class Real>
void BasicMultigrid<Real>::RequireSymmetry(std::size_t level) const
{
  for (std::size_t l = level; !this->IsCoarsest(l); ++l)
  {
    const LevelSmoothing smoothing = this->SmoothingOf(levels_[l].smoothing);
    if (smoothing.preSweeps != smoothing.postSweeps)
    {
      throw InvalidInput(
        "A cycle that preconditions needs equally many sweeps before and after the "
        "correction.");
    }
  }
}

template<class Real>
void BasicMultigrid<Real>::Cycle(const Vectors<Real>& b, Vectors<Real>& x) const
{
  if (x.rows() != b.rows() || x.cols() != b.cols())
  {
    throw InvalidInput("The blocks x and b of a multigrid cycle must have the same shape.");
  }
  this->CheckRows(0, b.rows());
  const typename Pool<Workspace>::Loan workspace(*workspace_);
  this->Improve(0, b, x, (*workspace).For(levels_.size(), b.cols()));
}

template<class Real>
void BasicMultigrid<Real>::Precondition(const Vectors<Real>& b, Vectors<Real>& x) const
{
  this->CheckRows(0, b.rows());
  const typename Pool<Workspace>::Loan workspace(*workspace_);
  this->Correct(0, b, x, (*workspace).For(levels_.size(), b.cols()));
}

template<class Real>
void BasicMultigrid<Real>::NestedIteration(
  const Vectors<Real>& b, Vectors<Real>& x, Vectors<Real>* lastStep) const
{
  this->CheckRows(0, b.rows());
  const int threads = options_.threads;
  std::vector<Vectors<Real>> load(levels_.size());
  const typename Pool<Workspace>::Loan workspace(*workspace_);
  std::vector<Scratch>& scratch = (*workspace).For(levels_.size(), b.cols());
  for (std::size_t l = 1; l < levels_.size(); ++l)
  {
    levels_[l - 1].Restrict(l == 1 ? b : load[l - 1], load[l], threads);
  }
  this->SolveCoarsest(levels_.size() == 1 ? b : load.back(), x);
  for (std::size_t l = levels_.size() - 1; l > 0; --l)
  {
    if (!this->IsCoarsest(l))
    {
      const Vectors<Real> before = l == 1 && lastStep ? x : Vectors<Real>();
      this->Improve(l, load[l], x, scratch);
      if (l == 1 && lastStep)
      {
        levels_[0].Prolong(x - before, *lastStep, threads);
      }
    }
    Vectors<Real> finer;
    levels_[l - 1].Prolong(x, finer, threads);
    x.swap(finer);
  }
}

template<class Real>
template<class Given>
ResidualMeasures BasicMultigrid<Real>::PreconditionRows(std::size_t l, const RowSource<Given>& r,
  const CorrectionTest& isWanted, const RowSink<Given>& z) const
{
  this->CheckRows(l, r.rows);
  if (r.columns > WidestPanel)
  {
    throw InvalidInput("A cycle preconditions only a few columns at a time.");
  }
  this->RequireSymmetry(l);
  const int threads = options_.threads;
  const Id width = PrecisionTraits<Real>::PanelWidth(r.columns);
  const typename Pool<Workspace>::Loan workspace(*workspace_);
  std::vector<Scratch>& scratch = (*workspace).For(levels_.size(), width);
  Vectors<Real>& b = scratch[l].b;
  Vectors<Real>& x = scratch[l].x;
  MakeRoom(r.rows, width, b);
  const DistributedRows* const distributed = levels_[l].Rows();
  Columns norm;
  LoadRows(r, b, distributed ? nullptr : &norm, threads);
  if (distributed)
  {
    distributed->Sum(b);
    norm = levels_[l].Products(b, b, threads);
  }
  if (device_)
  {
    this->CorrectOnDevice(l, b, x, true);
    const ResidualMeasures measures{ levels_[l].Products(b, x, threads).head(r.columns),
      norm.head(r.columns) };
    if (isWanted(measures))
    {
      StoreRows(x, r.columns, z, threads);
    }
    return measures;
  }
  const Columns unit = isSingle_[l] ? InUnits(b, distributed, b, threads) : Columns::Ones(width);
  Columns energy;
  this->Descend(l, b, x, true, scratch, &energy);
  energy *= unit.square();
  ResidualMeasures measures{ energy.head(r.columns), norm.head(r.columns) };
  if (isWanted(measures))
  {
    this->Ascend(l, b, x, scratch);
    if (isSingle_[l])
    {
      Scale(x, unit, x, threads);
    }
    StoreRows(x, r.columns, z, threads);
  }
  return measures;
}

template void BasicMultigrid<double>::Cycle(const MultiVector&, MultiVector&) const;
template void BasicMultigrid<double>::Precondition(const MultiVector&, MultiVector&) const;
template void BasicMultigrid<double>::NestedIteration(
  const MultiVector&, MultiVector&, MultiVector*) const;

#define GRIDFEM_PRECONDITION_ROWS(Real, Given)                                                     \
  template ResidualMeasures BasicMultigrid<Real>::PreconditionRows(                                \
    std::size_t, const RowSource<Given>&, const CorrectionTest&, const RowSink<Given>&) const

GRIDFEM_PRECONDITION_ROWS(float, float);
GRIDFEM_PRECONDITION_ROWS(float, double);
GRIDFEM_PRECONDITION_ROWS(double, float);
GRIDFEM_PRECONDITION_ROWS(double, double);

#undef GRIDFEM_PRECONDITION_ROWS

} // namespace gridfem
