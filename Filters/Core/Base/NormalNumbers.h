// Random numbers of the standard normal distribution, by their place in a series. A number does not
// depend on the order of the draws, so any number of threads gives the same numbers.
#ifndef GridFEM_NormalNumbers_h
#define GridFEM_NormalNumbers_h

#include "Base/Types.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace gridfem
{

/// A series of independent normal numbers. Uniform numbers come from SplitMix64 [Steele, Lea and
/// Flood 2014], which can begin at any place of its sequence. Pairs become normal by [Box and
/// Muller 1958].
class NormalNumbers
{
public:
  /// @param seed    numbers of different seeds are independent
  /// @param series  and so are different series of one seed
  NormalNumbers(std::uint64_t seed, std::uint64_t series) : start_(Mixed(Mixed(seed) + series)) {}

  /// Returns the numbers 2 `pair` and 2 `pair` + 1 of the series.
  std::array<double, 2> Pair(std::uint64_t pair) const
  {
    const double radius = std::sqrt(-2.0 * std::log(this->Uniform(2 * pair)));
    const double angle = 2.0 * double(EIGEN_PI) * this->Uniform(2 * pair + 1);
    return { radius * std::cos(angle), radius * std::sin(angle) };
  }

  /// Returns a number that looks random, another one for each x.
  static std::uint64_t Mixed(std::uint64_t x)
  {
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31U);
  }

private:
  /// In (0, 1].
  double Uniform(std::uint64_t place) const
  {
    const std::uint64_t bits = Mixed(start_ + place * 0x9e3779b97f4a7c15U) >> 11U;
    return static_cast<double>(bits + 1) * 0x1p-53;
  }

  std::uint64_t start_;
};

} // namespace gridfem

#endif
