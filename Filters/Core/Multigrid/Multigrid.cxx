#include "Multigrid/Multigrid.h"

#include "Algebra/RowKernels.h"
#include "Base/Errors.h"
#include "Multigrid/SmootherSequence.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace gridfem
{
namespace
{

void CheckSweeps(int pre, int post)
{
  if (pre < 0 || post < 0)
  {
    throw InvalidInput("the number of smoothing sweeps must not be negative");
  }
}

void CheckLevels(const std::vector<MultigridLevel>& levels, const MultigridOptions& options)
{
  if (levels.empty())
  {
    throw InvalidInput("a multigrid hierarchy needs at least one level");
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
        "the matrix or the prolongation of level " + std::to_string(l) + " has the wrong shape");
    }
  }
}

/// Of the absolute values in every column; += is the larger of both.
struct LargestNumbers
{
  Eigen::ArrayXd value;

  void operator+=(const LargestNumbers& other) { value = value.max(other.value); }
};

/// Makes b - A x, with the part of A that is here, a part of the residual: a row of b counts where
/// it belongs to.
void LeaveToOwners(const DividedRows& divided, const MultiVector& b, MultiVector& r)
{
  r.topRows(divided.Foreign()) -= b.topRows(divided.Foreign());
}

/// Per column a power of two near the largest number, or the sum of the largest of all processes;
/// 1 for a column of zeros or without a bound.
Eigen::ArrayXd UnitsOf(const MultiVector& b, const DividedRows* divided, int threads)
{
  Eigen::ArrayXd unit = ParallelSum(b.rows(), ThreadsFor(b.size(), threads),
    LargestNumbers{ Eigen::ArrayXd::Zero(b.cols()) },
    [&](Id begin, Id end) -> LargestNumbers
    {
      const auto rows = b.middleRows(begin, end - begin);
      return { rows.cwiseAbs().colwise().maxCoeff().transpose().array() };
    }).value;
  SumOverProcesses(divided, unit);
  for (double& value : unit)
  {
    value = std::isnormal(value) ? std::exp2(std::ilogb(value)) : 1.0;
  }
  return unit;
}

/// Calls body(k, column) for every number of b, in parallel, row after row.
template<class Body>
void ForEachNumber(const MultiVector& b, int threads, Body&& body)
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

/// to = from, every column times its factor.
void Scale(const MultiVector& from, const Eigen::ArrayXd& factor, MultiVector& to, int threads)
{
  to.resize(from.rows(), from.cols());
  const double* const source = from.data();
  double* const target = to.data();
  ForEachNumber(from, threads, [&](Id k, Id column) { target[k] = factor[column] * source[k]; });
}

std::size_t MatrixMemory(const SparseMatrix& A)
{
  return A.rowBegin.size() * sizeof(Id) + A.column.size() * sizeof(Index) +
         A.value.size() * sizeof(double);
}

} // namespace

Multigrid::Multigrid(std::vector<MultigridLevel> levels, const MultigridOptions& options)
  : levels_(std::move(levels)), options_(options)
{
  CheckLevels(levels_, options_);
  for (std::size_t l = 0; l + 1 < levels_.size(); ++l)
  {
    if (levels_[l].restriction->rows == 0)
    {
      levels_[l].restriction = Transpose(levels_[l].prolongation, options_.threads);
    }
  }
  this->BuildSolvers();
}

void Multigrid::Update(std::vector<SparseMatrix> matrices)
{
  bool fits = matrices.size() == levels_.size();
  for (std::size_t l = 0; fits && l < levels_.size(); ++l)
  {
    fits = matrices[l].rows == levels_[l].A.rows && matrices[l].columns == levels_[l].A.columns &&
           matrices[l].NonZeros() == levels_[l].A.NonZeros();
  }
  if (!fits)
  {
    throw InvalidInput("new matrix values must have the patterns of the hierarchy");
  }
  this->Update([&](std::size_t l, SparseMatrix& matrix) { matrix = std::move(matrices[l]); });
}

void Multigrid::Update(const std::function<void(std::size_t, SparseMatrix&)>& refill)
{
  for (std::size_t l = 0; l < levels_.size(); ++l)
  {
    refill(l, levels_[l].A);
  }
  this->BuildSolvers();
}

