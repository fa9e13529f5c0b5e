// Whether a data set can be computed on; with what Core requires of meshes and numbers.
#ifndef GridFEM_InputValidation_h
#define GridFEM_InputValidation_h

#include "Problems/Requirements.h"

class vtkDataSet;

namespace gridfem
{

/// No points at all: gives empty outputs without a word.
bool IsEmpty(vtkDataSet* input);

/// Throws InvalidInput for a data set with volume cells, which has a surface of its own in every
/// piece of it. The data set may be null.
void RequireNoVolume(vtkDataSet* piece);

} // namespace gridfem

#endif
