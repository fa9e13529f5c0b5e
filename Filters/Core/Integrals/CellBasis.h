// The functions of a cell, of either degree. The type of the result selects the degree.
#ifndef GridFEM_CellBasis_h
#define GridFEM_CellBasis_h

#include "Integrals/QuadraticBasis.h"
#include "Integrals/TrilinearBasis.h"

namespace gridfem
{

///@{ Values of all functions at a point in the cell's own coordinates.
inline void BasisValues(const Vec3& local, CornerValues& value)
{
  TrilinearValues(local, value);
}
inline void BasisValues(const Vec3& local, SmoothValues& value)
{
  QuadraticValues(local, value);
}
///@}

///@{ Gradients: derivative[axis][function].
inline void BasisGradients(const Vec3& local, std::array<CornerValues, 3>& derivative)
{
  TrilinearGradients(local, derivative);
}
inline void BasisGradients(const Vec3& local, std::array<SmoothValues, 3>& derivative)
{
  QuadraticGradients(local, derivative);
}
///@}

} // namespace gridfem

#endif
