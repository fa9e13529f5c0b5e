#include "Krylov/Stagnation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridfem
{

void Stagnation::Add(double measure)
{
  const double lowest = lowest_.empty() ? std::numeric_limits<double>::infinity() : lowest_.back();
  lowest_.push_back(measure < lowest ? measure : lowest);
}

bool Stagnation::IsTooSlow() const
{
  const int iterations = static_cast<int>(lowest_.size()) - 1;
  const int patience = std::max(PaceWindow, std::min(Patience, maximumIterations_ / 2));
  if (iterations < patience || iterations >= maximumIterations_)
  {
    return false;
  }
  const double now = std::log(lowest_.back());
  const double pace = (now - std::log(lowest_[iterations - PaceWindow])) / PaceWindow;
  return now + pace * (maximumIterations_ - iterations) > std::log(tolerance_);
}

bool Stagnation::IsAtStandstill() const
{
  const std::size_t count = lowest_.size();
  return count > StandstillWindow && lowest_[count - 1 - StandstillWindow] == lowest_.back();
}

} // namespace gridfem
