// The cycles of a hierarchy that is already built, and the iteration from the coarsest level on.
#include "Multigrid/Multigrid.h"

#include "Algebra/ColumnAlgebra.h"
#include "Base/Errors.h"
#include "Base/LargeMemory.h"
#include "Base/PrecisionTraits.h"

#include <cmath>
#include <string>

namespace gridfem
{
namespace
{

/// Largest absolute value of each column. `+=` takes the larger of the two.
struct LargestNumbers
{
  Eigen::ArrayXd value;

  void operator+=(const LargestNumbers& other) { value = value.max(other.value); }
};

/// Resizes a block. New memory prefers large pages.
template<class Real>
void MakeRoom(Id rows, Id columns, Vectors<Real>& block)
{
  if (block.rows() != rows || block.cols() != columns)
  {
    block.resize(rows, columns);
    PreferLargePages(block.data(), block.size() * sizeof(Real));
  }
}

template<class Real>
void SetZero(Id rows, Id columns, Vectors<Real>& block, int threads)
{
  MakeRoom(rows, columns, block);
  ParallelRanges(rows, ThreadsFor(block.size(), threads),
    [&](Id begin, Id end) { block.middleRows(begin, end - begin).setZero(); });
}

/// Unit of each column: a power of two near its largest number, or near the sum of the largest
/// numbers of all processes. A column of zeros or without a bound gets 1.
template<class Real>
Eigen::ArrayXd UnitsOf(const Vectors<Real>& b, const DistributedRows* distributed, int threads)
{
  Eigen::ArrayXd unit = ParallelSum(b.rows(), ThreadsFor(b.size(), threads),
    LargestNumbers{ Eigen::ArrayXd::Zero(b.cols()) },
    [&](Id begin, Id end) -> LargestNumbers
    {
      const auto rows = b.middleRows(begin, end - begin);
      return { rows.cwiseAbs().colwise().maxCoeff().transpose().array().template cast<double>() };
    }).value;
  SumOverProcesses(distributed, unit);
  for (double& value : unit)
  {
    value = std::isnormal(value) ? std::exp2(std::ilogb(value)) : 1.0;
  }
  return unit;
}

/// Calls body(k, column) for every number of b, in parallel, row after row.
template<class Real, class Body>
void ForEachNumber(const Vectors<Real>& b, int threads, Body&& body)
{
  const Id columns = b.cols();
  ParallelRanges(b.rows(), ThreadsFor(b.size(), threads),
    [&](Id begin, Id end)
    {
      for (Id k = begin * columns, column = 0; k < end * columns; ++k)
      {
        body(k, column);
        column = column + 1 < columns ? column + 1 : 0;
      }
    });
}

/// to = from, with every column multiplied by its factor.
template<class Real>
void Scale(const Vectors<Real>& from, const Eigen::ArrayXd& factor, Vectors<Real>& to, int threads)
{
  MakeRoom(from.rows(), from.cols(), to);
  const Real* const source = from.data();
  Real* const target = to.data();
  ForEachNumber(from, threads,
    [&](Id k, Id column) { target[k] = static_cast<Real>(factor[column] * source[k]); });
}

} // namespace

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
  std::vector<Vectors<Real>> load(levels_.size());
  const typename Pool<Workspace>::Loan workspace(*workspace_);
  std::vector<Scratch>& scratch = (*workspace).For(levels_.size(), b.cols());
  for (std::size_t l = 1; l < levels_.size(); ++l)
  {
    this->RestrictResidual(
      l - 1, l == 1 ? b : load[l - 1], nullptr, scratch[l - 1].residual, load[l]);
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
        this->Prolong(0, x - before, *lastStep);
      }
    }
    Vectors<Real> finer;
    this->Prolong(l - 1, x, finer);
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
  const DistributedRows* const distributed = RowsOf(levels_[l]);
  Columns norm;
  LoadRows(r, b, distributed ? nullptr : &norm, threads);
  if (distributed)
  {
    distributed->Sum(b);
    norm = this->Products(l, b, b);
  }
  const Columns unit = isSingle_[l] ? this->InUnits(l, b, b) : Columns::Ones(width);
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
    HandOver(x, r.columns, z, threads);
  }
  return measures;
}

