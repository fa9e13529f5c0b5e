// Puts the arrays of the ranks' pieces on the triangles that each rank has received.
#ifndef GridFEM_ReceivedArrays_h
#define GridFEM_ReceivedArrays_h

#include "Input/InputMesh.h"

#include "Parallel/Redistribution.h"

class vtkCellData;
class vtkPointData;
class vtkPolyData;

namespace gridfem
{

/// Returns the point and cell arrays that the pieces of all ranks with triangles have, at the
/// points and on the triangles of the received mesh. Arrays of different types become double.
/// Leaves out ghost flags, ids of points, and arrays of variants. Collective.
/// @param piece  this rank's piece; may be null
/// @param mesh   the triangles of the piece
void SendArrays(const Communicator& ranks, const Redistribution& distribution, vtkPolyData* piece,
  const InputMesh& mesh, vtkPointData* atPoints, vtkCellData* onTriangles);

} // namespace gridfem

#endif
