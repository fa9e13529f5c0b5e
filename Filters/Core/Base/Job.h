// How a computation is run: on how many threads, and who hears of its progress.
#ifndef GridFEM_Job_h
#define GridFEM_Job_h

#include "Base/Progress.h"

#include <utility>

namespace gridfem
{

/// Handed down from the caller to every loop. A number of threads is a silent job.
struct Job
{
  Job(int threadsOfJob = 0, Progress progressOfJob = {})
    : threads(threadsOfJob), progress(std::move(progressOfJob))
  {
  }

  /// The part of this job between two fractions of it.
  Job Part(double from, double to) const { return { threads, progress.Part(from, to) }; }

  /// Reports the fraction that is done; throws Aborted when an abort is asked for.
  void Check(double fraction) const { progress.Check(fraction); }

  int threads; // 0: all
  Progress progress;
};

} // namespace gridfem

#endif
