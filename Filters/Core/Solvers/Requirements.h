// Decides in one place whether a surface can be computed on, and explains why not.
#ifndef GridFEM_Requirements_h
#define GridFEM_Requirements_h

#include "Grid/RequireSurface.h"
#include "Spaces/FunctionKind.h"

#include <limits>
#include <string>

namespace gridfem
{

/// Returns the label of a property in the panel: its name, with spaces between the words.
std::string LabelOf(const std::string& property);

/// Returns why a number is refused that is NaN, infinite or outside of [least, most], or nothing.
/// The message has the label of the property, the value and the range.
std::string RefusalOf(const std::string& property, double value, double least, double most);

/// Throws InvalidInput with that message.
void RequireInRange(const std::string& property, double value, double least, double most);

/// The same for a number without a largest value.
void RequireAtLeast(const std::string& property, double value, double least);

/// Throws InvalidInput, with the label of the property, if its value is NaN. NaN passes every
/// clamp.
void RequireNumber(const std::string& property, double value);

/// Throws InvalidInput, naming the subject, for functions of degree two.
/// @param subject  plural, such as "Distances"
void RequireFirstDegree(FunctionKind kind, const char* subject);

/// The finest depth from `most` down at which everything that a solver makes should fit into
/// memory, or `least`.
int FittingDepth(const TriangleMesh& mesh, int most, int least, FunctionKind kind);

/// A value in place of a depth. It stands for the suggested depth, or for a smaller one that fits
/// into memory.
inline constexpr int AutomaticDepth = 0;

///@{ Largest number of functions per point of the mesh for a grid below hat functions. More
/// functions make every step more expensive and save none (Testing/Benchmarks/README.md).
inline constexpr double EnoughToPrecondition = 1.0;
inline constexpr double EnoughToEstimate = 4.0; // its errors are small beside the hats'
inline constexpr double AsManyAsWanted = std::numeric_limits<double>::infinity(); // to solve on it
///@}

/// The depth to compute at, given the `wanted` depth. An automatic depth is replaced by a suitable
/// one. Below hat functions a coarser depth is taken if it is enough.
/// @param perPoint  functions per point of the grid below the hat functions, if there are any
int ChooseDepth(const TriangleMesh& mesh, int wanted, FunctionKind kind, double perPoint);

/// The memory that a job needs, and advice if there is not enough of it.
struct MemoryNeed
{
  double bytes;
  std::string subject;
  std::string advice;
};

inline constexpr const char* CoarserGrid = "Each step down in Depth needs a quarter of the memory.";

/// The memory for this number of eigenvectors.
MemoryNeed NeedOfModes(Id functions, Id modes, int threads);

/// Throws InvalidInput when a job needs more bytes than are available.
/// @param where  for the message, such as " on this machine"
void RequireMemory(const MemoryNeed& need, double available, const std::string& where = {});

/// Throws InvalidInput, with the estimate, when this depth needs more memory than there is.
void RequireMemory(const TriangleMesh& mesh, int depth, FunctionKind kind);

/// The same for hat functions above an existing grid with this number of functions.
void RequireMemoryForHats(const TriangleMesh& mesh, Id functions);

} // namespace gridfem

#endif
