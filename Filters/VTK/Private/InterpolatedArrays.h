// The input's arrays on a clipped mesh.
#ifndef GridFEM_InterpolatedArrays_h
#define GridFEM_InterpolatedArrays_h

#include "Grid/Clip.h"

class vtkAbstractArray;
class vtkCellData;
class vtkDataArray;
class vtkDataSetAttributes;
class vtkPointData;

namespace gridfem
{

/// Whether its values are of a type of real numbers.
bool IsReal(vtkAbstractArray* array);

/// Point arrays at the clipped points; without cut points they are shared as they are. Real numbers
/// are linear along source triangles, as double; colours (bytes with 3 or 4 components) as well,
/// rounded, as bytes. Other integers, ghost flags and text are taken from the nearest corner.
/// Global and pedigree ids are left out. Active attributes stay active. Throws InvalidInput naming
/// an array of wrong length.
/// @param areCut  whether there are cut points; of a part of a clip: anywhere
void InterpolatePointArrays(vtkPointData* input, const TriangleMesh& mesh,
  const ClippedMesh& clipped, bool areCut, int threads, vtkPointData* output);

/// Cell arrays, copied from the source cell of every output cell. Arrays of the clip itself (from
/// an earlier clip) are left out.
void CopyCellArrays(
  vtkCellData* input, Id numberOfCells, vtkCellData* output, vtkDataArray* sourceCellId);

/// Of the arrays that both have; those that name points or cells are left out.
void PassActiveAttributes(vtkDataSetAttributes* input, vtkDataSetAttributes* output);

} // namespace gridfem

#endif
