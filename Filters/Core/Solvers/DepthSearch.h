// Finds the depth of the grid for a wanted error. It goes from a coarse grid to finer grids, until
// the estimated error is small enough or the next grid does not fit into memory.
#ifndef GridFEM_DepthSearch_h
#define GridFEM_DepthSearch_h

#include "Equations/SolutionAccuracy.h"
#include "Grid/TriangleMesh.h"
#include "Spaces/FunctionKind.h"

#include <vector>

namespace gridfem
{

/// Searches the depth for an equation on the grid. Solve at Depth() and pass the error to Judge,
/// until IsFound().
class DepthSearch
{
public:
  int Depth() const { return depth_; }
  bool IsFound() const { return isFound_; }

  /// Whether the wanted error is reached at the depth found.
  bool IsReached() const { return isReached_; }

  /// Ends the search, or goes on to another depth. Has no effect once the depth is found.
  /// @param errors  of the solution at Depth(). An error that is not trusted has to be small enough
  ///   at two consecutive depths
  /// @param wanted  relative error, above 0
  /// @param kind    of the functions, whose memory limits the depth
  void Judge(
    const TriangleMesh& mesh, const SolutionAccuracy& errors, double wanted, FunctionKind kind);

private:
  int depth_ = 5; // a start at almost no cost
  bool isFound_ = false;
  bool isReached_ = false;
  bool wasAccurate_ = false;
};

///@{ Search for a spectrum: the first depth, and the next depth after `depth`. The second
/// function gets the estimated relative errors of the eigenvalues on the grid of `depth`. It
/// returns `depth` itself when they are small enough and confirmed, or when the next depth does not
/// fit into memory.
/// @param isConfirmed  whether the errors are trusted, or were small enough at the depth before,
/// too
/// @param accuracy  wanted relative error, in (0, 1)
/// @param kind      Hats: hat functions of the mesh stand above the grid
int FirstDepthForModes(const TriangleMesh& mesh, Id modes, double accuracy, FunctionKind kind);
int NextDepthForModes(const TriangleMesh& mesh, const std::vector<double>& errors, bool isConfirmed,
  int depth, double accuracy, FunctionKind kind);
///@}

} // namespace gridfem

#endif
