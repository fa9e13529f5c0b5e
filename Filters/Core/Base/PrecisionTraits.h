// What differs between computing in double and in single precision.
#ifndef GridFEM_PrecisionTraits_h
#define GridFEM_PrecisionTraits_h

#include "Base/Types.h"

namespace gridfem
{

/// Columns of a block in single precision that are worked on together, at most. Two vector
/// registers of sixteen share every number of a matrix that is read. Fewer columns are not faster,
/// because reading matrices takes most of the time.
constexpr Id WidestPanel = 32;

template<class Real>
struct PrecisionTraits;

template<>
struct PrecisionTraits<double>
{
  static constexpr bool IsSingle = false;

  /// Pivots of the matrix of products of vectors, scaled to unit diagonal, below this mark a
  /// dependent direction: far above the rounding of products, so that noise never poses as a
  /// vector, and below what a solution needs.
  static constexpr double DependentPivot = 1e-12;

  /// Pivots of the scaled block of a patch below this are rounding: the direction is left out.
  static constexpr double SmallestPatchPivot = 1e-14;

  /// How many columns a cycle works on at once for a block of `columns`.
  static constexpr Id PanelWidth(Id columns) { return columns; }
};

template<>
struct PrecisionTraits<float>
{
  static constexpr bool IsSingle = true;
  static constexpr double DependentPivot = 1e-4;

  /// Rounding to single precision would disturb the corrections of directions with smaller pivots
  /// more than they serve the others. Pivots are about the square of a flat face's slope against
  /// the grid. Boxes of which all faces have one slope need as many steps as in double with pivots
  /// of 3e-6, twice as many with 3e-7, and do not converge with 3e-8.
  static constexpr double SmallestPatchPivot = 1e-6;

  static constexpr Id PanelWidth(Id) { return WidestPanel; }
};

} // namespace gridfem

#endif
