#include "Multigrid/BlockSweep.h"
#include "Multigrid/PatchInverse.h"
#include "Multigrid/Smoother.h"
#include "Multigrid/StencilBlocks.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace gridfem
{
namespace
{

constexpr int N = StencilBlocks::N;
using Patch = StencilBlocks::Patch;

/// The numbers of an unknown in `Width` columns of a block.
template<int Width>
using Numbers = std::conditional_t<Width == 1, float, Eigen::Array<float, Width, 1>>;

using Run = Eigen::Array<float, 4, 1>;

/// The sum of each of four runs.
EIGEN_ALWAYS_INLINE Run SumOfEach(const Run* run)
{
  using Four = float __attribute__((vector_size(16)));
  const auto four = [&](int k)
  {
    Four value;
    std::memcpy(&value, run[k].data(), sizeof(value));
    return value;
  };
  const auto pairs = [](Four a, Four b)
  { return __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7); };
  const Four low = pairs(four(0), four(1));
  const Four high = pairs(four(2), four(3));
  const Four sum =
    __builtin_shufflevector(low, high, 0, 1, 4, 5) + __builtin_shufflevector(low, high, 2, 3, 6, 7);
  Run result;
  std::memcpy(result.data(), &sum, sizeof(sum));
  return result;
}

/// r -= A x for one column, with vector instructions along the runs of a row. The row of an upper
/// corner along x begins one place earlier, at the zero that ends the run before, so that it meets
/// the same slots.
EIGEN_ALWAYS_INLINE void SubtractProducts(
  const Patch& patch, const StencilRow* rows, const float* x, float (&r)[N])
{
  Run around[16];
#pragma GCC unroll 16
  for (int k = 0; k < 16; ++k)
  {
    const StencilBlocks::Local* const slot = patch.slot.data() + 4 * k;
    around[k] = Run(x[slot[0]], x[slot[1]], x[slot[2]], x[slot[3]]);
  }
  Run sum[N];
#pragma GCC unroll 8
  for (int c = 0; c < N; ++c)
  {
    const float* const row = rows[patch.row[c]].value.data() - (c & 1);
    const Run* const first = around + ((c >> 1) & 1) + 4 * (c >> 2);
    Run part[2];
#pragma GCC unroll 9
    for (int k = 0; k < 9; ++k)
    {
      const Run product = Eigen::Map<const Run>(row + 4 * k) * first[k % 3 + 4 * (k / 3)];
      part[k % 2] = k < 2 ? product : Run(part[k % 2] + product);
    }
    sum[c] = part[0] + part[1];
  }
  for (int half = 0; half < 2; ++half)
  {
    Eigen::Map<Run>(r + 4 * half) -= SumOfEach(sum + 4 * half);
  }
}

/// r -= A x for several columns, with vector instructions along the columns.
template<class Lanes>
EIGEN_ALWAYS_INLINE void SubtractProducts(
  const Patch& patch, const StencilRow* rows, const Lanes* x, Lanes (&r)[N])
{
  const float* row[N];
  for (int c = 0; c < N; ++c)
  {
    row[c] = rows[patch.row[c]].value.data();
  }
#pragma GCC unroll 4
  for (int z = 0; z < 4; ++z)
  {
#pragma GCC unroll 4
    for (int y = 0; y < 4; ++y)
    {
#pragma GCC unroll 4
      for (int i = 0; i < 4; ++i)
      {
        const Lanes value = x[patch.slot[16 * z + 4 * y + i]];
#pragma GCC unroll 8
        for (int c = 0; c < N; ++c)
        {
          const int dx = i - (c & 1);
          const int dy = y - ((c >> 1) & 1);
          const int dz = z - (c >> 2);
          if (dx >= 0 && dx < 3 && dy >= 0 && dy < 3 && dz >= 0 && dz < 3)
          {
            r[c] -= row[c][dx + 4 * dy + 12 * dz] * value;
          }
        }
      }
    }
  }
}

/// x += Vᵀ V (b - A x) on the patch.
template<int Width>
inline void Relax(const Patch& patch, const StencilRow* rows, const StencilBlocks::Extra* extras,
  const Numbers<Width>* b, Numbers<Width>* x)
{
  Numbers<Width> residual[N];
  for (int c = 0; c < N; ++c)
  {
    residual[c] = b[patch.slot[StencilBlocks::OwnSlot(c)]];
  }
  SubtractProducts(patch, rows, x, residual);
  for (Index k = 0; k < patch.extras; ++k)
  {
    residual[extras[k].corner] -= extras[k].value * x[extras[k].column];
  }
  Numbers<Width> r[N];
  for (int i = 0; i < N; ++i)
  {
    r[i] = residual[patch.corner[i]];
  }
  ApplyInverse(patch.factor, r);
  for (int i = 0; i < N; ++i)
  {
    x[patch.unknown[i]] += r[i];
  }
}

/// Loads the columns first .. first + columns - 1 of a block's unknowns, `Width` numbers for each
/// unknown. Numbers beyond `columns` are zero, as are all numbers of unknown 0. Values out of range
/// become the largest number; only scaled unknowns can have such values.
template<int Width>
void Load(const MultiVector& from, const Index* unknowns, Index count, Id first, Id columns,
  bool isInRange, float* to)
{
  constexpr double Largest = std::numeric_limits<float>::max();
  std::fill(to, to + Width * Id(count), 0.0f);
  for (Index i = 1; i < count; ++i)
  {
    const double* const row = from.data() + from.cols() * Id(unknowns[i]) + first;
    for (Id c = 0; c < columns; ++c)
    {
      to[Width * i + c] =
        static_cast<float>(isInRange ? row[c] : std::clamp(row[c], -Largest, Largest));
    }
  }
}

template<int Width>
void Store(
  const float* from, const Index* unknowns, Index count, Id first, Id columns, MultiVector& to)
{
  for (Index i = 1; i < count; ++i)
  {
    double* const row = to.data() + to.cols() * Id(unknowns[i]) + first;
    for (Id c = 0; c < columns; ++c)
    {
      row[c] = from[Width * i + c];
    }
  }
}

class StencilSmoother : public Smoother
{
public:
  StencilSmoother(StencilBlocks blocks, const SparseMatrix& A, const PatchOrder& order, int threads)
    : rows_(A.rows), ranges_{ order.blockBegin, order.colorBegin }, blocks_(std::move(blocks)),
      rest_(this->MakeRest(A, order, threads))
  {
    for (Id block = 0; block + 1 < static_cast<Id>(ranges_.blockBegin.size()); ++block)
    {
      const StencilBlocks::Block& of = blocks_.BlockAt(block);
      roomOfBlock_ = std::max<Id>(roomOfBlock_, of.own + 1 + of.count);
    }
  }

  void Sweep(const SparseMatrix& A, const MultiVector& b, MultiVector& x, SweepDirection direction,
    int threads) const override
  {
    CheckSweep(A, rows_, b, x);
    if (rest_ && direction == SweepDirection::Backward)
    {
      rest_->Sweep(A, b, x, direction, threads);
    }
    this->SweepStencils(b, x, direction, threads);
    if (rest_ && direction == SweepDirection::Forward)
    {
      rest_->Sweep(A, b, x, direction, threads);
    }
  }

  bool HasSingleFactors() const override { return true; }
  bool IsSingle() const override { return true; }

  bool Refill(const SparseMatrix& A, const PatchOrder& order, int threads) override
  {
    const bool fits = blocks_.Refill(A, order, threads);
    if (fits)
    {
      rest_ = this->MakeRest(A, order, threads);
    }
    return fits;
  }

  std::size_t Memory() const override
  {
    return blocks_.Memory() + ranges_.Memory() + (rest_ ? rest_->Memory() : 0);
  }

private:
  /// A smoother in double precision for the patches that single precision does not resolve; null
  /// without such patches.
  std::unique_ptr<Smoother> MakeRest(
    const SparseMatrix& A, const PatchOrder& order, int threads) const
  {
    const std::vector<Id>& patches = blocks_.Unresolved();
    if (patches.empty())
    {
      return nullptr;
    }
    PatchOrder rest;
    rest.dof.size = order.dof.size;
    for (const Id patch : patches)
    {
      rest.dof.Add(order.dof[patch]);
    }
    for (const Id begin : order.blockBegin)
    {
      rest.blockBegin.push_back(
        std::lower_bound(patches.begin(), patches.end(), begin) - patches.begin());
    }
    rest.colorBegin = order.colorBegin;
    return MakePatchSmoother(A, rest, threads);
  }

  void SweepStencils(
    const MultiVector& b, MultiVector& x, SweepDirection direction, int threads) const
  {
    const int wanted = omp_in_parallel() ? 1 : threads;
    const int team = ThreadsFor(64 * x.cols() * blocks_.NumberOfPatches(), wanted);
    // Each thread's room for the numbers of a block. It is allocated here, because no exception may
    // leave a parallel region.
    std::vector<Numbers<4>> room(roomOfBlock_ * NumberOfThreads(team));
    VisitBlocks(ranges_, direction, team,
      [&](Id block)
      {
        Numbers<4>* const own = room.data() + roomOfBlock_ * omp_get_thread_num();
        for (Id first = 0; first < x.cols(); first += 4)
        {
          const Id columns = std::min<Id>(4, x.cols() - first);
          if (columns == 1)
          {
            this->RelaxBlock<1>(
              block, b, x, first, columns, direction, reinterpret_cast<Numbers<1>*>(own));
          }
          else
          {
            this->RelaxBlock<4>(block, b, x, first, columns, direction, own);
          }
        }
      });
  }

  /// Prefetches the patch four steps ahead and the rows of the patch two steps ahead.
  EIGEN_ALWAYS_INLINE void FetchAhead(const StencilRow* rows, Id second, Id fourth) const
  {
    FetchAll(blocks_.PatchAt(fourth));
    for (const auto row : blocks_.PatchAt(second).row)
    {
      FetchAll(rows[row]);
    }
  }

  template<int Width>
  EIGEN_ALWAYS_INLINE void RelaxPatches(
    Id index, const Numbers<Width>* b, Numbers<Width>* x, SweepDirection direction) const
  {
    const StencilRow* const rows = blocks_.Rows(blocks_.BlockAt(index));
    const bool forward = direction == SweepDirection::Forward;
    const Id begin = ranges_.blockBegin[index];
    const Id last = ranges_.blockBegin[index + 1] - 1;
    const auto patchAt = [&](Id step) // the last patch beyond the end
    { return forward ? std::min(begin + step, last) : std::max(last - step, begin); };
    for (Id step = 0; step <= last - begin; ++step)
    {
      this->FetchAhead(rows, patchAt(step + 2), patchAt(step + 4));
      const Patch& patch = blocks_.PatchAt(patchAt(step));
      Relax<Width>(patch, rows, blocks_.Extras(patch), b, x);
    }
  }

  /// Relaxes one block. Its numbers are in single precision from loading until storing.
  template<int Width>
  void RelaxBlock(Id index, const MultiVector& b, MultiVector& x, Id first, Id columns,
    SweepDirection direction, Numbers<Width>* load) const
  {
    const StencilBlocks::Block& block = blocks_.BlockAt(index);
    const Index* const unknowns = blocks_.Unknowns(block);
    for (Index i = 1; i < block.count; ++i)
    {
      Fetch(x.data() + x.cols() * Id(unknowns[i]));
      Fetch(b.data() + x.cols() * Id(unknowns[i]));
    }
    const Index own = block.own + 1;
    Numbers<Width>* const solution = load + own;
    const auto data = [](Numbers<Width>* of) { return reinterpret_cast<float*>(of); };
    const std::vector<StencilBlocks::Scaled>& scaled = blocks_.ScaledOf(index);
    Load<Width>(b, unknowns, own, first, columns, scaled.empty(), data(load));
    Load<Width>(x, unknowns, block.count, first, columns, scaled.empty(), data(solution));
    for (const auto& [i, weight] : scaled)
    {
      for (Id c = 0; c < columns; ++c)
      {
        data(solution)[Width * i + c] = static_cast<float>(x(unknowns[i], first + c) * weight);
        if (i < own)
        {
          data(load)[Width * i + c] = static_cast<float>(b(unknowns[i], first + c) / weight);
        }
      }
    }
    this->RelaxPatches<Width>(index, load, solution, direction);
    Store<Width>(data(solution), unknowns, own, first, columns, x);
    for (const auto& [i, weight] : scaled)
    {
      for (Id c = 0; i < own && c < columns; ++c)
      {
        x(unknowns[i], first + c) /= weight;
      }
    }
  }

  Index rows_;
  BlockRanges ranges_;
  StencilBlocks blocks_;
  Id roomOfBlock_ = 0; // room for the largest block
  std::unique_ptr<Smoother> rest_;
};

} // namespace

std::unique_ptr<Smoother> MakeStencilSmoother(
  const SparseMatrix& A, const PatchOrder& order, int threads, bool* patternFits)
{
  CheckOrder(A, order, threads);
  StencilBlocks blocks(A, order, threads);
  if (patternFits)
  {
    *patternFits = blocks.PatternFits();
  }
  return blocks.IsEmpty() ? nullptr
                          : std::make_unique<StencilSmoother>(std::move(blocks), A, order, threads);
}

} // namespace gridfem
