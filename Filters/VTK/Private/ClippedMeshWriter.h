// From Core's clipped mesh and function space to vtkPolyData. [DESIGN §4]
#ifndef GridFEM_ClippedMeshWriter_h
#define GridFEM_ClippedMeshWriter_h

#include "ClippedArrays.h"

class vtkPoints;

namespace gridfem
{

/// The part of a clipped mesh that does not depend on the input's arrays: the triangles, input
/// points first, in the input's precision (double for integer points), then cut points; the clip's
/// own cell and field arrays. Kept between runs, so that later filters see unchanged arrays.
void WriteClippedFrame(vtkPolyData* input, const InputMesh& mesh, const ClippedMesh& clipped,
  bool weldCoincidentPoints, int threads, vtkPolyData* frame);

/// The same of a part of a clipped mesh.
/// @param cells  of the whole, ascending
void WriteClippedFrame(vtkPolyData* input, const InputMesh& mesh, const ClippedMesh& part,
  const std::vector<MortonKey>& cells, bool weldCoincidentPoints, int threads, vtkPolyData* frame);

/// Adds the input's point arrays, interpolated along source triangles, its cell arrays by source
/// cell, and its field arrays. Throws InvalidInput naming an array of wrong length.
void AddInputArrays(vtkPolyData* input, const InputMesh& mesh, const ClippedMesh& clipped,
  int threads, vtkPolyData* output);

/// Adds the input's field arrays alone.
void AddFieldArrays(vtkPolyData* input, vtkPolyData* output);

/// Adds PatchId, PatchColor, PatchCellId, PatchBasisIds, NumberOfBasisFunctions, ConnectivityAware
/// and WeldCoincidentPoints.
/// @param cells      of the octree that contain surface
/// @param cellPatch  per cell of `output`
void WriteBasis(const PatchLevel& finest, const std::vector<MortonKey>& cells,
  FunctionSupport support, const std::vector<Id>& cellPatch, bool weldCoincidentPoints,
  vtkPolyData* output);

/// Adds the cell and field arrays of one mesh to another; replaces those of the same name.
void PassArrays(vtkPolyData* from, vtkPolyData* to);

/// The patch of every clipped triangle: pieces in order, each with its fan.
std::vector<Id> PatchesOfTriangles(const GridFunctions& space, int threads);

/// Points in the precision of the input's: single stays single, all else becomes double.
int OutputPrecision(vtkPoints* input);

} // namespace gridfem

#endif
