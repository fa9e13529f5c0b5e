// The one place that decides whether a surface can be computed on, and says why not.
#ifndef GridFEM_Requirements_h
#define GridFEM_Requirements_h

#include "Grid/RequireSurface.h"

namespace gridfem
{

/// Throws InvalidInput, naming the property, when its value is NaN, which passes every clamp.
void RequireNumber(const char* property, double value);

/// The same for a value that is not finite or below `least`.
void RequireAtLeast(const char* property, double value, double least);

/// Whether all that a solver makes at this depth should fit into memory.
bool FitsMemory(const TriangleMesh& mesh, int depth, bool hatFunctions = false);

/// The finest depth from `most` down that fits into memory, or `least`.
int FittingDepth(const TriangleMesh& mesh, int most, int least, bool hatFunctions = false);

/// The suggested depth, or a smaller one that fits into memory.
int AffordableDepth(const TriangleMesh& mesh, bool hatFunctions = false);

/// Throws InvalidInput, with the estimate, when this depth needs more memory than there is.
void RequireMemory(const TriangleMesh& mesh, int depth, bool hatFunctions = false);

/// The same for hat functions above a grid with so many functions, which is there.
void RequireMemoryForHats(const TriangleMesh& mesh, Id functions);

/// Throws InvalidInput, with the estimate, when so many eigenvectors need more memory than there
/// is.
void RequireMemoryForModes(Id functions, Id modes, int threads);

} // namespace gridfem

#endif
