// Converts between vectors in space and rows of three numbers.
#ifndef GridFEM_VectorRows_h
#define GridFEM_VectorRows_h

#include "Base/Types.h"

#include <vector>

namespace gridfem
{

///@{ Copies one number at a time, because GCC warns about bounds when a fixed-size vector is
/// assigned to a dynamic row.
inline Vec3 RowOf(const MultiVector& rows, Id row)
{
  return { rows(row, 0), rows(row, 1), rows(row, 2) };
}

inline void SetRow(MultiVector& rows, Id row, const Vec3& vector)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    rows(row, axis) = vector[axis];
  }
}
///@}

inline MultiVector RowsOf(const std::vector<Vec3>& vectors)
{
  MultiVector rows(static_cast<Id>(vectors.size()), 3);
  for (Id row = 0; row < rows.rows(); ++row)
  {
    SetRow(rows, row, vectors[row]);
  }
  return rows;
}

inline std::vector<Vec3> VectorsOf(const MultiVector& rows)
{
  std::vector<Vec3> vectors(static_cast<std::size_t>(rows.rows()));
  for (Id row = 0; row < rows.rows(); ++row)
  {
    vectors[row] = RowOf(rows, row);
  }
  return vectors;
}

} // namespace gridfem

#endif
