#include "SingleCycle.h"

#include "Parallel.h"

#include <algorithm>

namespace gridfem
{
namespace
{

constexpr double UnresolvedShare = 1e-3;

/// Lanes without a column are zero.
template<int Width, class Row>
void SetRow(const Row& row, PanelRow<Width>& lanes)
{
  if (row.size() < Width)
  {
    lanes.setZero();
  }
  lanes.head(row.size()) = row.transpose().array().template cast<float>();
}

template<int Width>
void Load(const RowSource& r, Id columns, Panel<Width>& b, int threads)
{
  ParallelRanges(
    static_cast<Id>(b.size()), threads,
    [&](Id begin, Id end)
    {
      MultiVector rows(SourceRows, columns);
      r(begin, end, rows);
      for (Id row = begin; row < end; ++row)
      {
        SetRow(rows.row(row - begin), b[row]);
      }
    },
    SourceRows);
}

/// Stores x and takes the measures of b and x.
template<int Width>
ResidualMeasures Store(const Panel<Width>& b, const Panel<Width>& x, Block z, int threads)
{
  using Sums = Eigen::Array<double, Width, 2>;
  const Sums sums = ParallelSum(z.rows(), threads, Sums(Sums::Zero()),
    [&](Id begin, Id end)
    {
      Sums sum = Sums::Zero();
      for (Id row = begin; row < end; ++row)
      {
        const Eigen::Array<double, Width, 1> r = b[row].template cast<double>();
        const Eigen::Array<double, Width, 1> correction = x[row].template cast<double>();
        sum.col(0) += r * correction;
        sum.col(1) += r * r;
        z.row(row) = correction.head(z.cols()).matrix().transpose();
      }
      return sum;
    });
  return { sums.col(0).head(z.cols()), sums.col(1).head(z.cols()) };
}

template<int Width>
void SetZero(Id rows, Panel<Width>& x, int threads)
{
  x.resize(rows);
  ParallelRanges(rows, threads,
    [&](Id begin, Id end)
    { std::fill(x.begin() + begin, x.begin() + end, PanelRow<Width>::Zero()); });
}

} // namespace

SingleCycle::SingleCycle(std::vector<MultigridLevel> levels, int threads) : threads_(threads)
{
  for (std::size_t l = 0; l + 1 < levels.size(); ++l)
  {
    levels_.emplace_back(levels[l], threads);
    levels[l] = MultigridLevel{};
  }
  coarse_ = CoarseSolver(levels.back().A, threads);
}

bool SingleCycle::IsReliable() const
{
  Id patches = 0;
  Id unresolved = 0;
  for (const SingleLevel& level : levels_)
  {
    patches += level.Patches();
    unresolved += level.UnresolvedPatches();
  }
  return double(unresolved) <= UnresolvedShare * double(patches);
}

ResidualMeasures SingleCycle::Apply(std::size_t level, const RowSource& r, Block z) const
{
  if (z.cols() > WidePanel)
  {
    throw InvalidInput("a cycle in single precision takes a few columns at a time");
  }
  return z.cols() > NarrowPanel ? this->ApplyPanel(level, r, z, wide_)
                                : this->ApplyPanel(level, r, z, narrow_);
}

template<int Width>
ResidualMeasures SingleCycle::ApplyPanel(
  std::size_t level, const RowSource& r, Block z, Pool<Panels<Width>>& pool) const
{
  const typename Pool<Panels<Width>>::Loan loan(pool);
  Panels<Width>& panels = *loan;
  panels.resize(levels_.size() + 1);
  panels[level].b.resize(z.rows());
  Load(r, z.cols(), panels[level].b, threads_);
  this->CycleLevel(level, panels);
  return Store(panels[level].b, panels[level].x, z, threads_);
}

template<int Width>
void SingleCycle::CycleLevel(std::size_t l, Panels<Width>& panels) const
{
  if (l == levels_.size())
  {
    this->SolveCoarsest(panels[l]);
    return;
  }
  const SingleLevel& level = levels_[l];
  auto& [b, x, residual] = panels[l];
  Panel<Width>& coarseB = panels[l + 1].b;
  SetZero(level.Rows(), x, threads_);
  residual.resize(level.Rows());
  coarseB.resize(level.CoarseRows());
  level.Sweep<Width>(b, x, SweepDirection::Forward, threads_);
  level.Residual<Width>(b, x, residual, threads_);
  level.Restrict<Width>(residual, coarseB, threads_);
  this->CycleLevel(l + 1, panels);
  level.AddProlonged<Width>(panels[l + 1].x, x, threads_);
  level.Sweep<Width>(b, x, SweepDirection::Backward, threads_);
}

/// Few unknowns: in double.
template<int Width>
void SingleCycle::SolveCoarsest(LevelPanels<Width>& panels) const
{
  const Id rows = static_cast<Id>(panels.b.size());
  MultiVector b(rows, Width);
  for (Id row = 0; row < rows; ++row)
  {
    b.row(row) = panels.b[row].matrix().transpose().template cast<double>();
  }
  MultiVector x;
  coarse_.Solve(b, x, threads_);
  panels.x.resize(rows);
  for (Id row = 0; row < rows; ++row)
  {
    SetRow(x.row(row), panels.x[row]);
  }
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
