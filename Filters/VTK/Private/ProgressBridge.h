// Progress and abort between Core and a VTK algorithm.
#ifndef GridFEM_ProgressBridge_h
#define GridFEM_ProgressBridge_h

#include "Base/Progress.h"

#include <chrono>
#include <string>

class vtkAlgorithm;

namespace gridfem
{

/// Passes progress on every tenth of a second or fiftieth of the work, always more than before, and
/// asks the algorithm whether to abort. The two ends are the pipeline's to report. Core calls it
/// from the thread that called Core, which is the pipeline's.
class ProgressBridge
{
public:
  explicit ProgressBridge(vtkAlgorithm* algorithm) : algorithm_(algorithm) {}

  /// A new run starts: the next report is passed on at once.
  void Restart();

  /// Shows a cost beside the progress until the next run, and warns of hours.
  void Announce(const std::string& cost, bool takesHours);

  /// Refers to this bridge, which has to live as long.
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
