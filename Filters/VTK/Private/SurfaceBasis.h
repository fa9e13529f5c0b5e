// A function space together with the triangles it was made from, and what solvers share of it.
#ifndef GridFEM_SurfaceBasis_h
#define GridFEM_SurfaceBasis_h

#include "Grid/GridFunctions.h"
#include "InputMesh.h"
#include "Spaces/LevelOperators.h"

#include <map>
#include <memory>
#include <mutex>
#include <tuple>

namespace gridfem
{

struct SystemKey
{
  int quadratureDegree;
  Index coarsestSize; // functions of the largest component on the coarsest level, at most
  double normalStabilization;

  bool operator<(const SystemKey& other) const
  {
    return std::tie(quadratureDegree, coarsestSize, normalStabilization) <
           std::tie(other.quadratureDegree, other.coarsestSize, other.normalStabilization);
  }
};

/// The systems of one function space, one per key, built when first asked for. All
/// views of a space on different meshes share one store, so that who asks first changes no bit.
class SystemStore
{
public:
  explicit SystemStore(std::shared_ptr<const GridFunctions> space) : space_(std::move(space)) {}

  /// The system, or null when it has not been built yet.
  std::shared_ptr<const LevelOperators> Find(const SystemKey& key) const;

  /// Builds it if need be; a second caller waits. Throws InvalidInput and Aborted.
  std::shared_ptr<const LevelOperators> Get(
    const SystemKey& key, int threads, const Progress& progress);

private:
  std::shared_ptr<const GridFunctions> space_;
  mutable std::mutex mutex_;
  std::map<SystemKey, std::shared_ptr<const LevelOperators>> systems_;
};

/// Immutable but for the store, so that it may be shared between filters and threads.
struct SurfaceBasis
{
  std::shared_ptr<const TriangleMesh> mesh; // what the pieces' source triangles refer to
  std::shared_ptr<const GridFunctions> space;
  std::shared_ptr<SystemStore> systems; // element matrices belong to patches, not to triangles

  explicit operator bool() const { return space != nullptr; }
};

SurfaceBasis MakeSurfaceBasis(std::shared_ptr<const TriangleMesh> mesh, GridFunctions space);

} // namespace gridfem

#endif
