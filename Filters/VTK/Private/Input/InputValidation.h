// Checks whether a filter can compute on a data set. It also gives access to Core's checks of
// meshes and numbers.
#ifndef GridFEM_InputValidation_h
#define GridFEM_InputValidation_h

#include "Solvers/Requirements.h"

class vtkDataSet;

namespace gridfem
{

/// Whether there are no points at all. Outputs are then empty, without a message.
bool IsEmpty(vtkDataSet* input);

/// Throws InvalidInput for a data set with volume cells, because every piece of a volume has a
/// surface of its own. The data set may be null.
void RequireNoVolume(vtkDataSet* piece);

} // namespace gridfem

#endif