/// xᵀy of every column, over all processes.
template<class Real>
Columns BasicMultigrid<Real>::Products(
  std::size_t l, const Vectors<Real>& x, const Vectors<Real>& y) const
{
  const DistributedRows* const distributed = RowsOf(levels_[l]);
  Columns products = ColumnProducts(x, y, options_.threads, GhostRows(distributed));
  SumOverProcesses(distributed, products);
  return products;
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

/// fine = P coarse, from the next coarser level, with the full sum in all rows.
template<class Real>
void BasicMultigrid<Real>::Prolong(
  std::size_t l, const Vectors<Real>& coarse, Vectors<Real>& fine) const
{
  Multiply(levels_[l].prolongation, coarse, fine, options_.threads);
  SumProlonged<Real>(RowsOf(levels_[l]), fine);
}

/// x += P coarse
template<class Real>
void BasicMultigrid<Real>::AddProlonged(
  std::size_t l, const Vectors<Real>& coarse, Vectors<Real>& x, Vectors<Real>& scratch) const
{
  const DistributedRows* const distributed = RowsOf(levels_[l]);
  if (distributed && distributed->ArePartsProlonged())
  {
    this->Prolong(l, coarse, scratch);
    x += scratch;
  }
  else
  {
    MultiplyAdd(levels_[l].prolongation, coarse, x, options_.threads);
  }
}

/// coarse = Pᵀ (b - A x), or Pᵀ b without x.
/// @param energy  if not null: xᵀ(b + r) for r = b - A x
template<class Real>
void BasicMultigrid<Real>::RestrictResidual(std::size_t l, const Vectors<Real>& b,
  const Vectors<Real>* x, Vectors<Real>& residual, Vectors<Real>& coarse, Columns* energy) const
{
  const BasicMultigridLevel<Real>& level = levels_[l];
  const DistributedRows* const distributed = RowsOf(level);
  const Index ghosts = GhostRows(distributed);
  const bool countOnce = distributed && !distributed->ArePartsProlonged(); // shared rows count once
  if (x)
  {
    MakeRoom(b.rows(), b.cols(), residual);
    ResidualPart(level.A, *x, b, ghosts, residual, energy, options_.threads);
    SumProlonged<Real>(distributed, residual);
  }
  else if (countOnce)
  {
    residual = b;
    residual.topRows(ghosts).setZero();
  }
  MakeRoom(level.restriction->rows, b.cols(), coarse);
  Multiply(level.restriction, x || countOnce ? residual : b, coarse, options_.threads);
  if (level.distributed)
  {
    level.distributed->SumCoarse(coarse);
  }
  if (x && energy)
  {
    SumOverProcesses(RowsOf(level), *energy);
  }
  else if (energy)
  {
    *energy = Columns::Zero(b.cols());
  }
}

/// scaled = b in units of its columns, so that single precision gets numbers near 1. Returns the
/// units. b and scaled may be the same block.
template<class Real>
Columns BasicMultigrid<Real>::InUnits(
  std::size_t l, const Vectors<Real>& b, Vectors<Real>& scaled) const
{
  Columns unit = UnitsOf(b, RowsOf(levels_[l]), options_.threads);
  Scale(b, unit.inverse(), scaled, options_.threads);
  return unit;
}

/// x = B b
template<class Real>
void BasicMultigrid<Real>::Correct(
  std::size_t l, const Vectors<Real>& b, Vectors<Real>& x, std::vector<Scratch>& scratch) const
{
  if (!isSingle_[l])
  {
    this->CycleLevel(l, b, x, true, scratch);
    return;
  }
  const Columns unit = this->InUnits(l, b, scratch[l].b);
  this->CycleLevel(l, scratch[l].b, x, true, scratch);
  Scale(x, unit, x, options_.threads);
}

/// x += B (b - A x). Single precision computes only the correction, so its rounding is small
/// compared to x.
template<class Real>
void BasicMultigrid<Real>::Improve(
  std::size_t l, const Vectors<Real>& b, Vectors<Real>& x, std::vector<Scratch>& scratch) const
{
  if (!isSingle_[l])
  {
    this->CycleLevel(l, b, x, false, scratch);
    return;
  }
  Vectors<Real>& residual = scratch[l].b;
  Vectors<Real>& correction = scratch[l].x;
  const DistributedRows* const distributed = RowsOf(levels_[l]);
  ResidualPart<Real>(
    levels_[l].A, x, b, GhostRows(distributed), residual, nullptr, options_.threads);
  if (distributed)
  {
    distributed->Sum(residual);
  }
  const Columns unit = this->InUnits(l, residual, residual);
  this->CycleLevel(l, residual, correction, true, scratch);
  Real* const target = x.data();
  const Real* const source = correction.data();
  ForEachNumber(
    x, options_.threads, [&](Id k, Id column) { target[k] += unit[column] * source[k]; });
}

template<class Real>
void BasicMultigrid<Real>::CycleLevel(std::size_t l, const Vectors<Real>& b, Vectors<Real>& x,
  bool zeroStart, std::vector<Scratch>& scratch) const
{
  this->Descend(l, b, x, zeroStart, scratch);
  this->Ascend(l, b, x, scratch);
}

template<class Real>
void BasicMultigrid<Real>::Sweep(std::size_t l, const Vectors<Real>& b, Vectors<Real>& x,
  SweepDirection direction, int times) const
{
  for (int sweep = 0; sweep < times; ++sweep)
  {
    levels_[l].smoother->Sweep(levels_[l].A, b, x, direction, options_.threads);
  }
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
  if (this->IsCoarsest(l))
  {
    this->SolveCoarsest(b, x);
    if (energy)
    {
      *energy = this->Products(l, b, x);
    }
    return;
  }
  const LevelSmoothing smoothing = this->SmoothingOf(levels_[l].smoothing);
  if (zeroStart)
  {
    SetZero(b.rows(), b.cols(), x, options_.threads);
  }
  this->Sweep(l, b, x, SweepDirection::Forward, smoothing.preSweeps);
  Scratch& coarse = scratch[l + 1];
  const bool isZero = zeroStart && smoothing.preSweeps == 0;
  this->RestrictResidual(l, b, isZero ? nullptr : &x, scratch[l].residual, coarse.b, energy);
  // The coarsest level is solved directly, so one visit is enough.
  const bool once = smoothing.cycle == CycleType::V || this->IsCoarsest(l + 1);
  for (int time = 0; time < (once ? 1 : 2); ++time)
  {
    this->CycleLevel(l + 1, coarse.b, coarse.x, time == 0, scratch);
  }
  if (energy)
  {
    *energy += this->Products(l + 1, coarse.b, coarse.x);
  }
}

/// The second half of a cycle: adds the correction that Descend has found, and does the last
/// sweeps.
template<class Real>
void BasicMultigrid<Real>::Ascend(
  std::size_t l, const Vectors<Real>& b, Vectors<Real>& x, std::vector<Scratch>& scratch) const
{
  if (!this->IsCoarsest(l))
  {
    this->AddProlonged(l, scratch[l + 1].x, x, scratch[l].residual);
    this->Sweep(
      l, b, x, SweepDirection::Backward, this->SmoothingOf(levels_[l].smoothing).postSweeps);
  }
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
