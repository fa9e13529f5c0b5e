#include "Spaces/LevelOperators.h"

#include "Base/Parallel.h"
#include "Base/Prefetch.h"
#include "Integrals/ElementLanes.h"

#include <algorithm>

namespace gridfem
{

namespace
{

bool IsCoarsest(const GridFunctions& space, std::size_t level, Index coarsestSize, int threads)
{
  return level + 1 == space.levels.size() ||
         space.levels[level].numberOfFunctions <= coarsestSize ||
         LargestComponent(space.levels[level], threads) <= coarsestSize;
}

using SumsOfRows = std::array<double, FunctionsPerPatch>;

/// Computes the row sums of `count` matrices; `count` is at most LaneCount.
void SumRows(const ElementMatrix* matrices, int count, SumsOfRows* sums)
{
  MatrixPointers entries;
  std::array<double*, LaneCount> result{};
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    entries[lane] = matrices[std::min(lane, count - 1)].data();
    result[lane] = lane < count ? sums[lane].data() : nullptr;
  }
  ElementLanes lanes;
  Gather(entries, lanes);
  LaneBlock block;
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    block.col(i) = lanes[PackedIndex(i, 0)];
    for (int j = 1; j < FunctionsPerPatch; ++j)
    {
      block.col(i) += lanes[PackedIndex(i, j)];
    }
  }
  StoreLanes(block, result, count, 0);
}

/// Returns ∫ b_i, the sum of row i of the mass matrix, because the functions of a patch sum to 1.
std::vector<double> IntegralsOfFunctions(
  const FunctionPlaces& places, const Array<ElementMatrix>& mass, int threads)
{
  Array<SumsOfRows> ofPatch(mass.size());
  const auto patches = static_cast<Id>(mass.size());
  ForEachLaneGroup(patches, threads,
    [&](Id begin, int count)
    {
      for (Id next = begin + count; next < std::min<Id>(patches, begin + 2 * LaneCount); ++next)
      {
        FetchAll(mass[next]);
      }
      SumRows(mass.data() + begin, count, ofPatch.data() + begin);
    });
  const double* const sums = ofPatch.empty() ? nullptr : ofPatch.front().data();
  const auto functions = static_cast<Id>(places.begin.size()) - 1;
  std::vector<double> integral(functions);
  ParallelRanges(functions, threads,
    [&](Id begin, Id end)
    {
      for (Id f = begin; f < end; ++f)
      {
        double sum = 0.0;
        for (Index k = places.begin[f]; k < places.begin[f + 1]; ++k)
        {
          sum += sums[places.item[k]];
        }
        integral[f] = sum;
      }
    });
  return integral;
}

} // namespace

LevelOperators BuildLevelOperators(const GridFunctions& space, const QuadratureRule& rule,
  const Job& job, Index coarsestSize, double normalStabilization)
{
  if (!(normalStabilization > 0.0 && normalStabilization <= 1.0))
  {
    throw InvalidInput("Normal Stabilization must be above 0 and at most 1.");
  }
  LevelOperators system = OperatorsOfElements(space,
    IntegrateElements(space, rule, job.Part(0.0, 0.5), normalStabilization), job.Part(0.5, 1.0),
    coarsestSize);
  system.quadratureDegree = rule.degree;
  system.normalStabilization = normalStabilization;
  return system;
}

LevelOperators OperatorsOfElements(
  const GridFunctions& space, ElementMatrices finest, const Job& job, Index coarsestSize)
{
  LevelOperators system;
  system.elements.push_back(std::move(finest));
  for (std::size_t l = 0;; ++l)
  {
    const PatchLevel& level = space.levels[l];
    system.places.push_back(PlacesOfFunctions(level, job.threads));
    system.pattern.push_back(BuildPattern(level, system.places.back(), job.threads));
    job.Check(0.8 * double(l + 1) / double(space.levels.size()));
    if (IsCoarsest(space, l, coarsestSize, job.threads))
    {
      break;
    }
    const PatchLevel& coarse = space.levels[l + 1];
    system.prolongation.push_back(
      BuildProlongation(level, system.places.back(), coarse, job.threads));
    system.restriction.push_back(Transpose(system.prolongation.back(), job.threads));
    ElementMatrices elements;
    CoarsenElements(level, coarse, system.elements.back(), elements, job.threads);
    system.elements.push_back(std::move(elements));
  }
  system.integral =
    IntegralsOfFunctions(system.places.front(), system.elements.front().mass, job.threads);
  job.Check(1.0);
  return system;
}

void UpdateOperators(
  const GridFunctions& space, LevelOperators& system, int threads, ElementParts parts)
{
  for (std::size_t l = 0; l + 1 < system.elements.size(); ++l)
  {
    CoarsenElements(space.levels[l], space.levels[l + 1], system.elements[l],
      system.elements[l + 1], threads, parts);
  }
  system.integral =
    IntegralsOfFunctions(system.places.front(), system.elements.front().mass, threads);
}

} // namespace gridfem
