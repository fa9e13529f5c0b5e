// Sums over the samples of a patch from which loads follow, for functions of both degrees. Samples
// are added for several triangles at once, one per SIMD lane.
#ifndef GridFEM_LoadSums_h
#define GridFEM_LoadSums_h

#include "Base/SimdLanes.h"
#include "Integrals/QuadraticBasis.h"

#include <algorithm>

namespace gridfem
{

/// A sample on every triangle of a batch. The weight includes the area and the scale.
struct Sample
{
  Lanes position[3];
  Lanes weight;
};

/// `Numbers` sums in every lane for each of `Width` fields. They begin at 0.
template<int Numbers, int Width>
class LaneSums
{
public:
  static constexpr int Count = Width;

  /// Stores the sums over all lanes, number by number.
  void Write(double* share) const
  {
    for (int i = 0; i < Numbers; ++i)
    {
      for (int c = 0; c < Width; ++c)
      {
        share[i * Width + c] = SumOverLanes(sum_[c][i]);
      }
    }
  }

protected:
  LaneSums()
  {
    for (auto& column : sum_)
    {
      column.fill(Lanes::Zero());
    }
  }

  std::array<std::array<Lanes, Numbers>, Width> sum_;
};

/// Sums ∫ f b_i over a patch, for several fields at once. Write stores the sums function by
/// function.
template<int Functions, int Width>
class ValueSums;

/// Sums ∫ <s, ∇b_i> over a patch.
template<int Functions, int Width>
class GradientSums;

/// The gradient of a function with given coefficients on a patch.
template<int Functions>
class PatchSlopes;

/// The four products of the linear functions 1 - t and t along two axes.
struct Bilinear
{
  Lanes product[4]; // first axis fastest

  EIGEN_ALWAYS_INLINE Bilinear(const Lanes& first, const Lanes& second)
  {
    product[3] = first * second;
    product[2] = second - product[3];
    product[1] = first - product[3];
    product[0] = 1.0 - first - product[2];
  }
};

template<int Width>
class ValueSums<FunctionsPerPatch, Width> : public LaneSums<FunctionsPerPatch, Width>
{
public:
  EIGEN_ALWAYS_INLINE void Add(const Sample& sample, const Lanes* value)
  {
    const Bilinear across(sample.position[0], sample.position[1]);
    for (int c = 0; c < Width; ++c)
    {
      const Lanes weighted = sample.weight * value[c];
      const Lanes up = weighted * sample.position[2];
      const Lanes down = weighted - up;
      for (int k = 0; k < 4; ++k)
      {
        sum_[c][k] += down * across.product[k];
        sum_[c][4 + k] += up * across.product[k];
      }
    }
  }

private:
  using LaneSums<FunctionsPerPatch, Width>::sum_;
};

/// Up to the sign, the derivative of a function along an axis is the
/// product of its linear functions along the other two axes. Four sums per axis therefore serve all
/// eight functions.
template<int Width>
class GradientSums<FunctionsPerPatch, Width> : public LaneSums<12, Width>
{
public:
  EIGEN_ALWAYS_INLINE void Add(const Sample& sample, const LaneVector* vector)
  {
    for (int p = 0; p < 3; ++p)
    {
      const Bilinear across(sample.position[(p + 1) % 3], sample.position[(p + 2) % 3]);
      for (int c = 0; c < Width; ++c)
      {
        const Lanes weighted = sample.weight * vector[c].axis[p];
        for (int k = 0; k < 4; ++k)
        {
          sum_[c][4 * p + k] += weighted * across.product[k];
        }
      }
    }
  }

  void Write(double* share) const
  {
    for (int c = 0; c < Width; ++c)
    {
      std::array<double, 12> sum;
      std::transform(sum_[c].begin(), sum_[c].end(), sum.begin(), SumOverLanes);
      for (int i = 0; i < FunctionsPerPatch; ++i)
      {
        double total = 0.0;
        for (int p = 0; p < 3; ++p)
        {
          const int first = (i >> (p + 1) % 3) & 1;
          const int second = (i >> (p + 2) % 3) & 1;
          const double value = sum[4 * p + first + 2 * second];
          total += (i >> p) & 1 ? value : -value;
        }
        share[i * Width + c] = total;
      }
    }
  }

private:
  using LaneSums<12, Width>::sum_;
};

/// Stores the differences of the coefficients along the axes.
template<>
class PatchSlopes<FunctionsPerPatch>
{
public:
  PatchSlopes(
    const std::array<Index, FunctionsPerPatch>& dof, const MultiVector& coefficients, Id column)
  {
    for (int p = 0; p < 3; ++p)
    {
      for (int k = 0; k < 4; ++k)
      {
        const int low = ((k & 1) << (p + 1) % 3) + ((k >> 1) << (p + 2) % 3);
        difference_[p][k] =
          coefficients(dof[low + (1 << p)], column) - coefficients(dof[low], column);
      }
    }
  }

