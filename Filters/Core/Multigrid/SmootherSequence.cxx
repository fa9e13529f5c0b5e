#include "Multigrid/SmootherSequence.h"

#include <algorithm>

namespace gridfem
{
namespace
{

template<class Real>
class SmootherSequence : public BasicSmoother<Real>
{
public:
  using Smoothers = std::vector<std::unique_ptr<BasicSmoother<Real>>>;

  explicit SmootherSequence(Smoothers smoothers) : smoothers_(std::move(smoothers)) {}

  void Sweep(const BasicSparseMatrix<Real>& A, const Vectors<Real>& b, Vectors<Real>& x,
    SweepDirection direction, int threads) const override
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

  Id UnresolvedPatches() const override
  {
    Id patches = 0;
    for (const auto& smoother : smoothers_)
    {
      patches += smoother->UnresolvedPatches();
    }
    return patches;
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
  Smoothers smoothers_;
};

} // namespace

template<class Real>
std::unique_ptr<BasicSmoother<Real>> MakeSmootherSequence(
  std::vector<std::unique_ptr<BasicSmoother<Real>>> smoothers)
{
  return std::make_unique<SmootherSequence<Real>>(std::move(smoothers));
}

template std::unique_ptr<BasicSmoother<float>> MakeSmootherSequence(
  std::vector<std::unique_ptr<BasicSmoother<float>>>);
template std::unique_ptr<Smoother> MakeSmootherSequence(std::vector<std::unique_ptr<Smoother>>);

} // namespace gridfem
