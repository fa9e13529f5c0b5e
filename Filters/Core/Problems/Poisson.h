// The screened Poisson equation (λM + L) u = λ f + s on a function space. [T (3.1); DESIGN §3]
#ifndef GridFEM_Poisson_h
#define GridFEM_Poisson_h

#include "Krylov/PrecisionFallback.h"
#include "Spaces/HatMultigrid.h"
#include "Spaces/LevelOperators.h"

namespace gridfem
{

struct PoissonOptions
{
  double screeningWeight = 1.0; // λ >= 0, in 1 / grid unit²: world λ times spacing²
  MultigridOptions multigrid;
  IterationType iteration = IterationType::ConjugateGradients;
  SolveOptions solve;
};

/// What the solver has to know of the functions of any space.
struct ComponentFunctions
{
  const std::vector<Index>& component; // per function: its connected component
  Index numberOfComponents;
  const std::vector<double>& integral; // ∫ b_i; the functions of a component sum to 1
};

struct PoissonSolution
{
  MultiVector coefficients; // rows = functions, one column per component
  SolveReport report;
};

/// Solves for all columns. The solution has the mean of f on every connected component, for every
/// λ >= 0: the constant part is taken from f and the rest is iterated orthogonal to it, from a
/// start by nested iteration; in double precision where single is not enough (SolveWithFallback).
/// @param values     ∫ f b_i (IntegrateValues), grid units
/// @param gradients  ∫ <s, ∇b_i> (IntegrateGradients), grid units; may have no rows for s = 0
/// @param multigrid  of λM + L, built with the same λ
/// Columns may have any size in the range of numbers: they are scaled by powers of two.
/// Same bits for any number of threads.
PoissonSolution SolvePoisson(const ComponentFunctions& functions, const Multigrid& multigrid,
  const MultiVector& values, const MultiVector& gradients, const PoissonOptions& options,
  const Progress& progress = {});

/// The hats of a mesh.
inline ComponentFunctions FunctionsOf(const HatHierarchy& hats)
{
  return { hats.functions.component, hats.functions.numberOfComponents, hats.matrices.integral };
}

/// The same on the finest functions of a grid.
PoissonSolution SolvePoisson(const GridFunctions& space, const LevelOperators& system,
  const Multigrid& multigrid, const MultiVector& values, const MultiVector& gradients,
  const PoissonOptions& options, const Progress& progress = {});

} // namespace gridfem

#endif
