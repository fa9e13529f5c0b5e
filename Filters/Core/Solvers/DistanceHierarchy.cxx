#include "Solvers/DistanceHierarchy.h"

#include "Solvers/OptionFields.h"

namespace gridfem
{

void UpdateDistanceMethod(const Surface& surface, DistanceOptions options,
  std::unique_ptr<DistanceMethod>& method, const Progress& progress)
{
  options.multigrid.threads = surface.Threads();
  StageKey key;
  key.Add(surface.GetStages().Version(SystemStage)).Add(options.smoothing);
  key.Add(KeyOf(EquationOptions{ options.multigrid, {} }));
  surface.GetStages().Run(HierarchyStage, key,
    [&]
    {
      method.reset(); // frees its memory first
      method = surface.MakeDistance(options, surface.MakeJob(progress));
    });
}

} // namespace gridfem
