// Random choices that depend only on a seed.
#ifndef GridFEM_Testing_Choice_h
#define GridFEM_Testing_Choice_h

#include "Base/Types.h"

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <random>

namespace gridfem::testing
{

/// Gives the same choices on every machine, unlike the distributions of the standard library.
class Choice
{
public:
  explicit Choice(std::uint64_t seed) : generator_(seed) {}

  /// Returns a number in low .. high, both included.
  Id Integer(Id low, Id high)
  {
    return low + static_cast<Id>(generator_() % static_cast<std::uint64_t>(high - low + 1));
  }

  double Real(double low, double high)
  {
    return low + (high - low) * std::ldexp(double(generator_() >> 11), -53);
  }

  /// Returns a power of ten with an exponent in [low, high]. All orders of magnitude are equally
  /// likely.
  double PowerOfTen(double low, double high) { return std::pow(10.0, this->Real(low, high)); }

  bool OneIn(Id count) { return this->Integer(1, count) == 1; }

  template<class T>
  T Of(std::initializer_list<T> values)
  {
    return values.begin()[this->Integer(0, static_cast<Id>(values.size()) - 1)];
  }

  /// Returns a vector with coordinates in [-1, 1].
  Vec3 Vector()
  {
    const double x = this->Real(-1.0, 1.0);
    const double y = this->Real(-1.0, 1.0);
    return { x, y, this->Real(-1.0, 1.0) };
  }

private:
  std::mt19937_64 generator_;
};

} // namespace gridfem::testing

#endif
