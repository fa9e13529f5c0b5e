// Checks whether a filter can compute on a data set. It also gives access to Core's checks of
// meshes and numbers.
#ifndef GridFEM_InputValidation_h
#define GridFEM_InputValidation_h

#include "Solvers/Requirements.h"

#include "vtkType.h"

class vtkDataSet;
class vtkInformationVector;

namespace gridfem
{

/// Whether there are no points at all. Outputs are then empty, without a message.
bool IsEmpty(vtkDataSet* input);

/// Throws InvalidInput for a data set with volume cells, because every piece of a volume has a
/// surface of its own. The data set may be null.
void RequireNoVolume(vtkDataSet* piece);

/// Throws InvalidInput for cells whose offsets and corners do not fit together. The cells of a
/// vtkPolyData may still name points that do not exist. The cells of a vtkUnstructuredGrid may not,
/// because VTK reads them unchecked. The data set may be null.
void RequireSoundCells(vtkDataSet* input);

/// Throws InvalidInput for cells on a port from 1 on that do not fit together, or that name points
/// that do not exist. No filter reads these ports with checks of its own.
/// @param inputs  one vector per port
void RequireFurtherInputs(vtkInformationVector** inputs, int ports);

/// Throws InvalidInput, naming the cell, if one of its corners is a point that does not exist.
/// @param points  the number of points
/// @param whole   has these points: "mesh" or "piece"
void RequireCorners(
  Id cell, vtkIdType size, const vtkIdType* ids, vtkIdType points, const char* whole);

} // namespace gridfem

#endif
