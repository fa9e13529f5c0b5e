#include "Multigrid/SingleLevel.h"

#include "Base/Prefetch.h"
#include "Multigrid/PatchFactor.h"

namespace gridfem
{
namespace
{

/// Rows are handed out in ranges of this size.
constexpr Id RangeSize = 1024;

/// A row of the matrix times a panel, in two sums that need not wait for each other.
inline PanelRow RowProduct(const SingleMatrix& A, Index row, const PanelRow* x)
{
  const Index* const column = A.column.data();
  const float* const value = A.value.data();
  const Id end = A.rowBegin[row + 1];
  Id k = A.rowBegin[row];
  PanelRow even = PanelRow::Zero();
  PanelRow odd = PanelRow::Zero();
  for (; k + 2 <= end; k += 2)
  {
    even += value[k] * x[column[k]];
    odd += value[k + 1] * x[column[k + 1]];
  }
  if (k < end)
  {
    even += value[k] * x[column[k]];
  }
  return even + odd;
}

/// r = Vᵀ V r for the packed rows of a lower triangular V.
inline void ApplyInverse(const std::array<float, 36>& V, PanelRow (&r)[FunctionsPerPatch])
{
  constexpr int N = FunctionsPerPatch;
#pragma GCC unroll 8
  for (int i = N - 1; i >= 0; --i)
  {
    r[i] *= V[i * (i + 1) / 2 + i];
#pragma GCC unroll 8
    for (int j = 0; j < i; ++j)
    {
      r[i] += V[i * (i + 1) / 2 + j] * r[j];
    }
  }
#pragma GCC unroll 8
  for (int i = 0; i < N; ++i)
  {
    r[i] *= V[i * (i + 1) / 2 + i];
#pragma GCC unroll 8
    for (int j = i + 1; j < N; ++j)
    {
      r[i] += V[j * (j + 1) / 2 + i] * r[j];
    }
  }
}

/// Asks for the panel rows of a patch while the one before is at work.
EIGEN_ALWAYS_INLINE void FetchAhead(
  const std::array<Index, FunctionsPerPatch>& dof, const PanelRow* b, const PanelRow* x)
{
  for (const Index row : dof)
  {
    FetchAll(b[row]);
    FetchAll(x[row]);
  }
}

/// Calls body(row) for all rows.
template<class Body>
void ForEachRow(Index rows, Id work, int threads, Body&& body)
{
  ParallelRanges(
    rows, ThreadsFor(work, threads),
    [&](Id begin, Id end)
    {
      for (Index row = static_cast<Index>(begin); row < end; ++row)
      {
        body(row);
      }
    },
    RangeSize);
}

} // namespace

SingleMatrix::SingleMatrix(const SparseMatrix& A, int threads)
  : rows(A.rows), rowBegin(A.rowBegin), column(A.column), value(A.value.size())
{
  ParallelRanges(static_cast<Id>(value.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id k = begin; k < end; ++k)
      {
        value[k] = static_cast<float>(A.value[k]);
      }
    });
}

SingleLevel::SingleLevel(const MultigridLevel& level, int threads)
  : divided_(level.divided), foreign_(ForeignRows(this->Divided())), A_(level.A, threads),
    prolongation_(level.prolongation, threads),
    restriction_(
      level.restriction->rows > 0 ? level.restriction : SharedMatrix(Transpose(level.prolongation)),
      threads),
    ranges_{ level.order.blockBegin, level.order.colourBegin }, patches_(level.order.dof.size())
{
  CheckOrder(level.A, level.order, threads);
  const BlockSource source(level.A, threads);
  unresolved_ = ParallelSum(
    this->Patches(), threads, Id{ 0 },
    [&](Id begin, Id end)
    {
      Id unresolved = 0;
      ForEachFactor(source, level.order.dof.data(), begin, end, SmallestPivotOfSingle,
        [&](Id p, const PatchFactor& factor)
        {
          const bool fits = !factor.hasLargeScales;
          patches_[p].dof = factor.dof;
          for (int i = 0; i < N; ++i)
          {
            for (int j = 0; j <= i; ++j)
            {
              patches_[p].factor[i * (i + 1) / 2 + j] = fits ? float(factor.V(i, j)) : 0.0f;
            }
          }
          unresolved += !(fits && factor.isComplete);
        });
      return unresolved;
    },
    PatchesPerBlock);
}

