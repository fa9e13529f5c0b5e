// How a computation runs: the number of threads, and the receiver of its progress.
#ifndef GridFEM_Job_h
#define GridFEM_Job_h

#include "Base/Progress.h"

#include <utility>

namespace gridfem
{

/// A job is passed from the caller down to every loop. A plain number of threads converts to a
/// silent job.
struct Job
{
  Job(int threadsOfJob = 0, Progress progressOfJob = {})
    : threads(threadsOfJob), progress(std::move(progressOfJob))
  {
  }

  /// The part of this job between the fractions `from` and `to`.
  Job Part(double from, double to) const { return { threads, progress.Part(from, to) }; }

  /// Reports the completed fraction. Throws Aborted when the receiver asks for an abort.
  void Check(double fraction) const { progress.Check(fraction); }

  int threads; // 0: all processors
  Progress progress;
};

} // namespace gridfem

#endif
