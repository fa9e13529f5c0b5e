// What decides, with RequireSurface, whether an input can be computed on, and says why not.
#ifndef GridFEM_InputValidation_h
#define GridFEM_InputValidation_h

#include "Grid/RequireSurface.h"

class vtkDataSet;

namespace gridfem
{

/// No points at all: gives empty outputs without a word.
bool IsEmpty(vtkDataSet* input);

/// Throws InvalidInput, naming the property, when its value is NaN, which passes every clamp.
void RequireNumber(const char* property, double value);

/// The same for a value that is not finite or below `least`.
void RequireAtLeast(const char* property, double value, double least);

/// Throws InvalidInput for a data set with volume cells, which has a surface of its own on every
/// rank that holds a piece of it. The data set may be null.
void RequireNoVolume(vtkDataSet* piece);

/// Whether all that a filter makes at this depth should fit into memory.
bool FitsMemory(const TriangleMesh& mesh, int depth, bool hatFunctions = false);

/// Throws InvalidInput, with the estimate, when this depth needs more memory than there is.
void RequireMemory(const TriangleMesh& mesh, int depth, bool hatFunctions = false);

/// The same for hat functions above a grid with so many functions, which is there.
void RequireMemoryForHats(const TriangleMesh& mesh, Id functions);

/// Throws InvalidInput, with the estimate, when so many eigenvectors need more memory than there
/// is.
void RequireMemoryForModes(Id functions, Id modes, int threads);

} // namespace gridfem

#endif
