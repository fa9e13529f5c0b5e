// Progress out of, and abort into, a running computation. Called from the calling thread only.
#ifndef GridFEM_Progress_h
#define GridFEM_Progress_h

#include "Base/Errors.h"

#include <algorithm>
#include <functional>

namespace gridfem
{

/// A part [from, to] of a longer job. Cheap to copy; a default one is silent.
class Progress
{
public:
  /// Gets the fraction done in [0, 1]; returns false to ask for an abort.
  using Callback = std::function<bool(double)>;

  Progress() = default;
  explicit Progress(Callback report, double from = 0.0, double to = 1.0)
    : report_(std::move(report)), from_(from), to_(to)
  {
  }

  /// The part of this job between two fractions of it.
  Progress Part(double from, double to) const
  {
    return Progress(report_, from_ + from * (to_ - from_), from_ + to * (to_ - from_));
  }

  /// Reports; false when an abort is asked for. What is no number counts as nothing done.
  bool Report(double fraction) const
  {
    const double done = fraction > 0.0 ? std::min(fraction, 1.0) : 0.0;
    return !report_ || report_(from_ + done * (to_ - from_));
  }

  /// Reports; throws Aborted when an abort is asked for.
  void Check(double fraction) const
  {
    if (!this->Report(fraction))
    {
      throw Aborted();
    }
  }

private:
  Callback report_;
  double from_ = 0.0;
  double to_ = 1.0;
};

} // namespace gridfem

#endif
