#include "Solvers/DistanceHierarchy.h"

#include "Base/Errors.h"
#include "Solvers/OptionFields.h"

#include <sstream>

namespace gridfem
{
namespace
{

void RequireStabilization(double stabilization)
{
  if (stabilization < DistanceOptions::LeastStabilization)
  {
    std::ostringstream text;
    text << "Normal Stabilization is " << stabilization << "; distances need at least "
         << DistanceOptions::LeastStabilization
         << ", because the heat that finds them changes its sign at sharp edges otherwise.";
    throw InvalidInput(text.str());
  }
}

} // namespace

void UpdateDistanceMethod(const Surface& surface, DistanceOptions options,
  std::unique_ptr<DistanceMethod>& method, const Progress& progress)
{
  RequireStabilization(surface.UsedOptions().choice.normalStabilization);
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
