// Writes Core's clipped mesh and function space to vtkPolyData. [DESIGN §4]
#ifndef GridFEM_ClippedMeshWriter_h
#define GridFEM_ClippedMeshWriter_h

#include "Output/ClippedArrays.h"

class vtkPoints;

namespace gridfem
{

/// Returns the part of a clipped mesh that does not depend on the input's arrays: triangles,
/// points, and the clip's own cell and field arrays. The input points come first, in the input's
/// precision (double for integer points), then the cut points. Kept between runs, so that later
/// filters see unchanged arrays.
void WriteClippedFrame(vtkPolyData* input, const InputMesh& mesh, const ClippedMesh& clipped,
  bool weldCoincidentPoints, int threads, vtkPolyData* frame);

/// Returns the same for a part of a clipped mesh.
/// @param cells  are the cells of the whole, ascending
void WriteClippedFrame(vtkPolyData* input, const InputMesh& mesh, const ClippedMesh& part,
  const std::vector<MortonKey>& cells, bool weldCoincidentPoints, int threads, vtkPolyData* frame);

/// Adds the input's arrays: point arrays interpolated along source triangles, cell arrays by source
/// cell, and field arrays. Throws InvalidInput naming an array of wrong length.
void AddInputArrays(vtkPolyData* input, const InputMesh& mesh, const ClippedMesh& clipped,
  int threads, vtkPolyData* output);

/// Adds only the input's field arrays.
void AddFieldArrays(vtkPolyData* input, vtkPolyData* output);

/// Adds PatchId, PatchColor, PatchCellId, PatchBasisIds, NumberOfBasisFunctions, ConnectivityAware
/// and WeldCoincidentPoints.
/// @param cells      the octree cells that contain surface
/// @param cellPatch  the patch of each cell of `output`
void WriteBasis(const PatchLevel& finest, const std::vector<MortonKey>& cells,
  FunctionSupport support, const std::vector<Id>& cellPatch, bool weldCoincidentPoints,
  vtkPolyData* output);

/// Adds the cell and field arrays of one mesh to another, and replaces arrays of the same name.
void PassArrays(vtkPolyData* from, vtkPolyData* to);

/// Returns the patch of every clipped triangle. The pieces are in order, each with its fan.
std::vector<Id> PatchesOfTriangles(const GridFunctions& space, int threads);

/// Returns points in the precision of the input: single stays single, everything else becomes
/// double.
int OutputPrecision(vtkPoints* input);

} // namespace gridfem

#endif
