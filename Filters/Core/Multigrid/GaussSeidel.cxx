#include "Multigrid/BlockSweep.h"
#include "Multigrid/Smoother.h"

namespace gridfem
{
namespace
{

class GaussSeidel : public Smoother
{
public:
  GaussSeidel(const SparseMatrix& A, const PatchOrder& order);

  void Sweep(const SparseMatrix& A, const MultiVector& b, MultiVector& x, SweepDirection direction,
    int threads) const override;

  std::size_t Memory() const override
  {
    return unknown_.size() * sizeof(Index) + inverseDiagonal_.size() * sizeof(double) +
           ranges_.Memory();
  }

private:
  Id unknowns_;                         // number of unknowns of the matrix
  std::vector<Index> unknown_;          // in visiting order
  std::vector<double> inverseDiagonal_; // of the unknowns in that order; 0: left alone
  BlockRanges ranges_;
};

/// An unknown belongs to the block of its first patch. Blocks of one color are not coupled, so the
/// unknowns of their patches are not coupled either.
GaussSeidel::GaussSeidel(const SparseMatrix& A, const PatchOrder& order) : unknowns_(A.rows)
{
  CheckOrder(A, order);
  std::vector<char> isVisited(A.rows, 0);
  const auto visit = [&](Index unknown)
  {
    if (unknown >= 0 && !isVisited[unknown])
    {
      isVisited[unknown] = 1;
      unknown_.push_back(unknown);
    }
  };
  unknown_.reserve(A.rows);
  ranges_.colorBegin = order.colorBegin;
  ranges_.blockBegin.push_back(0);
  for (std::size_t block = 0; block + 1 < order.blockBegin.size(); ++block)
  {
    for (Id patch = order.blockBegin[block]; patch < order.blockBegin[block + 1]; ++patch)
    {
      const UnknownGroup unknowns = order.dof[patch];
      std::for_each(unknowns.begin(), unknowns.end(), visit);
    }
    ranges_.blockBegin.push_back(static_cast<Id>(unknown_.size()));
  }
  inverseDiagonal_.reserve(unknown_.size());
  for (const Index unknown : unknown_)
  {
    const double diagonal = A.Coefficient(unknown, unknown);
    inverseDiagonal_.push_back(IsUsableDiagonal(diagonal) ? 1.0 / diagonal : 0.0);
  }
}

void GaussSeidel::Sweep(const SparseMatrix& A, const MultiVector& b, MultiVector& x,
  SweepDirection direction, int threads) const
{
  CheckSweep(A, unknowns_, b, x);
  const RowView rows(A);
  SweepBlocks(ranges_, x.cols(), direction, A.NonZeros(), threads,
    [&](Id item, auto chunk)
    {
      const double scale = inverseDiagonal_[item];
      if (scale > 0.0)
      {
        const Index row = unknown_[item];
        chunk.Row(x.data(), row) +=
          scale * (chunk.Row(b.data(), row) - RowProduct(rows, row, x.data(), chunk));
      }
    });
}

} // namespace

std::unique_ptr<Smoother> MakeGaussSeidel(const SparseMatrix& A, const PatchOrder& order)
{
  return std::make_unique<GaussSeidel>(A, order);
}

} // namespace gridfem
