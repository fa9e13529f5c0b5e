#include "Parallel/RankSpectrum.h"

#include "Parallel/RankLevels.h"

namespace gridfem
{

Spectrum ComputeSpectrum(
  const RankSpace& space, const SpectrumOptions& options, const Progress& progress)
{
  Validate(options);
  if (space.Numberings().front().total == 0)
  {
    return {};
  }
  return ComputeOnNestedLevels(RankLevels(space), options, OfAllRanks(space.Ranks(), progress));
}

} // namespace gridfem
