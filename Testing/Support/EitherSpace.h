// Builds a space on a mesh for tests that run on both kinds of space.
#ifndef GridFEM_Testing_EitherSpace_h
#define GridFEM_Testing_EitherSpace_h

#include "Spaces/HatSpace.h"

#include <memory>

namespace gridfem::testing
{

/// Returns the hats of the mesh, or the functions of the grid below them.
inline std::unique_ptr<FiniteElementSpace> BuildEither(
  const TriangleMesh& mesh, bool isOnHats, const GridSpaceOptions& options)
{
  const HatSpace hats = BuildHatSpace(mesh, options);
  return isOnHats ? hats.Copy() : hats.Grid().Copy();
}

inline std::unique_ptr<FiniteElementSpace> BuildEither(
  const TriangleMesh& mesh, bool isOnHats, int depth, double normalStabilization, int threads = 0)
{
  GridSpaceOptions options;
  options.functions.depth = depth;
  options.functions.threads = threads;
  options.normalStabilization = normalStabilization;
  return BuildEither(mesh, isOnHats, options);
}

} // namespace gridfem::testing

#endif
