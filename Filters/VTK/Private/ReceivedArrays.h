// The arrays of the pieces that ranks were given, on the triangles that each has received of all.
#ifndef GridFEM_ReceivedArrays_h
#define GridFEM_ReceivedArrays_h

#include "InputMesh.h"

#include "Parallel/Redistribution.h"

class vtkPolyData;

namespace gridfem
{

/// Collective. Adds to the points and triangles of the received mesh the point and cell arrays that
/// the pieces of all ranks with triangles have, alike; double where they are of different types.
/// Ghost flags are left out, and arrays of variants.
/// @param piece     this rank's; may be null
/// @param mesh      its triangles
/// @param received  gets the arrays
void SendArrays(const Communicator& ranks, const Redistribution& distribution, vtkPolyData* piece,
  const InputMesh& mesh, vtkPolyData* received);

} // namespace gridfem

#endif
