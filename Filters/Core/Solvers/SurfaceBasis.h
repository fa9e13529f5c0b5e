// Holds the functions of a grid together with the triangles they were made from, the data that
// solvers share, and the finite element spaces on top of them.
#ifndef GridFEM_SurfaceBasis_h
#define GridFEM_SurfaceBasis_h

#include "Grid/TriangleMesh.h"
#include "Solvers/SharedStore.h"
#include "Spaces/HatSpace.h"
#include "Spaces/SmoothSpace.h"
#include "Spaces/SpaceChoice.h"

#include <memory>
#include <tuple>
#include <utility>

namespace gridfem
{

/// The options of operators: quadrature degree, coarsest size, and normal stabilization.
using OperatorKey = std::tuple<int, Index, double>;
using OperatorStore = SharedStore<OperatorKey, LevelOperators>;
using SmoothStore = SharedStore<OperatorKey, SmoothOperators>;
using HatStore = SharedStore<std::pair<bool, OperatorKey>, HatLevel>;

/// The basis of a surface. It is immutable except for the stores, so that filters and threads may
/// share it.
struct SurfaceBasis
{
  std::shared_ptr<const TriangleMesh> mesh; // the mesh of the pieces' source triangles
  std::shared_ptr<const GridFunctions> space;
  /// The element matrices. They belong to patches, not to triangles. All views of the functions on
  /// different meshes share one store, so that the first user changes no bit.
  std::shared_ptr<OperatorStore> operators;
  std::shared_ptr<SmoothStore> smooth; // the same for quadratic functions
  std::shared_ptr<HatStore> hats;      // by WeldCoincidentPoints, and the operators below
  bool weldCoincidentPoints = true;

  explicit operator bool() const { return space != nullptr; }
};

SurfaceBasis MakeSurfaceBasis(
  std::shared_ptr<const TriangleMesh> mesh, GridFunctions space, bool weldCoincidentPoints);

/// Returns the space, or null unless all its parts have been built already, perhaps by another
/// filter.
std::shared_ptr<const FiniteElementSpace> FindSpace(
  const SurfaceBasis& basis, const SpaceChoice& choice);

/// Builds the missing parts. Throws InvalidInput and Aborted.
std::shared_ptr<const FiniteElementSpace> MakeSpace(
  const SurfaceBasis& basis, const SpaceChoice& choice, const Job& job);

} // namespace gridfem

#endif
