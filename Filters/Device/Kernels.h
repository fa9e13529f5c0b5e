// The loops of a cycle on a device.
#ifndef GridFEM_Device_Kernels_h
#define GridFEM_Device_Kernels_h

#include "RowProducts.h"

#include <cmath>

namespace gridfem::device
{

/// y = A x
struct MultiplyRows
{
  RowProducts rows;
  const float* x;
  float* y;

  GRIDFEM_ON_DEVICE void operator()(Index item) const
  {
    float* const to = y;
    rows(item, x, [to](Id place, float sum) { to[place] = sum; });
  }
};

/// r = b - A x
struct SubtractRows
{
  RowProducts rows;
  const float* x;
  const float* b;
  float* r;

  GRIDFEM_ON_DEVICE void operator()(Index item) const
  {
    const float* const from = b;
    float* const to = r;
    rows(item, x, [from, to](Id place, float sum) { to[place] = from[place] - sum; });
  }
};

/// z = first z + second A r, x += z
struct SmoothRows
{
  RowProducts rows;
  const float* r;
  float first;
  float second;
  float* z;
  float* x;
  bool isFromZero; // x is 0

  GRIDFEM_ON_DEVICE void operator()(Index item) const
  {
    const SmoothRows own = *this;
    rows(item, r,
      [own](Id place, float sum)
      {
        float change = own.second * sum;
        if (own.first != 0.0f)
        {
          change += own.first * own.z[place];
        }
        own.z[place] = change;
        own.x[place] = own.isFromZero ? change : own.x[place] + change;
      });
  }
};

/// x_i y_i
struct ProductTerm
{
  const float* x;
  const float* y;

  GRIDFEM_ON_DEVICE double operator()(Index i, Index) const { return double(x[i]) * double(y[i]); }
};

/// Pseudorandom numbers in [-1, 1).
struct FillRandom
{
  float* y;

  GRIDFEM_ON_DEVICE void operator()(Index i) const
  {
    std::uint32_t bits = static_cast<std::uint32_t>(i) * 2654435761u + 12345u;
    bits ^= bits >> 16;
    bits *= 0x45d9f3bu;
    bits ^= bits >> 16;
    y[i] = static_cast<float>(bits >> 8) / 8388608.0f - 1.0f;
  }
};

/// y = x / sqrt(square)
struct Normalize
{
  const float* x;
  const double* square;
  float* y;

  GRIDFEM_ON_DEVICE void operator()(Index i) const
  {
    y[i] = *square > 0.0 ? static_cast<float>(x[i] / sqrt(*square)) : 0.0f;
  }
};

/// The power of two near a number; 1 for 0 and for numbers out of range.
GRIDFEM_ON_DEVICE double PowerNear(double number)
{
  return number > 1e-300 && number < 1e300 ? ldexp(1.0, ilogb(number)) : 1.0;
}

/// The power of two near its square root.
GRIDFEM_ON_DEVICE double PowerNearRoot(double number)
{
  const int exponent = number > 1e-300 && number < 1e300 ? ilogb(number) : 0;
  return ldexp(1.0, (exponent - (exponent & 1)) / 2);
}

/// The diagonal of a matrix, and the unit of each unknown: a power of two near its square root.
struct FindUnits
{
  Places places;
  const double* value;
  double* diagonal;
  double* unit;

  GRIDFEM_ON_DEVICE void operator()(Index row) const
  {
    double own = 0.0;
    const double* const from = value;
    places.ForEachEntry(
      row, [&own, from, row](Id place, Index column) { own = column == row ? from[place] : own; });
    diagonal[row] = own;
    unit[row] = PowerNearRoot(own);
  }
};

/// Entry (i, j) of `to` is the entry of `from`, times or over the units of its row and column.
template<class Number>
struct ScaleEntries
{
  Places places;
  const Number* from;
  const double* rowUnit;
  bool overRow;
  const double* columnUnit;
  bool overColumn;
  float* to;

  GRIDFEM_ON_DEVICE void operator()(Index row) const
  {
    const ScaleEntries own = *this;
    const double ofRow = overRow ? 1.0 / rowUnit[row] : rowUnit[row];
    places.ForEachEntry(row,
      [own, ofRow](Id place, Index column)
      {
        const double unit = own.columnUnit[column];
        own.to[place] = static_cast<float>(
          ofRow * (own.overColumn ? 1.0 / unit : unit) * double(own.from[place]));
      });
  }
};

/// |b_i| in units of the unknowns.
template<class Number>
struct SizeTerm
{
  const Number* b;
  const double* unit;
  Index columns;

  GRIDFEM_ON_DEVICE double operator()(Index row, Index column) const
  {
    return fabs(double(b[Id(row) * columns + column]) / unit[row]);
  }
};

/// to = from / (unit of the unknown * unit of the column); the size of a column gives its unit.
template<class Number>
struct EnterUnits
{
  const Number* from;
  const double* unit;
  const double* size;
  Index columns;
  float* to;

  GRIDFEM_ON_DEVICE void operator()(Index item) const
  {
    const Index row = item / columns;
    const double ofColumn = PowerNear(size[item - row * columns]);
    to[item] = static_cast<float>(double(from[item]) / (unit[row] * ofColumn));
  }
};

/// to = from * unit of the column / unit of the unknown
template<class Number>
struct LeaveUnits
{
  const float* from;
  const double* unit;
  const double* size;
  Index columns;
  Number* to;

  GRIDFEM_ON_DEVICE void operator()(Index item) const
  {
    const Index row = item / columns;
    const double ofColumn = PowerNear(size[item - row * columns]);
    to[item] = static_cast<Number>(double(from[item]) * ofColumn / unit[row]);
  }
};

} // namespace gridfem::device

#endif