void Multigrid::BuildSolvers()
{
  for (std::size_t l = 0; l + 1 < levels_.size(); ++l)
  {
    MultigridLevel& level = levels_[l];
    if (!level.smoother || !level.smoother->Refill(level.A, level.order, options_.threads))
    {
      level.smoother.reset(); // its memory is free before the new one is built
      level.smoother = this->MakeSmoother(l);
    }
  }
  coarse_ = CoarseSolver(levels_.back().A, options_.threads);
  this->FindSingle();
}

/// Where processes divide levels, what one of them has counts for all: they go the same way.
void Multigrid::FindSingle()
{
  std::vector<double> single(levels_.size());
  std::transform(levels_.begin(), levels_.end(), single.begin(),
    [](const MultigridLevel& level)
    { return level.smoother && level.smoother->IsSingle() ? 1.0 : 0.0; });
  SumOverProcesses(RowsOf(levels_.front()), single);
  isSingle_.assign(levels_.size(), 0);
  for (std::size_t l = levels_.size(); l-- > 0;)
  {
    isSingle_[l] = single[l] > 0.0 || (l + 1 < levels_.size() && isSingle_[l + 1]);
  }
}

std::unique_ptr<Smoother> Multigrid::MakeSmoother(std::size_t l)
{
  MultigridLevel& level = levels_[l];
  std::vector<std::unique_ptr<Smoother>> sequence;
  sequence.push_back(this->MakeSmoother(level, this->SmoothingOf(l).smoother));
  if (!level.groups.dof.empty())
  {
    sequence.push_back(
      MakePatchSmoother(level.A, level.groups, options_.threads, options_.precision));
  }
  if (level.divided)
  {
    sequence.push_back(MakeBorderSmoother(level.divided));
  }
  return sequence.size() == 1 ? std::move(sequence.front())
                              : MakeSmootherSequence(std::move(sequence));
}

std::unique_ptr<Smoother> Multigrid::MakeSmoother(MultigridLevel& level, SmootherType type)
{
  switch (type)
  {
    case SmootherType::GaussSeidel:
      return MakeGaussSeidel(level.A, level.order);
    case SmootherType::SliceGaussSeidel:
      return MakeSliceGaussSeidel(level.A, level.order, options_.sweepsPerSynchronisation);
    default:
      break;
  }
  const bool mayBeSingle = options_.precision == FactorPrecision::Mixed && level.groups.dof.empty();
  bool patternFits = true;
  auto single = mayBeSingle
                  ? MakeStencilSmoother(level.A, level.order, options_.threads, &patternFits)
                  : nullptr;
  if (!patternFits)
  {
    level.order.corner.clear(); // stencils are not tried again with other values
  }
  return single ? std::move(single)
                : MakePatchSmoother(level.A, level.order, options_.threads, options_.precision);
}

LevelSmoothing Multigrid::SmoothingOf(std::size_t level) const
{
  return levels_[level].smoothing.value_or(
    LevelSmoothing{ options_.smoother, options_.preSweeps, options_.postSweeps, options_.cycle });
}

bool Multigrid::HasSingleFactors() const
{
  double single = std::any_of(levels_.begin(), levels_.end(),
                    [](const MultigridLevel& level)
                    { return level.smoother && level.smoother->HasSingleFactors(); })
                    ? 1.0
                    : 0.0;
  if (levels_.front().divided)
  {
    levels_.front().divided->Rows().SumNumbers(&single, 1);
  }
  return single > 0.0;
}

Multigrid Multigrid::InDoublePrecision() const
{
  std::vector<MultigridLevel> levels(levels_.size());
  for (std::size_t l = 0; l < levels_.size(); ++l)
  {
    const MultigridLevel& from = levels_[l];
    levels[l] = { from.A, from.prolongation, from.restriction, from.order, from.groups,
      from.smoothing, from.divided, nullptr };
  }
  MultigridOptions options = options_;
  options.precision = FactorPrecision::Double;
  return Multigrid(std::move(levels), options);
}

std::vector<Multigrid::Scratch>& Multigrid::Workspace::For(std::size_t levels, Id wanted)
{
  if (wanted != columns)
  {
    scratch.clear();
    columns = wanted;
  }
  scratch.resize(levels);
  return scratch;
}

