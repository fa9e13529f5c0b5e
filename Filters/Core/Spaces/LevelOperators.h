// The discrete operators on a function space: element matrices of all levels, patterns and
// prolongations, from which a hierarchy for any a M + b L is combined. [T (4.5), (4.6)]
#ifndef GridFEM_LevelOperators_h
#define GridFEM_LevelOperators_h

#include "Integrals/Assembly.h"
#include "Multigrid/Multigrid.h"

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
  int revision = 0; // how often UpdateSystem has changed the elements
};

/// Integrates, coarsens down to the first level with at most `coarsestSize` functions in its
/// largest component (or to depth 0), builds patterns and prolongations. Throws InvalidInput when
/// the weight of the normal derivative is not in (0, 1].
LevelOperators BuildSystem(const GridFunctions& space, const QuadratureRule& rule, int threads = 0,
  Index coarsestSize = 256, const Progress& progress = {},
  double normalStabilization = DefaultNormalStabilization);

/// Brings a system up to date whose finest element matrices, elements.front(), have new values: in
/// another metric (SurfaceMetric.h) or with other weights (DirectionalElements.h) on the same
/// patches. Patterns and prolongations stay; UpdateMultigrid does the same for its hierarchies.
void UpdateSystem(const GridFunctions& space, LevelOperators& system, int threads = 0);

/// a M + b L on one level, and on every level. Grid units.
SparseMatrix LevelMatrix(const GridFunctions& space, const LevelOperators& system,
  std::size_t level, double a, double b, int threads = 0);
std::vector<SparseMatrix> LevelMatrices(
  const GridFunctions& space, const LevelOperators& system, double a, double b, int threads = 0);

/// The levels of a hierarchy for a M + b L, finest first, as Multigrid takes them.
std::vector<MultigridLevel> BuildMultigridLevels(const GridFunctions& space,
  const LevelOperators& system, double a, double b, int threads = 0, const Progress& progress = {});

/// a M + b L on every level, ready to cycle. Grid units: mass carries spacing².
Multigrid BuildMultigrid(const GridFunctions& space, const LevelOperators& system, double a,
  double b, const MultigridOptions& options, const Progress& progress = {});

/// New values, in place, for a hierarchy of the same space and system.
void UpdateMultigrid(const GridFunctions& space, const LevelOperators& system, double a, double b,
  Multigrid& multigrid);

/// The finest mass or stiffness matrix, grid units.
SparseMatrix MassMatrix(const GridFunctions& space, const LevelOperators& system, int threads = 0);
SparseMatrix StiffnessMatrix(
  const GridFunctions& space, const LevelOperators& system, int threads = 0);

} // namespace gridfem

#endif
