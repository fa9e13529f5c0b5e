// The screened Poisson equation (λM + L) u = λ f + s on any space. [T (3.1); DESIGN §3]
#ifndef GridFEM_Poisson_h
#define GridFEM_Poisson_h

#include "Krylov/PrecisionFallback.h"
#include "Problems/SolutionAccuracy.h"
#include "Spaces/FiniteElementSpace.h"

namespace gridfem
{

/// How an equation is solved.
struct EquationOptions
{
  MultigridOptions multigrid;
  SolveOptions solve;
  /// In (0, 1]: iterate until the algebraic error is estimated to be this part of the error of the
  /// space, and solve.tolerance is an end as well, if it comes first; 0 stands for 1e-9 then, which
  /// solutions reach that coarser levels contain. 0: to the tolerance alone.
  double accuracy = 0.0;
};

/// With 0 as solve.maximumIterations the start is the solution: that of the next coarser level.
struct PoissonOptions : EquationOptions
{
  double screeningWeight = 1.0; // λ >= 0, per squared unit of length of the space
  IterationType iteration = IterationType::ConjugateGradients;
  bool estimateErrors = false; // also where nothing ends by them
  /// Coefficients to start from, as of a similar equation on the same space; null: nested
  /// iteration.
  const MultiVector* start = nullptr;
};

struct PoissonSolution
{
  MultiVector coefficients; // rows = functions, one column per component
  SolveReport report;
  SolutionAccuracy accuracy; // unknown unless asked for
  /// It has not converged, and no iteration would: the numbers of the equation do not determine the
  /// solution to the tolerance, as where all triangles are narrow or far smaller than the
  /// functions. A larger weight of the normal derivative does.
  bool isAtRounding = false;
};

/// Solves for all columns. The solution has the mean of f on every connected component, for every
/// λ >= 0: the constant part is taken from f and the rest is iterated orthogonal to it, from a
/// start by nested iteration; in double precision where single is not enough (SolveWithFallback).
/// @param values     ∫ f b_i (LoadOfValues), in the space's unit of length
/// @param gradients  ∫ <s, ∇b_i> (LoadOfGradients); may have no columns for s = 0
/// @param multigrid  of λM + L, built with the same λ
/// Columns may have any size in the range of numbers: they are scaled by powers of two.
/// Same bits for any number of threads. Where processes hold the finest level together, all of them
/// call it, with a progress that is aborted for all or none, and rows of integrals that several
/// hold are whole in all of them; of the largest error at a point each tells that of its own.
PoissonSolution SolvePoisson(const SpaceLevels& space, const Multigrid& multigrid,
  const MultiVector& values, const MultiVector& gradients, const PoissonOptions& options,
  const Progress& progress = {});

} // namespace gridfem

#endif
