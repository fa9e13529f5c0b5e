#include "Problems/SpectrumCycle.h"

namespace gridfem
{
namespace
{

bool AllowsSingle(const MultigridOptions& options)
{
  return options.cycle == CycleType::V && options.smoother == SmootherType::Patch &&
         options.preSweeps == 1 && options.postSweeps == 1;
}

} // namespace

SpectrumCycle::SpectrumCycle(
  const SpaceLevels& space, double shift, const MultigridOptions& options, const Progress& progress)
  : space_(space), shift_(shift), options_(options)
{
  if (AllowsSingle(options))
  {
    single_ = std::make_unique<SingleCycle>(
      BuildMultigridLevels(space, shift, 1.0, options, progress.Part(0.0, 0.5)), options.threads);
  }
  if (!single_ || !single_->IsReliable())
  {
    single_.reset();
    this->BuildDouble(progress.Part(0.5, 1.0));
  }
}

void SpectrumCycle::BuildDouble(const Progress& progress)
{
  double_ = std::make_unique<Multigrid>(BuildMultigrid(space_, shift_, 1.0, options_, progress));
}

template<class Real>
BlockPreconditioner<Real> SpectrumCycle::From(std::size_t level) const
{
  if (!single_)
  {
    return CyclePreconditioner<Real>(*double_, level);
  }
  return [this, level](const RowSource<Real>& r, const CorrectionTest& isWanted,
           const RowSink<Real>& z) { return single_->Apply(level, r, isWanted, z); };
}

template<class Real>
BlockPreconditioner<Real> SpectrumCycle::DoubleFrom(std::size_t level)
{
  if (!double_)
  {
    this->BuildDouble({});
  }
  return CyclePreconditioner<Real>(*double_, level);
}

template BlockPreconditioner<float> SpectrumCycle::From(std::size_t) const;
template BlockPreconditioner<double> SpectrumCycle::From(std::size_t) const;
template BlockPreconditioner<float> SpectrumCycle::DoubleFrom(std::size_t);
template BlockPreconditioner<double> SpectrumCycle::DoubleFrom(std::size_t);

} // namespace gridfem
