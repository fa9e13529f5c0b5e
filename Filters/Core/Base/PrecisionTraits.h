// Constants that differ between double and single precision.
#ifndef GridFEM_PrecisionTraits_h
#define GridFEM_PrecisionTraits_h

#include "Base/Types.h"

namespace gridfem
{

/// Largest number of columns of a block processed together in single precision. Two of sixteen
/// vector registers share each number read from a matrix. Fewer columns are not faster, because
/// reading matrices takes most of the time.
constexpr Id WidestPanel = 32;

template<class Real>
struct PrecisionTraits;

template<>
struct PrecisionTraits<double>
{
  static constexpr bool IsSingle = false;

  /// Pivots below this value mark a linearly dependent direction. They are pivots of the Gram
  /// matrix of the vectors, scaled to unit diagonal. The value is far above the rounding errors of
  /// the products, so noise never passes for a vector. It is also below every pivot that a solution
  /// needs.
  static constexpr double DependentPivot = 1e-12;

  /// Pivots of a patch's scaled block below this value are rounding errors. Their directions are
  /// left out.
  static constexpr double SmallestPatchPivot = 1e-14;

  /// Number of columns that a cycle processes together, for a block of `columns` columns.
  static constexpr Id PanelWidth(Id columns) { return columns; }
};

template<>
struct PrecisionTraits<float>
{
  static constexpr bool IsSingle = true;
  static constexpr double DependentPivot = 1e-4;

  /// Rounding to single precision disturbs corrections along directions with smaller pivots more
  /// than the corrections help. A pivot is about the square of a flat face's slope against the
  /// grid. Boxes whose faces all have one slope need as many steps as in double precision if the
  /// pivots are 3e-6. They need twice as many for 3e-7 and do not converge for 3e-8.
  static constexpr double SmallestPatchPivot = 1e-6;

  static constexpr Id PanelWidth(Id) { return WidestPanel; }
};

} // namespace gridfem

#endif
