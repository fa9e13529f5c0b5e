// Units of the columns of a block, so that single precision gets numbers near 1.
#ifndef GridFEM_ColumnUnits_h
#define GridFEM_ColumnUnits_h

#include "Algebra/ColumnAlgebra.h"
#include "Algebra/DistributedRows.h"

#include <cmath>

namespace gridfem
{

/// Largest absolute value of each column. `+=` takes the larger of the two.
struct LargestNumbers
{
  Eigen::ArrayXd value;

  void operator+=(const LargestNumbers& other) { value = value.max(other.value); }
};

/// The unit of each column is a power of two near its largest number, or near the sum of the
/// largest numbers of all processes. A column of zeros or without a bound gets 1.
template<class Real>
Columns UnitsOf(const Vectors<Real>& b, const DistributedRows* distributed, int threads)
{
  Columns unit = ParallelSum(b.rows(), ThreadsFor(b.size(), threads),
    LargestNumbers{ Eigen::ArrayXd::Zero(b.cols()) },
    [&](Id begin, Id end) -> LargestNumbers
    {
      const auto rows = b.middleRows(begin, end - begin);
      return { rows.cwiseAbs().colwise().maxCoeff().transpose().array().template cast<double>() };
    }).value;
  SumOverProcesses(distributed, unit);
  for (double& value : unit)
  {
    value = std::isnormal(value) ? std::exp2(std::ilogb(value)) : 1.0;
  }
  return unit;
}

/// Calls body(k, column) for every number of b, in parallel, row after row.
template<class Real, class Body>
void ForEachNumber(const Vectors<Real>& b, int threads, Body&& body)
{
  const Id columns = b.cols();
  ParallelRanges(b.rows(), ThreadsFor(b.size(), threads),
    [&](Id begin, Id end)
    {
      for (Id k = begin * columns, column = 0; k < end * columns; ++k)
      {
        body(k, column);
        column = column + 1 < columns ? column + 1 : 0;
      }
    });
}

/// to = from, with every column multiplied by its factor.
template<class Real>
void Scale(const Vectors<Real>& from, const Columns& factor, Vectors<Real>& to, int threads)
{
  MakeRoom(from.rows(), from.cols(), to);
  const Real* const source = from.data();
  Real* const target = to.data();
  ForEachNumber(from, threads,
    [&](Id k, Id column) { target[k] = static_cast<Real>(factor[column] * source[k]); });
}

/// scaled = b in units of its columns. Returns the units. b and scaled may be the same block.
template<class Real>
Columns InUnits(
  const Vectors<Real>& b, const DistributedRows* distributed, Vectors<Real>& scaled, int threads)
{
  Columns unit = UnitsOf(b, distributed, threads);
  Scale(b, unit.inverse(), scaled, threads);
  return unit;
}

/// y_c += factor_c x_c for every column c, for few columns.
template<class Real>
void AddInUnits(const Vectors<Real>& x, const Columns& unit, Vectors<Real>& y, int threads)
{
  Real* const target = y.data();
  const Real* const source = x.data();
  ForEachNumber(y, threads, [&](Id k, Id column) { target[k] += unit[column] * source[k]; });
}

} // namespace gridfem

#endif