  EIGEN_ALWAYS_INLINE LaneVector At(const Lanes* position) const
  {
    LaneVector gradient;
    for (int p = 0; p < 3; ++p)
    {
      const Bilinear across(position[(p + 1) % 3], position[(p + 2) % 3]);
      gradient.axis[p] = Lanes::Zero();
      for (int k = 0; k < 4; ++k)
      {
        gradient.axis[p] += difference_[p][k] * across.product[k];
      }
    }
    return gradient;
  }

private:
  double difference_[3][4];
};

template<int Width>
class ValueSums<SmoothFunctionsPerPatch, Width> : public LaneSums<SmoothFunctionsPerPatch, Width>
{
public:
  EIGEN_ALWAYS_INLINE void Add(const Sample& sample, const Lanes* value)
  {
    const QuadraticAxis<Lanes> x(sample.position[0]);
    const QuadraticAxis<Lanes> y(sample.position[1]);
    const QuadraticAxis<Lanes> z(sample.position[2]);
    for (int k = 0; k < 9; ++k)
    {
      const Lanes yz = sample.weight * y.value[k % 3] * z.value[k / 3];
      for (int c = 0; c < Width; ++c)
      {
        const Lanes weighted = value[c] * yz;
        for (int i = 0; i < 3; ++i)
        {
          sum_[c][3 * k + i] += weighted * x.value[i];
        }
      }
    }
  }

private:
  using LaneSums<SmoothFunctionsPerPatch, Width>::sum_;
};

template<int Width>
class GradientSums<SmoothFunctionsPerPatch, Width> : public LaneSums<SmoothFunctionsPerPatch, Width>
{
public:
  EIGEN_ALWAYS_INLINE void Add(const Sample& sample, const LaneVector* vector)
  {
    const QuadraticAxis<Lanes> x(sample.position[0]);
    const QuadraticAxis<Lanes> y(sample.position[1]);
    const QuadraticAxis<Lanes> z(sample.position[2]);
    for (int k = 0; k < 9; ++k)
    {
      const Lanes alongX = sample.weight * y.value[k % 3] * z.value[k / 3];
      const Lanes alongY = sample.weight * y.slope[k % 3] * z.value[k / 3];
      const Lanes alongZ = sample.weight * y.value[k % 3] * z.slope[k / 3];
      for (int c = 0; c < Width; ++c)
      {
        const Lanes ofSlope = vector[c].axis[0] * alongX;
        const Lanes ofValue = vector[c].axis[1] * alongY + vector[c].axis[2] * alongZ;
        for (int i = 0; i < 3; ++i)
        {
          sum_[c][3 * k + i] += ofSlope * x.slope[i] + ofValue * x.value[i];
        }
      }
    }
  }

private:
  using LaneSums<SmoothFunctionsPerPatch, Width>::sum_;
};

template<>
class PatchSlopes<SmoothFunctionsPerPatch>
{
public:
  PatchSlopes(const std::array<Index, SmoothFunctionsPerPatch>& dof,
    const MultiVector& coefficients, Id column)
  {
    for (int i = 0; i < SmoothFunctionsPerPatch; ++i)
    {
      coefficient_[i] = coefficients(dof[i], column) - coefficients(dof[0], column);
    }
  }

  EIGEN_ALWAYS_INLINE LaneVector At(const Lanes* position) const
  {
    const QuadraticAxis<Lanes> x(position[0]);
    const QuadraticAxis<Lanes> y(position[1]);
    const QuadraticAxis<Lanes> z(position[2]);
    LaneVector gradient{ { Lanes::Zero(), Lanes::Zero(), Lanes::Zero() } };
    for (int k = 0; k < 9; ++k)
    {
      Lanes value = Lanes::Zero();
      Lanes slope = Lanes::Zero();
      for (int i = 0; i < 3; ++i)
      {
        value += coefficient_[3 * k + i] * x.value[i];
        slope += coefficient_[3 * k + i] * x.slope[i];
      }
      gradient.axis[0] += slope * (y.value[k % 3] * z.value[k / 3]);
      gradient.axis[1] += value * (y.slope[k % 3] * z.value[k / 3]);
      gradient.axis[2] += value * (y.value[k % 3] * z.slope[k / 3]);
    }
    return gradient;
  }

private:
  double coefficient_[SmoothFunctionsPerPatch];
};

} // namespace gridfem

#endif
