// The functions of a grid together with the triangles they were made from, what solvers share of
// them, and the finite element spaces that stand on them.
#ifndef GridFEM_SurfaceBasis_h
#define GridFEM_SurfaceBasis_h

#include "Grid/TriangleMesh.h"
#include "Solvers/SharedStore.h"
#include "Spaces/HatSpace.h"
#include "Spaces/SpaceChoice.h"

#include <memory>
#include <tuple>

namespace gridfem
{

using OperatorStore = SharedStore<std::tuple<int, Index, double>, LevelOperators>;
using HatStore = SharedStore<bool, HatLevel>;

/// Immutable but for the stores, so that it may be shared between filters and threads.
struct SurfaceBasis
{
  std::shared_ptr<const TriangleMesh> mesh; // what the pieces' source triangles refer to
  std::shared_ptr<const GridFunctions> space;
  /// Element matrices belong to patches, not to triangles: all views of the functions on different
  /// meshes share one store, so that who asks first changes no bit.
  std::shared_ptr<OperatorStore> operators;
  std::shared_ptr<HatStore> hats; // by WeldCoincidentPoints
  bool weldCoincidentPoints = true;

  explicit operator bool() const { return space != nullptr; }
};

SurfaceBasis MakeSurfaceBasis(
  std::shared_ptr<const TriangleMesh> mesh, GridFunctions space, bool weldCoincidentPoints);

/// The space, or null unless all that it takes has been built already, perhaps by another filter.
std::shared_ptr<const FiniteElementSpace> FindSpace(
  const SurfaceBasis& basis, const SpaceChoice& choice);

/// Builds what is missing. Throws InvalidInput and Aborted.
std::shared_ptr<const FiniteElementSpace> MakeSpace(
  const SurfaceBasis& basis, const SpaceChoice& choice, const Job& job);

} // namespace gridfem

#endif
