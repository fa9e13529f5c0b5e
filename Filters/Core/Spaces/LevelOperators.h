// The discrete operators on a function space: element matrices of all levels, patterns and
// prolongations, from which a hierarchy for any a M + b L is combined. [T (4.5), (4.6)]
#ifndef GridFEM_LevelOperators_h
#define GridFEM_LevelOperators_h

#include "Base/Job.h"
#include "Integrals/Assembly.h"
#include "Integrals/QuadratureRule.h"

#include <memory>
#include <vector>

namespace gridfem
{

/// Depends on the mesh and the space, not on λ. Grid units.
struct LevelOperators
{
  std::vector<ElementMatrices> elements;  // per level, finest first
  std::vector<FunctionPlaces> places;     // per level
  std::vector<SparseMatrix> pattern;      // per level, without values
  std::vector<SharedMatrix> prolongation; // level l+1 to l; one less than levels
  std::vector<SharedMatrix> restriction;  // their transposes
  std::vector<double> integral;           // ∫ b_i of the finest functions, grid units
  int quadratureDegree = 2;
  double normalStabilization = DefaultNormalStabilization;
};

/// Integrates, coarsens down to the first level with at most `coarsestSize` functions in its
/// largest component (or to depth 0), builds patterns and prolongations. Throws InvalidInput when
/// the weight of the normal derivative is not in (0, 1].
LevelOperators BuildLevelOperators(const GridFunctions& space, const QuadratureRule& rule,
  const Job& job = {}, Index coarsestSize = 256,
  double normalStabilization = DefaultNormalStabilization);

/// From element matrices of the finest level, which may be no integrals over clipped pieces.
LevelOperators OperatorsOfElements(const GridFunctions& space, ElementMatrices finest,
  const Job& job = {}, Index coarsestSize = 256);

/// Brings a system up to date whose finest element matrices, elements.front(), have new values: in
/// another metric (SurfaceMetric.h) or with other weights (DirectionalElements.h) on the same
/// patches. Patterns and prolongations stay.
void UpdateOperators(const GridFunctions& space, LevelOperators& system, int threads = 0,
  ElementParts parts = ElementParts::Both);

} // namespace gridfem

#endif
