#include "Multigrid/DistributedLevel.h"

#include "Algebra/RowKernels.h"

namespace gridfem
{
namespace
{

template<class Real>
class BorderSmoother : public BasicSmoother<Real>
{
public:
  explicit BorderSmoother(std::shared_ptr<const DistributedLevel> distributed)
    : distributed_(std::move(distributed))
  {
  }

  void Sweep(const BasicSparseMatrix<Real>& A, const Vectors<Real>& b, Vectors<Real>& x,
    SweepDirection direction, int) const override
  {
    const std::vector<Index>& border = distributed_->Border();
    const Index ghosts = distributed_->Rows().Ghosts();
    const RowView rows(A);
    distributed_->Relax(
      x.cols(), direction,
      [&](MultiVector& part)
      {
        ForEachChunk<Real>(x.cols(),
          [&](auto chunk)
          {
            for (std::size_t k = 0; k < border.size(); ++k)
            {
              typename decltype(chunk)::ColumnLanes residual =
                -RowProduct(rows, border[k], x.data(), chunk);
              if (border[k] >= ghosts)
              {
                residual += chunk.Row(b.data(), border[k]);
              }
              part.row(static_cast<Id>(k)).template segment<decltype(chunk)::Width>(chunk.first) =
                residual.matrix().transpose().template cast<double>();
            }
          });
      },
      [&](const MultiVector& correction)
      {
        for (std::size_t k = 0; k < border.size(); ++k)
        {
          x.row(border[k]) += correction.row(static_cast<Id>(k)).template cast<Real>();
        }
      });
  }

  std::size_t Memory() const override { return 0; } // the level counts its memory

private:
  std::shared_ptr<const DistributedLevel> distributed_;
};

} // namespace

template<class Real>
std::unique_ptr<BasicSmoother<Real>> MakeBorderSmoother(
  std::shared_ptr<const DistributedLevel> distributed)
{
  return std::make_unique<BorderSmoother<Real>>(std::move(distributed));
}

template std::unique_ptr<BasicSmoother<float>> MakeBorderSmoother(
  std::shared_ptr<const DistributedLevel>);
template std::unique_ptr<Smoother> MakeBorderSmoother(std::shared_ptr<const DistributedLevel>);

} // namespace gridfem
