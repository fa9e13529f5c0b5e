// Carries progress out of a running computation and abort requests into it. Only the calling thread
// uses it.
#ifndef GridFEM_Progress_h
#define GridFEM_Progress_h

#include "Base/Errors.h"

#include <algorithm>
#include <functional>

namespace gridfem
{

/// Reports the progress of the part [from, to] of a longer job. It is cheap to copy; a
/// default-constructed object is silent.
class Progress
{
public:
  /// Receives the completed fraction in [0, 1] and returns false to request an abort.
  using Callback = std::function<bool(double)>;

  Progress() = default;
  explicit Progress(Callback report, double from = 0.0, double to = 1.0)
    : report_(std::move(report)), from_(from), to_(to)
  {
  }

  /// The part of this job between the fractions `from` and `to`.
  Progress Part(double from, double to) const
  {
    return Progress(report_, from_ + from * (to_ - from_), from_ + to * (to_ - from_));
  }

  /// Reports the fraction; returns false when an abort is requested. NaN counts as 0.
  bool Report(double fraction) const
  {
    const double done = fraction > 0.0 ? std::min(fraction, 1.0) : 0.0;
    return !report_ || report_(from_ + done * (to_ - from_));
  }

  /// Reports the fraction; throws Aborted when an abort is requested.
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
