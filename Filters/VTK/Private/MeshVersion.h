// Tells a mesh that has changed from one that has only been read again.
#ifndef GridFEM_MeshVersion_h
#define GridFEM_MeshVersion_h

#include "InputMesh.h"
#include "Solvers/Stages.h"

namespace gridfem
{

/// Numbers the meshes that a filter gets. A reader that several filters ask for different times
/// reads its file again and again; its arrays are new each time, what is in them is not.
class MeshVersion
{
public:
  /// The number of the mesh; that of the last one where the two have the same points and triangles.
  /// Cost: none for the arrays of last time, O(points + triangles) for new ones.
  /// @param last  what was read from the mesh of the last call; empty: the mesh counts as new
  std::int64_t Of(vtkPolyData* data, const InputMesh& last, int threads);

private:
  StageKey arrays_;
  std::int64_t version_ = 0;
};

} // namespace gridfem

#endif
