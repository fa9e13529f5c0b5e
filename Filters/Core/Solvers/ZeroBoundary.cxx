#include "Solvers/ZeroBoundary.h"

#include <array>
#include <utility>

namespace gridfem
{
namespace
{

///@{ Penalty of a unit of length, over the number of units along the surface.
constexpr double GridPenalty = 6.0;
constexpr double HatPenalty = 1e5;
///@}

/// Null if no process has samples.
std::unique_ptr<const PenalizedLevels> WithPenalty(const SpaceLevels& space, const Surface& surface,
  EdgeSamples samples, double penalty, std::unique_ptr<const PenalizedLevels> nested)
{
  std::array<double, 1> count = { static_cast<double>(samples.rows.rows) };
  SumOverProcesses(surface.SumsOverProcesses(), count);
  if (count[0] == 0.0)
  {
    return nullptr;
  }
  std::vector<double> weight = std::move(samples.length);
  for (double& length : weight)
  {
    length *= penalty * space.Extent() / surface.Space().UnitLength();
  }
  return std::make_unique<const PenalizedLevels>(space,
    RowPenalty(space, std::move(samples.rows), std::move(weight), surface.Threads()),
    std::move(nested));
}

} // namespace

std::unique_ptr<const PenalizedLevels> ZeroOnBoundary(const Surface& surface)
{
  const SurfaceSpace& space = surface.Space();
  const SurfaceSpace* const grid = space.NestedLevels();
  std::unique_ptr<const PenalizedLevels> nested;
  if (grid)
  {
    nested = WithPenalty(*grid, surface, surface.SampleBoundary(true), GridPenalty, nullptr);
  }
  return WithPenalty(space, surface, surface.SampleBoundary(false), grid ? HatPenalty : GridPenalty,
    std::move(nested));
}

} // namespace gridfem
