// Puts the input's arrays on a clipped mesh.
#ifndef GridFEM_InterpolatedArrays_h
#define GridFEM_InterpolatedArrays_h

#include "Grid/Clip.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <string>
#include <vector>

class vtkAbstractArray;
class vtkCellData;
class vtkDataArray;
class vtkDataSetAttributes;
class vtkIdList;
class vtkPointData;

namespace gridfem
{

/// Whether the values of an array are of a type of real numbers.
bool IsReal(vtkAbstractArray* array);

/// Whether an array holds colors: bytes with three or four components. Colors may be mixed, labels
/// may not.
bool IsColor(vtkAbstractArray* array);

/// Throws InvalidInput, naming the array, unless it has this number of tuples.
/// @param kind  the tuples belong to: "points" or "cells"
void RequireLength(vtkAbstractArray* array, Id expected, const std::string& kind);

/// Whether an array belongs to the points or cells themselves, so that no copy at other places has
/// it: ghost flags, global ids and pedigree ids.
bool BelongsToItsPlaces(vtkAbstractArray* array, vtkDataSetAttributes* attributes);

/// Returns an array of the same type and names with so many tuples, without values. Throws
/// std::bad_alloc.
vtkSmartPointer<vtkAbstractArray> MakeLike(vtkAbstractArray* array, vtkIdType tuples);

/// Returns the tuples of an array at some places. Throws std::bad_alloc.
vtkSmartPointer<vtkAbstractArray> PickTuples(vtkAbstractArray* array, vtkIdList* places);

/// The number that stands for no result: NaN for real numbers, -1 for ids, 0 for others.
double NumberOfNone(vtkAbstractArray* array);

/// A place on a triangle: the points at its corners, and their weights.
struct TrianglePlace
{
  std::array<Id, 3> corners{ -1, -1, -1 }; // -1: there is no place
  std::array<double, 3> weights{};
};

/// Returns the values of an array at places. Real numbers and colors are linear on the triangles.
/// Other values come from the nearest corner. Without a place they are NumberOfNone or empty.
/// Throws std::bad_alloc.
vtkSmartPointer<vtkAbstractArray> ValuesAtPlaces(
  vtkAbstractArray* array, const std::vector<TrianglePlace>& places);

/// Adds point arrays at the clipped points. Without cut points they are shared unchanged. Real
/// numbers are linear along source triangles, as double. Colors (bytes with 3 or 4 components) are
/// also linear, rounded, as bytes. Other integers, ghost flags and text come from the nearest
/// corner. Global and pedigree ids are left out. Active attributes stay active. Throws InvalidInput
/// naming an array of wrong length.
/// @param areCut  whether there are cut points; for a part of a clip: on any part
void InterpolatePointArrays(vtkPointData* input, const TriangleMesh& mesh,
  const ClippedMesh& clipped, bool areCut, int threads, vtkPointData* output);

/// Adds cell arrays, copied from the source cell of every output cell. Leaves out arrays of an
/// earlier clip, and arrays whose names the output has.
/// @param isClipped  whether the input carries a clip
void CopyCellArrays(vtkCellData* input, Id numberOfCells, bool isClipped, vtkCellData* output,
  vtkDataArray* sourceCellId);

/// Interpolates the arrays that both have, except arrays that name points or cells.
void PassActiveAttributes(vtkDataSetAttributes* input, vtkDataSetAttributes* output);

} // namespace gridfem

#endif
