// Distinguishes a changed mesh from a mesh that has only been read again.
#ifndef GridFEM_MeshVersion_h
#define GridFEM_MeshVersion_h

#include "Input/InputMesh.h"
#include "Solvers/Stages.h"

namespace gridfem
{

/// Numbers the meshes that a filter gets. A reader that several filters ask for different times
/// reads its file again and again. Its arrays are new each time, but their contents are not.
class MeshVersion
{
public:
  /// Returns the number of the mesh. It is the last number if both meshes have the same points and
  /// triangles. The cost is nothing for the arrays of the last call, and O(points + triangles) for
  /// new arrays.
  /// @param last  the triangles read from the mesh of the last call; empty: the mesh counts as new
  std::int64_t Of(vtkPolyData* data, const InputMesh& last, int threads);

private:
  StageKey arrays_;
  std::int64_t version_ = 0;
};

} // namespace gridfem

#endif
