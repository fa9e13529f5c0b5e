#include "Spaces/SmoothOperators.h"

#include "Base/Errors.h"
#include "Grid/SmoothLevels.h"

#include <algorithm>

namespace gridfem
{
namespace
{

/// Removes the levels below the first one that is small enough.
void KeepLevels(Index coarsestSize, int threads, std::vector<SmoothLevel>& levels)
{
  const auto coarsest = std::find_if(levels.begin(), levels.end() - 1,
    [&](const SmoothLevel& level)
    {
      return level.numberOfFunctions <= coarsestSize ||
             LargestComponent(level, threads) <= coarsestSize;
    });
  levels.erase(coarsest + 1, levels.end());
}

SparseMatrix Assemble(const SmoothLevel& level, const FunctionPlaces& places,
  const SparseMatrix& pattern, const Array<SmoothElementMatrix>& elements, int threads)
{
  SparseMatrix matrix = pattern;
  AssembleValues(level, places, elements, 1.0, {}, 0.0, matrix, threads);
  return matrix;
}

} // namespace

SmoothOperators BuildSmoothOperators(const GridFunctions& grid, int quadratureDegree,
  double normalStabilization, Index coarsestSize, const Job& job)
{
  if (!(normalStabilization > 0.0 && normalStabilization <= 1.0))
  {
    throw InvalidInput("Normal Stabilization must be above 0 and at most 1.");
  }
  SmoothOperators operators;
  operators.quadratureDegree = std::max(quadratureDegree, SmoothQuadratureDegree);
  operators.normalStabilization = std::max(normalStabilization, SmoothStabilization);
  operators.levels = BuildSmoothLevels(grid, job.Part(0.0, 0.1));
  KeepLevels(coarsestSize, job.threads, operators.levels);
  const std::vector<SmoothLevel>& levels = operators.levels;
  for (std::size_t l = 0; l < levels.size(); ++l)
  {
    operators.places.push_back(PlacesOfFunctions(levels[l], job.threads));
    operators.pattern.push_back(BuildPattern(levels[l], operators.places.back(), job.threads));
    if (l > 0)
    {
      operators.prolongation.push_back(
        BuildProlongation(levels[l - 1], operators.places[l - 1], levels[l], job.threads));
      operators.restriction.push_back(Transpose(operators.prolongation.back(), job.threads));
    }
    job.Check(0.1 + 0.3 * double(l + 1) / double(levels.size()));
  }
  operators.component = FunctionComponents(levels.front(), job.threads);
  operators.numberOfComponents = NumberOfComponents(operators.component);
  operators.matrices = IntegrateMatrices(grid, operators, {}, job.Part(0.4, 1.0));
  return operators;
}

SmoothMatrices IntegrateMatrices(const GridFunctions& grid, const SmoothOperators& operators,
  const SmoothWeights& weights, const Job& job)
{
  const std::vector<SmoothLevel>& levels = operators.levels;
  SmoothMatrices matrices;
  SmoothElementMatrices elements =
    IntegrateSmoothElements(grid, TriangleRule(operators.quadratureDegree),
      operators.normalStabilization, weights, job.Part(0.0, 0.6));
  for (std::size_t l = 0; l < levels.size(); ++l)
  {
    matrices.mass.push_back(
      Assemble(levels[l], operators.places[l], operators.pattern[l], elements.mass, job.threads));
    matrices.stiffness.push_back(Assemble(
      levels[l], operators.places[l], operators.pattern[l], elements.stiffness, job.threads));
    job.Check(0.6 + 0.4 * double(l + 1) / double(levels.size()));
    if (l + 1 < levels.size())
    {
      SmoothElementMatrices coarse;
      CoarsenElements(levels[l], levels[l + 1], elements, coarse, job.threads);
      elements = std::move(coarse);
    }
  }
  const MultiVector sums = RowSums(matrices.mass.front(), job.threads);
  matrices.integral.assign(sums.data(), sums.data() + sums.rows());
  return matrices;
}

} // namespace gridfem
