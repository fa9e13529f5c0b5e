#include "SurfaceBasis.h"

#include "Integrals/QuadratureRule.h"

namespace gridfem
{

std::shared_ptr<const LevelOperators> SystemStore::Find(const SystemKey& key) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = systems_.find(key);
  return found == systems_.end() ? nullptr : found->second;
}

std::shared_ptr<const LevelOperators> SystemStore::Get(
  const SystemKey& key, int threads, const Progress& progress)
{
  const QuadratureRule& rule = TriangleRule(key.quadratureDegree);
  const std::lock_guard<std::mutex> lock(mutex_);
  auto& system = systems_[key];
  if (!system)
  {
    system = std::make_shared<const LevelOperators>(
      BuildSystem(*space_, rule, threads, key.coarsestSize, progress, key.normalStabilization));
  }
  return system;
}

SurfaceBasis MakeSurfaceBasis(std::shared_ptr<const TriangleMesh> mesh, GridFunctions space)
{
  SurfaceBasis basis;
  basis.mesh = std::move(mesh);
  basis.space = std::make_shared<const GridFunctions>(std::move(space));
  basis.systems = std::make_shared<SystemStore>(basis.space);
  return basis;
}

} // namespace gridfem
