// Passes progress and abort between Core and a VTK algorithm.
#ifndef GridFEM_ProgressBridge_h
#define GridFEM_ProgressBridge_h

#include "Base/Progress.h"

#include <chrono>
#include <string>

class vtkAlgorithm;

namespace gridfem
{

/// Reports progress every tenth of a second or fiftieth of the work, always more than before, and
/// asks the algorithm whether to abort. The pipeline itself reports the two ends. Core calls it on
/// the thread that called Core, which is the pipeline's.
class ProgressBridge
{
public:
  explicit ProgressBridge(vtkAlgorithm* algorithm) : algorithm_(algorithm) {}

  /// Starts a new run: the next report is passed on at once.
  void Restart();

  /// Shows a cost beside the progress until the next run. Warns if it is hours.
  void Announce(const std::string& cost, bool takesHours);

  /// Returns the progress for Core. It refers to this bridge, which has to live as long.
  Progress GetProgress();

private:
  bool Report(double fraction);

  using Clock = std::chrono::steady_clock;
  vtkAlgorithm* algorithm_;
  Clock::time_point lastReport_ = Clock::time_point::min();
  double furthest_ = 0.0;
};

} // namespace gridfem

#endif
