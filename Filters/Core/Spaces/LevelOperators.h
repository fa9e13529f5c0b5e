// The discrete operators on a function space: element matrices of all levels, patterns and
// prolongations. A hierarchy for any a M + b L is combined from them. [T (4.5), (4.6)]
#ifndef GridFEM_LevelOperators_h
#define GridFEM_LevelOperators_h

#include "Base/Job.h"
#include "Integrals/Assembly.h"
#include "Integrals/QuadratureRule.h"

#include <memory>
#include <vector>

namespace gridfem
{

/// Depends on the mesh and the space, but not on λ. In grid units.
struct LevelOperators
{
  std::vector<ElementMatrices> elements;  // per level, finest first
  std::vector<FunctionPlaces> places;     // per level
  std::vector<SparseMatrix> pattern;      // per level, without values
  std::vector<SharedMatrix> prolongation; // from level l + 1 to l; one fewer than there are levels
  std::vector<SharedMatrix> restriction;  // transposes of the prolongations
  std::vector<double> integral;           // ∫ b_i of the finest functions, grid units
  int quadratureDegree = 2;
  double normalStabilization = DefaultNormalStabilization;
};

/// Integrates the finest element matrices, coarsens them, and builds patterns and prolongations.
/// Coarsening stops at the first level whose largest component has at most `coarsestSize`
/// functions, or at depth 0. Throws InvalidInput when the weight of the normal derivative is not in
/// (0, 1].
LevelOperators BuildLevelOperators(const GridFunctions& space, const QuadratureRule& rule,
  const Job& job = {}, Index coarsestSize = 256,
  double normalStabilization = DefaultNormalStabilization);

/// Builds operators from element matrices of the finest level. The matrices need not be integrals
/// over clipped pieces.
LevelOperators OperatorsOfElements(const GridFunctions& space, ElementMatrices finest,
  const Job& job = {}, Index coarsestSize = 256);

/// Updates a system after its finest element matrices, elements.front(), have new values. The new
/// values may come from another metric (SurfaceMetric.h) or other weights (DirectionalElements.h)
/// on the same patches. Patterns and prolongations do not change.
void UpdateOperators(const GridFunctions& space, LevelOperators& system, int threads = 0,
  ElementParts parts = ElementParts::Both);

} // namespace gridfem

#endif