void Multigrid::Cycle(const MultiVector& b, MultiVector& x) const
{
  if (x.rows() != b.rows() || x.cols() != b.cols())
  {
    throw InvalidInput("x and b of a multigrid cycle must have the same shape");
  }
  this->CheckRows(0, b);
  const Pool<Workspace>::Loan workspace(*workspace_);
  std::vector<Scratch>& scratch = (*workspace).For(levels_.size(), b.cols());
  this->Improve(0, b, x, scratch);
}

void Multigrid::Precondition(const MultiVector& b, MultiVector& x) const
{
  this->PreconditionFrom(0, b, x);
}

void Multigrid::PreconditionFrom(std::size_t level, const MultiVector& b, MultiVector& x) const
{
  this->CheckRows(level, b);
  const Pool<Workspace>::Loan workspace(*workspace_);
  std::vector<Scratch>& scratch = (*workspace).For(levels_.size(), b.cols());
  this->Correct(level, b, x, scratch);
}

void Multigrid::NestedIteration(const MultiVector& b, MultiVector& x, MultiVector* lastStep) const
{
  this->CheckRows(0, b);
  std::vector<MultiVector> load(levels_.size());
  const Pool<Workspace>::Loan workspace(*workspace_);
  std::vector<Scratch>& scratch = (*workspace).For(levels_.size(), b.cols());
  for (std::size_t l = 1; l < levels_.size(); ++l)
  {
    this->RestrictResidual(
      l - 1, l == 1 ? b : load[l - 1], nullptr, scratch[l - 1].residual, load[l]);
  }
  coarse_.Solve(levels_.size() == 1 ? b : load.back(), x, options_.threads);
  for (std::size_t l = levels_.size() - 1; l > 0; --l)
  {
    if (l + 1 < levels_.size())
    {
      const MultiVector before = l == 1 && lastStep ? x : MultiVector();
      this->Improve(l, load[l], x, scratch);
      if (l == 1 && lastStep)
      {
        Multiply(levels_[0].prolongation, x - before, *lastStep, options_.threads);
      }
    }
    MultiVector finer;
    Multiply(levels_[l - 1].prolongation, x, finer, options_.threads);
    x.swap(finer);
  }
}

/// coarse = Pᵀ (b - A x), or Pᵀ b without x.
void Multigrid::RestrictResidual(std::size_t l, const MultiVector& b, const MultiVector* x,
  MultiVector& residual, MultiVector& coarse) const
{
  const MultigridLevel& level = levels_[l];
  if (x)
  {
    Residual(level.A, *x, b, residual, options_.threads);
  }
  else if (level.divided)
  {
    residual = b;
  }
  if (level.divided)
  {
    LeaveToOwners(level.divided->Rows(), b, residual);
  }
  Multiply(level.restriction, x || level.divided ? residual : b, coarse, options_.threads);
  if (level.divided)
  {
    level.divided->SumCoarse(coarse);
  }
}

void Multigrid::CheckRows(std::size_t level, const MultiVector& b) const
{
  const Index unknowns = levels_.at(level).A.rows;
  if (b.rows() != unknowns)
  {
    throw InvalidInput("a right-hand side of " + std::to_string(b.rows()) +
                       " rows does not fit a system of " + std::to_string(unknowns) + " unknowns");
  }
}

/// x = B b in units of the columns of b, which are returned: single precision gets numbers near 1.
/// b may be the scaled vector of the level.
Eigen::ArrayXd Multigrid::CycleInUnits(
  std::size_t l, const MultiVector& b, MultiVector& x, std::vector<Scratch>& scratch) const
{
  MultiVector& scaled = scratch[l].scaled;
  const Eigen::ArrayXd unit = UnitsOf(b, RowsOf(levels_[l]), options_.threads);
  Scale(b, unit.inverse(), scaled, options_.threads);
  this->CycleLevel(l, scaled, x, true, scratch);
  return unit;
}

