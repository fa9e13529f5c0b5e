#include "Multigrid/DividedLevel.h"

#include "Algebra/RowKernels.h"

namespace gridfem
{
namespace
{

class BorderSmoother : public Smoother
{
public:
  explicit BorderSmoother(std::shared_ptr<const DividedLevel> divided)
    : divided_(std::move(divided))
  {
  }

  void Sweep(const SparseMatrix& A, const MultiVector& b, MultiVector& x, SweepDirection direction,
    int) const override
  {
    const std::vector<Index>& border = divided_->Border();
    const Index foreign = divided_->Rows().Foreign();
    const RowView rows(A);
    divided_->Relax(
      x.cols(), direction,
      [&](MultiVector& part)
      {
        ForEachChunk(x.cols(),
          [&](auto chunk)
          {
            for (std::size_t k = 0; k < border.size(); ++k)
            {
              auto to = chunk.Row(part.data(), static_cast<Index>(k));
              to = -RowProduct(rows, border[k], x.data(), chunk);
              if (border[k] >= foreign)
              {
                to += chunk.Row(b.data(), border[k]);
              }
            }
          });
      },
      [&](const MultiVector& correction)
      {
        for (std::size_t k = 0; k < border.size(); ++k)
        {
          x.row(border[k]) += correction.row(static_cast<Id>(k));
        }
      });
  }

  std::size_t Memory() const override { return 0; } // of the level, not of this

private:
  std::shared_ptr<const DividedLevel> divided_;
};

} // namespace

std::unique_ptr<Smoother> MakeBorderSmoother(std::shared_ptr<const DividedLevel> divided)
{
  return std::make_unique<BorderSmoother>(std::move(divided));
}

} // namespace gridfem
