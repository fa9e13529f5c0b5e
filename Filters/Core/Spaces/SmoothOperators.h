// The discrete operators on the quadratic B-splines of a grid: functions, matrices and
// prolongations of all levels. [T §7.2]
#ifndef GridFEM_SmoothOperators_h
#define GridFEM_SmoothOperators_h

#include "Base/Job.h"
#include "Integrals/Assembly.h"
#include "Integrals/QuadratureRule.h"
#include "Integrals/SmoothElements.h"

#include <vector>

namespace gridfem
{

/// The matrices of all levels, finest first, in grid units. Element matrices of 27 functions take
/// more memory than the matrices they add up to, so they are freed.
struct SmoothMatrices
{
  std::vector<SparseMatrix> mass;
  std::vector<SparseMatrix> stiffness; // with the patterns of the mass
  std::vector<double> integral;        // ∫ b_i of the finest functions
};

struct SmoothOperators
{
  std::vector<SmoothLevel> levels;
  std::vector<FunctionPlaces> places;     // per level
  std::vector<SparseMatrix> pattern;      // per level, without values
  std::vector<SharedMatrix> prolongation; // from level l + 1 to l; one fewer than there are levels
  std::vector<SharedMatrix> restriction;
  std::vector<Index> component; // of each finest function
  Index numberOfComponents = 0;
  SmoothMatrices matrices; // on the mesh itself
  int quadratureDegree = SmoothQuadratureDegree;
  double normalStabilization = SmoothStabilization;
};

/// Numbers the functions and integrates all matrices. Coarsening stops like that of
/// BuildLevelOperators. A lower degree or weight than the default is raised to it. Throws
/// InvalidInput when the weight of the normal derivative is not in (0, 1], and Aborted.
SmoothOperators BuildSmoothOperators(const GridFunctions& grid, int quadratureDegree,
  double normalStabilization, Index coarsestSize, const Job& job = {});

/// Integrates the matrices with given weights. Coarser levels follow by Galerkin's condition.
SmoothMatrices IntegrateMatrices(const GridFunctions& grid, const SmoothOperators& operators,
  const SmoothWeights& weights, const Job& job = {});

} // namespace gridfem

#endif
