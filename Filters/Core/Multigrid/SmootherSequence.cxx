#include "Multigrid/SmootherSequence.h"

#include <algorithm>

namespace gridfem
{
namespace
{

class SmootherSequence : public Smoother
{
public:
  explicit SmootherSequence(std::vector<std::unique_ptr<Smoother>> smoothers)
    : smoothers_(std::move(smoothers))
  {
  }

  void Sweep(const SparseMatrix& A, const MultiVector& b, MultiVector& x, SweepDirection direction,
    int threads) const override
  {
    const bool forward = direction == SweepDirection::Forward;
    for (std::size_t k = 0; k < smoothers_.size(); ++k)
    {
      smoothers_[forward ? k : smoothers_.size() - 1 - k]->Sweep(A, b, x, direction, threads);
    }
  }

  bool HasSingleFactors() const override
  {
    return std::any_of(smoothers_.begin(), smoothers_.end(),
      [](const auto& smoother) { return smoother->HasSingleFactors(); });
  }

  bool IsSingle() const override
  {
    return std::any_of(smoothers_.begin(), smoothers_.end(),
      [](const auto& smoother) { return smoother->IsSingle(); });
  }

  std::size_t Memory() const override
  {
    std::size_t bytes = 0;
    for (const auto& smoother : smoothers_)
    {
      bytes += smoother->Memory();
    }
    return bytes;
  }

private:
  std::vector<std::unique_ptr<Smoother>> smoothers_;
};

} // namespace

std::unique_ptr<Smoother> MakeSmootherSequence(std::vector<std::unique_ptr<Smoother>> smoothers)
{
  return std::make_unique<SmootherSequence>(std::move(smoothers));
}

} // namespace gridfem
