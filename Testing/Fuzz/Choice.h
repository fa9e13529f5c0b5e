// Random choices that depend on a seed alone.
#ifndef GridFEM_Testing_Choice_h
#define GridFEM_Testing_Choice_h

#include "Base/Types.h"

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <random>

namespace gridfem::testing
{

/// The same on every machine; the distributions of the standard library are not.
class Choice
{
public:
  explicit Choice(std::uint64_t seed) : generator_(seed) {}

  /// low .. high, both included.
  Id Integer(Id low, Id high)
  {
    return low + static_cast<Id>(generator_() % static_cast<std::uint64_t>(high - low + 1));
  }

  double Real(double low, double high)
  {
    return low + (high - low) * std::ldexp(double(generator_() >> 11), -53);
  }

  /// Evenly many of every order of magnitude.
  double PowerOfTen(double low, double high) { return std::pow(10.0, this->Real(low, high)); }

  bool OneIn(Id count) { return this->Integer(1, count) == 1; }

  template<class T>
  T Of(std::initializer_list<T> values)
  {
    return values.begin()[this->Integer(0, static_cast<Id>(values.size()) - 1)];
  }

  /// Between -1 and 1 on each axis.
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
