#include "Multigrid/SingleCycle.h"

#include "Base/Parallel.h"

#include <algorithm>
#include <array>
#include <type_traits>

namespace gridfem
{
namespace
{

/// What is left out is seen neither by the cycle nor by the measure of the residual. On a part with
/// flat faces, a quarter of its patches, that moved eigenvalues by 7e-7 at a tolerance of 1e-6; on
/// a brain of 0.4 % of the patches by 2e-10.
constexpr double UnresolvedShare = 1e-2;

/// Some columns of a few rows of a panel.
template<class Row>
auto PanelBlock(Row* rows, Id count, Id columns)
{
  using Scalars = std::conditional_t<std::is_const_v<Row>, const Vectors<float>, Vectors<float>>;
  constexpr Id stride = PreconditionedColumns;
  return Eigen::Map<Scalars, 0, Eigen::OuterStride<stride>>(rows->data(), count, columns);
}

/// Returns rᵀr.
template<class Real>
PanelSums Load(const RowSource<Real>& r, Panel& b, int threads)
{
  b.resize(r.rows);
  return ParallelSum(
    r.rows, threads, PanelSums(PanelSums::Zero()),
    [&](Id begin, Id end)
    {
      const Id count = end - begin;
      auto part = PanelBlock(&b[begin], count, r.columns);
      PanelBlock(&b[begin], count, PreconditionedColumns)
        .rightCols(PreconditionedColumns - r.columns)
        .setZero();
      if constexpr (std::is_same_v<Real, float>)
      {
        r.fill(begin, end, part);
      }
      else
      {
        Vectors<Real> rows(count, r.columns);
        r.fill(begin, end, rows);
        part = rows.template cast<float>();
      }
      return SumOfRows(begin, end, [&](Id row) -> PanelRow { return b[row] * b[row]; });
    },
    SourceRows);
}

/// Makes a vector of what the processes add to it; returns rᵀr.
PanelSums SumParts(const DividedRows& divided, Panel& r, int threads)
{
  const Id rows = static_cast<Id>(r.size());
  const Id foreign = divided.Foreign();
  divided.Sum(AllColumns(r.data(), rows));
  PanelSums norm = ParallelSum(rows - foreign, threads, PanelSums(PanelSums::Zero()),
    [&](Id begin, Id end)
    {
      return SumOfRows(
        foreign + begin, foreign + end, [&](Id row) -> PanelRow { return r[row] * r[row]; });
    });
  divided.SumNumbers(norm.data(), norm.size());
  return norm;
}

template<class Real>
void HandOver(const PanelRow* x, Id rows, Id columns, const RowSink<Real>& z, int threads)
{
  ParallelRanges(
    rows, threads,
    [&](Id begin, Id end)
    {
      const auto part = PanelBlock(x + begin, end - begin, columns);
      if constexpr (std::is_same_v<Real, float>)
      {
        z(begin, end, part);
      }
      else
      {
        const Vectors<Real> wide = part.template cast<Real>();
        z(begin, end, wide);
      }
    },
    SourceRows);
}

void SetZero(Id rows, PanelRow* x, int threads)
{
  ParallelRanges(
    rows, threads, [&](Id begin, Id end) { std::fill(x + begin, x + end, PanelRow::Zero()); });
}

} // namespace

SingleCycle::SingleCycle(std::vector<MultigridLevel> levels, int threads) : threads_(threads)
{
  for (const MultigridLevel& level : levels)
  {
    rows_.push_back(static_cast<std::size_t>(level.A.rows));
  }
  for (std::size_t l = 0; l + 1 < levels.size(); ++l)
  {
    levels_.emplace_back(levels[l], threads);
    levels[l] = MultigridLevel{};
  }
  coarse_ = CoarseSolver(levels.back().A, threads);
}

bool SingleCycle::IsReliable() const
{
  double patches = 0.0;
  double unresolved = 0.0;
  for (const SingleLevel& level : levels_)
  {
    std::array<double, 2> ofLevel{ double(level.Patches()), double(level.UnresolvedPatches()) };
    SumOverProcesses(level.Divided(), ofLevel);
    patches += ofLevel[0];
    unresolved += ofLevel[1];
  }
  return unresolved <= UnresolvedShare * patches;
}

template<class Real>
ResidualMeasures SingleCycle::Apply(std::size_t level, const RowSource<Real>& r,
  const CorrectionTest& isWanted, const RowSink<Real>& z) const
{
  if (r.columns > PreconditionedColumns)
  {
    throw InvalidInput("a cycle in single precision takes a few columns at a time");
  }
  const Pool<Panels>::Loan loan(panels_);
  auto& [b, work] = *loan;
  b.resize(levels_.size() + 1);
  work.resize(this->WorkRows(level));
  PanelSums norm = Load(r, b[level], threads_);
  if (level < levels_.size() && levels_[level].Divided())
  {
    norm = SumParts(*levels_[level].Divided(), b[level], threads_);
  }
  const PanelSums energy = this->GoDown(level, b, work.data());
  ResidualMeasures measures{ energy.head(r.columns), norm.head(r.columns) };
  if (isWanted(measures))
  {
    this->GoUp(level, b, work.data());
    HandOver(work.data(), r.rows, r.columns, z, threads_);
  }
  return measures;
}

template ResidualMeasures SingleCycle::Apply(
  std::size_t, const RowSource<float>&, const CorrectionTest&, const RowSink<float>&) const;
template ResidualMeasures SingleCycle::Apply(
  std::size_t, const RowSource<double>&, const CorrectionTest&, const RowSink<double>&) const;

/// x, and the residual or what the coarser levels need in its place.
std::size_t SingleCycle::WorkRows(std::size_t level) const
{
  const std::size_t rows = rows_[level];
  return level == levels_.size() ? rows : rows + std::max(rows, this->WorkRows(level + 1));
}

/// First sweeps and the coarsest solution: x of every level behind that of the finer one. Returns
/// bᵀBb. With S for a sweep, S̄ for one there and one back, and B' for the next coarser level,
/// B = S̄ + (1 - SᵀA) P B' Pᵀ (1 - A S), so that bᵀBb = xᵀ(b + r) + (Pᵀr)ᵀ B' (Pᵀr) for x = S b and
/// r = b - A x.
PanelSums SingleCycle::GoDown(std::size_t l, std::vector<Panel>& panels, PanelRow* work) const
{
  if (l == levels_.size())
  {
    return this->SolveCoarsest(panels[l], work);
  }
  const SingleLevel& level = levels_[l];
  const PanelRow* const b = panels[l].data();
  PanelRow* const x = work;
  PanelRow* const residual = work + level.Rows();
  SetZero(level.Rows(), x, threads_);
  panels[l + 1].resize(level.CoarseRows());
  level.Sweep(b, x, SweepDirection::Forward, threads_);
  const PanelSums energy = level.Residual(b, x, residual, threads_);
  level.Restrict(residual, panels[l + 1].data(), threads_); // after which it is not needed any more
  return energy + this->GoDown(l + 1, panels, residual);
}

/// Corrections and last sweeps. x of this level is at the front of `work`.
void SingleCycle::GoUp(std::size_t l, const std::vector<Panel>& panels, PanelRow* work) const
{
  if (l == levels_.size())
  {
    return;
  }
  const SingleLevel& level = levels_[l];
  PanelRow* const correction = work + level.Rows();
  this->GoUp(l + 1, panels, correction);
  level.AddProlonged(correction, work, threads_);
  level.Sweep(panels[l].data(), work, SweepDirection::Backward, threads_);
}

/// Few unknowns: in double. Returns bᵀx.
PanelSums SingleCycle::SolveCoarsest(const Panel& panel, PanelRow* x) const
{
  const Id rows = static_cast<Id>(panel.size());
  MultiVector b(rows, PreconditionedColumns);
  for (Id row = 0; row < rows; ++row)
  {
    b.row(row) = panel[row].matrix().transpose().cast<double>();
  }
  MultiVector solution;
  coarse_.Solve(b, solution, threads_);
  for (Id row = 0; row < rows; ++row)
  {
    x[row] = solution.row(row).transpose().array().cast<float>();
  }
  return b.cwiseProduct(solution).colwise().sum().transpose();
}

std::size_t SingleCycle::Memory() const
{
  std::size_t bytes = coarse_.Memory();
  for (const SingleLevel& level : levels_)
  {
    bytes += level.Memory();
  }
  return bytes;
}

} // namespace gridfem
