// The depth of the grid that a wanted error asks for: from a coarse grid to finer ones, until the
// estimated error is small enough or the next grid does not fit into memory.
#ifndef GridFEM_DepthSearch_h
#define GridFEM_DepthSearch_h

#include "Grid/TriangleMesh.h"
#include "Problems/SolutionAccuracy.h"
#include "Spaces/FunctionKind.h"

#include <vector>

namespace gridfem
{

/// Of an equation on the grid. Solve at Depth(), tell the error, until it is found.
class DepthSearch
{
public:
  int Depth() const { return depth_; }
  bool IsFound() const { return isFound_; }

  /// Ends the search, or goes on to another depth. Without effect once it is found.
  /// @param errors  of the solution at Depth(). Where they are not to be trusted the error has to
  ///                be small enough at two depths, one after the other
  /// @param wanted  relative error, above 0
  void Judge(const TriangleMesh& mesh, const SolutionAccuracy& errors, double wanted);

private:
  int depth_ = 5; // costs next to nothing
  bool isFound_ = false;
  bool wasAccurate_ = false;
};

///@{ Of a spectrum. The depth to begin with, and the one to go on with after `depth`, at which the
/// eigenvalues on the grid have these estimated relative errors; `depth` itself where it is enough.
/// @param accuracy  wanted relative error, in (0, 1)
/// @param kind      Hats: those of the mesh stand above the grid
int FirstDepthForModes(const TriangleMesh& mesh, Id modes, double accuracy, FunctionKind kind);
int NextDepthForModes(const TriangleMesh& mesh, const std::vector<double>& errors, int depth,
  double accuracy, FunctionKind kind);
///@}

} // namespace gridfem

#endif
