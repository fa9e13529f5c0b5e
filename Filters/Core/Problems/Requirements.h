// The one place that decides whether a surface can be computed on, and says why not.
#ifndef GridFEM_Requirements_h
#define GridFEM_Requirements_h

#include "Grid/RequireSurface.h"
#include "Spaces/FunctionKind.h"

#include <limits>
#include <string>

namespace gridfem
{

/// Throws InvalidInput, naming the property, when its value is NaN, which passes every clamp.
void RequireNumber(const char* property, double value);

/// The same for a value that is not finite or below `least`.
void RequireAtLeast(const char* property, double value, double least);

/// Whether all that a solver makes at this depth should fit into memory.
bool FitsMemory(const TriangleMesh& mesh, int depth, FunctionKind kind = FunctionKind::Grid);

/// The finest depth from `most` down that fits into memory, or `least`.
int FittingDepth(
  const TriangleMesh& mesh, int most, int least, FunctionKind kind = FunctionKind::Grid);

/// In the place of a depth: the suggested one, or a smaller one that fits into memory.
inline constexpr int AutomaticDepth = 0;

///@{ How many functions a grid below hat functions has for each point of the mesh, at most. More of
/// them make every step dearer and save none (Testing/Benchmarks/README.md).
inline constexpr double EnoughToPrecondition = 1.0;
inline constexpr double EnoughToEstimate = 4.0; // the hats' errors, beside which its own are small
inline constexpr double AsManyAsWanted = std::numeric_limits<double>::infinity(); // to solve on it
///@}

/// The depth to compute at where `wanted` is asked for: another one where that is automatic, and
/// below hat functions a coarser one where that is enough.
/// @param perPoint  of the grid below the hat functions, if there are any
int ChooseDepth(const TriangleMesh& mesh, int wanted, FunctionKind kind, double perPoint);

/// What a job needs memory for, and what to do when there is not enough of it.
struct MemoryNeed
{
  double bytes;
  std::string subject;
  std::string advice;
};

inline constexpr const char* CoarserGrid =
  "Every step down in Depth takes a quarter of the memory.";

/// Of so many eigenvectors.
MemoryNeed NeedOfModes(Id functions, Id modes, int threads);

/// Throws InvalidInput when a job needs more bytes than are available.
/// @param where  as in " on this machine", for the message
void RequireMemory(const MemoryNeed& need, double available, const std::string& where = {});

/// Throws InvalidInput, with the estimate, when this depth needs more memory than there is.
void RequireMemory(const TriangleMesh& mesh, int depth, FunctionKind kind = FunctionKind::Grid);

/// The same for hat functions above a grid with so many functions, which is there.
void RequireMemoryForHats(const TriangleMesh& mesh, Id functions);

/// Throws InvalidInput, with the estimate, when so many eigenvectors need more memory than there
/// is.
void RequireMemoryForModes(Id functions, Id modes, int threads);

} // namespace gridfem

#endif
