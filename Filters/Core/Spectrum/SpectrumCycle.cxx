#include "Spectrum/SpectrumCycle.h"

namespace gridfem
{

SpectrumCycle::SpectrumCycle(
  const SpaceLevels& space, double shift, const MultigridOptions& options, const Progress& progress)
  : space_(space), shift_(shift), options_(options)
{
  std::vector<MultigridLevel> levels =
    BuildMultigridLevels(space, shift, 1.0, options, progress.Part(0.0, 0.5));
  if (!FitSinglePrecision(levels, options))
  {
    double_ = std::make_unique<Multigrid>(std::move(levels), this->InDouble());
    return;
  }
  single_ = std::make_unique<BasicMultigrid<float>>(std::move(levels), options);
  if (!single_->IsReliable())
  {
    single_.reset();
    this->BuildDouble(progress.Part(0.5, 1.0));
  }
}

/// A device cycles in single precision.
MultigridOptions SpectrumCycle::InDouble() const
{
  MultigridOptions options = options_;
  options.device = DeviceChoice::Cpu;
  return options;
}

void SpectrumCycle::BuildDouble(const Progress& progress)
{
  double_ =
    std::make_unique<Multigrid>(BuildMultigrid(space_, shift_, 1.0, this->InDouble(), progress));
}

std::string SpectrumCycle::Where() const
{
  if (double_ && options_.device != DeviceChoice::Cpu)
  {
    return "CPU: the modes need double precision";
  }
  return double_ ? double_->Where() : single_->Where();
}

template<class Real>
WithFallback<BlockPreconditioner<Real>> SpectrumCycle::From(std::size_t level)
{
  if (!single_)
  {
    return { CyclePreconditioner<Real>(*double_, level), {} };
  }
  const auto makeDouble = [this, level]
  {
    if (!double_)
    {
      this->BuildDouble({});
    }
    return CyclePreconditioner<Real>(*double_, level);
  };
  return { CyclePreconditioner<Real>(*single_, level), makeDouble };
}

template WithFallback<BlockPreconditioner<float>> SpectrumCycle::From(std::size_t);
template WithFallback<BlockPreconditioner<double>> SpectrumCycle::From(std::size_t);

} // namespace gridfem
