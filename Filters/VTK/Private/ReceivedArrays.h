// The arrays of the pieces that ranks were given, on the triangles that each has received of all.
#ifndef GridFEM_ReceivedArrays_h
#define GridFEM_ReceivedArrays_h

#include "InputMesh.h"

#include "Parallel/Redistribution.h"

class vtkCellData;
class vtkPointData;
class vtkPolyData;

namespace gridfem
{

/// Collective. The point and cell arrays that the pieces of all ranks with triangles have, alike,
/// at the points and on the triangles of the received mesh; double where they are of different
/// types. Ghost flags are left out, ids of points, and arrays of variants.
/// @param piece  this rank's; may be null
/// @param mesh   its triangles
void SendArrays(const Communicator& ranks, const Redistribution& distribution, vtkPolyData* piece,
  const InputMesh& mesh, vtkPointData* atPoints, vtkCellData* onTriangles);

} // namespace gridfem

#endif