/// x += Vᵀ V (b - A x) on the patch.
void SingleLevel::Relax(const Patch& patch, const PanelRow* b, PanelRow* x) const
{
  PanelRow r[N];
  for (int i = 0; i < N; ++i)
  {
    r[i] = b[patch.dof[i]] - RowProduct(A_, patch.dof[i], x);
  }
  ApplyInverse(patch.factor, r);
  for (int i = 0; i < N; ++i)
  {
    x[patch.dof[i]] += r[i];
  }
}

void SingleLevel::Sweep(const PanelRow* b, PanelRow* x, SweepDirection direction, int threads) const
{
  if (divided_ && direction == SweepDirection::Backward)
  {
    this->RelaxBorder(b, x, direction);
  }
  this->RelaxPatches(b, x, direction, threads);
  if (divided_ && direction == SweepDirection::Forward)
  {
    this->RelaxBorder(b, x, direction);
  }
}

/// Numbers of few rows, in double.
void SingleLevel::RelaxBorder(const PanelRow* b, PanelRow* x, SweepDirection direction) const
{
  const std::vector<Index>& border = divided_->Border();
  divided_->Relax(
    PreconditionedColumns, direction,
    [&](MultiVector& part)
    {
      for (std::size_t k = 0; k < border.size(); ++k)
      {
        part.row(static_cast<Id>(k)) =
          this->ResidualRow(border[k], b, x).matrix().transpose().cast<double>();
      }
    },
    [&](const MultiVector& correction)
    {
      for (std::size_t k = 0; k < border.size(); ++k)
      {
        x[border[k]] += correction.row(static_cast<Id>(k)).transpose().array().cast<float>();
      }
    });
}

void SingleLevel::RelaxPatches(
  const PanelRow* b, PanelRow* x, SweepDirection direction, int threads) const
{
  const bool forward = direction == SweepDirection::Forward;
  VisitBlocks(ranges_, direction,
    ThreadsFor(128 * PreconditionedColumns * this->Patches(), threads),
    [&](Id block)
    {
      const Id begin = ranges_.blockBegin[block];
      const Id end = ranges_.blockBegin[block + 1];
      for (Id i = begin; i < end; ++i)
      {
        const Id next = std::min(i + 1, end - 1);
        FetchAhead(patches_[forward ? next : begin + end - 1 - next].dof, b, x);
        this->Relax(patches_[forward ? i : begin + end - 1 - i], b, x);
      }
    });
}

inline PanelRow SingleLevel::ResidualRow(Index row, const PanelRow* b, const PanelRow* x) const
{
  const PanelRow product = RowProduct(A_, row, x);
  return row < foreign_ ? PanelRow(-product) : PanelRow(b[row] - product);
}

PanelSums SingleLevel::Residual(
  const PanelRow* b, const PanelRow* x, PanelRow* r, int threads) const
{
  PanelSums energy = ParallelSum(
    Id(A_.rows), ThreadsFor(PreconditionedColumns * Id(A_.value.size()), threads),
    PanelSums(PanelSums::Zero()),
    [&](Id begin, Id end)
    {
      return SumOfRows(begin, end,
        [&](Id row) -> PanelRow
        {
          r[row] = this->ResidualRow(static_cast<Index>(row), b, x);
          return row < foreign_ ? PanelRow(x[row] * r[row]) : PanelRow(x[row] * (b[row] + r[row]));
        });
    },
    RangeSize);
  SumOverProcesses(this->Divided(), energy);
  return energy;
}

void SingleLevel::Restrict(const PanelRow* r, PanelRow* coarse, int threads) const
{
  ForEachRow(restriction_.rows, PreconditionedColumns * Id(restriction_.value.size()), threads,
    [&](Index row) { coarse[row] = RowProduct(restriction_, row, r); });
  if (divided_)
  {
    divided_->SumCoarse(AllColumns(coarse, this->CoarseRows()));
  }
}

void SingleLevel::AddProlonged(const PanelRow* coarse, PanelRow* x, int threads) const
{
  ForEachRow(prolongation_.rows, PreconditionedColumns * Id(prolongation_.value.size()), threads,
    [&](Index row) { x[row] += RowProduct(prolongation_, row, coarse); });
}

std::size_t SingleLevel::Memory() const
{
  return A_.Memory() + prolongation_.Memory() + restriction_.Memory() + ranges_.Memory() +
         patches_.size() * sizeof(Patch);
}

} // namespace gridfem
