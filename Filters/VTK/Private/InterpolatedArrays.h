// The input's arrays on a clipped mesh.
#ifndef GridFEM_InterpolatedArrays_h
#define GridFEM_InterpolatedArrays_h

#include "Grid/Clip.h"

class vtkCellData;
class vtkDataArray;
class vtkPointData;

namespace gridfem
{

/// Point arrays at the clipped points, linear along source triangles, as double; without cut points
/// they are shared as they are. Text is taken from the nearest corner. Active attributes stay
/// active, but for ids, which interpolation spoils. Throws InvalidInput naming an array of wrong
/// length.
void InterpolatePointArrays(vtkPointData* input, const TriangleMesh& mesh,
  const ClippedMesh& clipped, int threads, vtkPointData* output);

/// Cell arrays, copied from the source cell of every output cell. Arrays of the clip itself (from
/// an earlier clip) are left out.
void CopyCellArrays(
  vtkCellData* input, Id numberOfCells, vtkCellData* output, vtkDataArray* sourceCellId);

} // namespace gridfem

#endif
