// The depth of the grid that an estimated error asks for.
#ifndef GridFEM_DepthSearch_h
#define GridFEM_DepthSearch_h

#include "Grid/TriangleMesh.h"
#include "StageCache.h"

namespace gridfem
{

/// Goes from a coarse grid to finer ones, until the error is as wanted or the next grid does not
/// fit into memory. What was found stays as long as the question does.
class DepthSearch
{
public:
  /// @param asked  all that the answer depends on
  /// @return the depth to begin with: for the same question the one that was found
  int Begin(const StageKey& asked);

  /// @param error      relative, of the solution at this depth; not a number: unknown
  /// @param isTrusted  else the error has to be small enough at two depths, one after the other
  /// @return the next depth to try; this one where the search ends
  int Next(const TriangleMesh& mesh, int depth, double error, bool isTrusted, double wanted);

private:
  StageKey asked_;
  int depth_ = 0;
  bool isFound_ = false;
  bool wasAccurate_ = false;
};

} // namespace gridfem

#endif
