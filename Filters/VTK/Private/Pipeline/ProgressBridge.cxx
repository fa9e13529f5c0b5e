#include "Pipeline/ProgressBridge.h"

#include "vtkAlgorithm.h"
#include "vtkVersionMacros.h"

namespace gridfem
{
namespace
{

/// This much more progress is reported at once, so that a short run shows progress, too.
constexpr double LeastStep = 0.02;

} // namespace

void ProgressBridge::Restart()
{
  lastReport_ = Clock::time_point::min();
  furthest_ = 0.0;
  algorithm_->SetProgressText(nullptr);
}

void ProgressBridge::Announce(const std::string& cost, bool takesHours)
{
  algorithm_->SetProgressText(cost.c_str());
  if (takesHours)
  {
    vtkWarningWithObjectMacro(algorithm_, << cost << ".");
  }
}

Progress ProgressBridge::GetProgress()
{
  return Progress([this](double fraction) { return this->Report(fraction); });
}

bool ProgressBridge::Report(double fraction)
{
  const auto now = Clock::now();
  const bool isFirst = lastReport_ == Clock::time_point::min();
  const bool isDue = isFirst || now - lastReport_ >= std::chrono::milliseconds(100);
  // Skips progress backward, NaN, and both ends, which the pipeline reports.
  const bool isNews = fraction > furthest_ && fraction < 1.0;
  if (isNews && (isDue || fraction >= furthest_ + LeastStep))
  {
    furthest_ = fraction;
    algorithm_->UpdateProgress(furthest_);
  }
  if (isDue)
  {
    lastReport_ = now;
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220823)
    if (algorithm_->CheckAbort())
    {
      return false;
    }
#endif
  }
  return !algorithm_->GetAbortExecute();
}

} // namespace gridfem
