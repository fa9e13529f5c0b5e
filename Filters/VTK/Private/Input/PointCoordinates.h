// Gives loops on several threads the coordinates of vtkPoints as they lie in memory.
#ifndef GridFEM_PointCoordinates_h
#define GridFEM_PointCoordinates_h

#include "Base/Types.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkPoints.h"

namespace gridfem
{

/// Calls body with the coordinates, three for a point, as float* or double*. Returns false, without
/// a call, if they are stored otherwise.
template<class Body>
bool VisitCoordinates(vtkPoints* points, Body&& body)
{
  if (auto* single = vtkArrayDownCast<vtkFloatArray>(points->GetData()))
  {
    body(single->GetPointer(0));
    return true;
  }
  if (auto* twice = vtkArrayDownCast<vtkDoubleArray>(points->GetData()))
  {
    body(twice->GetPointer(0));
    return true;
  }
  return false;
}

template<class Real>
void StorePoint(const Vec3& position, Real* coordinates)
{
  coordinates[0] = static_cast<Real>(position[0]);
  coordinates[1] = static_cast<Real>(position[1]);
  coordinates[2] = static_cast<Real>(position[2]);
}

} // namespace gridfem

#endif
