#include "ProgressBridge.h"

#include "vtkAlgorithm.h"
#include "vtkVersionMacros.h"

#include <algorithm>

namespace gridfem
{

void ProgressBridge::Restart()
{
  lastReport_ = Clock::time_point::min();
  furthest_ = 0.0;
}

Progress ProgressBridge::GetProgress()
{
  return Progress([this](double fraction) { return this->Report(fraction); });
}

bool ProgressBridge::Report(double fraction)
{
  const auto now = Clock::now();
  const bool isFirst = lastReport_ == Clock::time_point::min();
  if (isFirst || now - lastReport_ >= std::chrono::milliseconds(100))
  {
    lastReport_ = now;
    furthest_ = std::max(furthest_, std::min(fraction, 1.0));
    algorithm_->UpdateProgress(furthest_);
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