/// x = B b
void Multigrid::Correct(
  std::size_t l, const MultiVector& b, MultiVector& x, std::vector<Scratch>& scratch) const
{
  if (!isSingle_[l])
  {
    this->CycleLevel(l, b, x, true, scratch);
    return;
  }
  const Eigen::ArrayXd unit = this->CycleInUnits(l, b, x, scratch);
  Scale(x, unit, x, options_.threads);
}

/// x += B (b - A x). Single precision sees the correction alone, whose rounding is small beside it.
void Multigrid::Improve(
  std::size_t l, const MultiVector& b, MultiVector& x, std::vector<Scratch>& scratch) const
{
  if (!isSingle_[l])
  {
    this->CycleLevel(l, b, x, false, scratch);
    return;
  }
  MultiVector& residual = scratch[l].scaled;
  MultiVector& correction = scratch[l].correction;
  Residual(levels_[l].A, x, b, residual, options_.threads);
  if (const DividedRows* divided = RowsOf(levels_[l]))
  {
    LeaveToOwners(*divided, b, residual);
    divided->Sum(residual);
  }
  const Eigen::ArrayXd unit = this->CycleInUnits(l, residual, correction, scratch);
  double* const target = x.data();
  const double* const source = correction.data();
  ForEachNumber(
    x, options_.threads, [&](Id k, Id column) { target[k] += unit[column] * source[k]; });
}

void Multigrid::CycleLevel(std::size_t l, const MultiVector& b, MultiVector& x, bool zeroStart,
  std::vector<Scratch>& scratch) const
{
  const MultigridLevel& level = levels_[l];
  if (l + 1 == levels_.size())
  {
    coarse_.Solve(b, x, options_.threads);
    return;
  }
  const LevelSmoothing smoothing = this->SmoothingOf(l);
  if (zeroStart)
  {
    x.resize(b.rows(), b.cols());
    ParallelRanges(b.rows(), ThreadsFor(b.size(), options_.threads),
      [&](Id begin, Id end) { x.middleRows(begin, end - begin).setZero(); });
  }
  for (int sweep = 0; sweep < smoothing.preSweeps; ++sweep)
  {
    level.smoother->Sweep(level.A, b, x, SweepDirection::Forward, options_.threads);
  }
  this->CorrectFromCoarse(l, b, x, zeroStart && smoothing.preSweeps == 0, scratch);
  for (int sweep = 0; sweep < smoothing.postSweeps; ++sweep)
  {
    level.smoother->Sweep(level.A, b, x, SweepDirection::Backward, options_.threads);
  }
}

void Multigrid::CorrectFromCoarse(std::size_t l, const MultiVector& b, MultiVector& x, bool zeroX,
  std::vector<Scratch>& scratch) const
{
  const bool coarseIsSolved = l + 2 == levels_.size(); // directly: once is enough
  const bool isW = this->SmoothingOf(l).cycle == CycleType::W;
  this->VisitCoarse(l, b, x, zeroX, isW && !coarseIsSolved ? 2 : 1, scratch);
}

void Multigrid::VisitCoarse(std::size_t l, const MultiVector& b, MultiVector& x, bool zeroX,
  int times, std::vector<Scratch>& scratch) const
{
  const MultigridLevel& level = levels_[l];
  MultiVector& residual = scratch[l].residual;
  MultiVector& coarseB = scratch[l].coarseB;
  MultiVector& coarseX = scratch[l].coarseX;
  this->RestrictResidual(l, b, zeroX ? nullptr : &x, residual, coarseB);
  for (int time = 0; time < times; ++time)
  {
    this->CycleLevel(l + 1, coarseB, coarseX, time == 0, scratch);
  }
  MultiplyAdd(level.prolongation, coarseX, x, options_.threads);
}

std::size_t Multigrid::Memory() const
{
  std::size_t bytes = coarse_.Memory();
  for (const MultigridLevel& level : levels_)
  {
    bytes += MatrixMemory(level.A) + MatrixMemory(level.prolongation) +
             MatrixMemory(level.restriction) +
             level.order.dof.size() * sizeof(level.order.dof.front()) +
             (level.order.blockBegin.size() + level.order.colourBegin.size()) * sizeof(Id) +
             level.order.slice.size() * sizeof(Index);
    bytes += level.smoother ? level.smoother->Memory() : 0;
  }
  return bytes;
}

} // namespace gridfem
