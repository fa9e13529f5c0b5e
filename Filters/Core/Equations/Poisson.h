// The screened Poisson equation (λM + L) u = λ f + s on any space. [T (3.1); DESIGN §3]
#ifndef GridFEM_Poisson_h
#define GridFEM_Poisson_h

#include "Equations/SolutionAccuracy.h"
#include "Krylov/PrecisionFallback.h"
#include "Spaces/FiniteElementSpace.h"

namespace gridfem
{

/// Options for the solve of an equation.
struct EquationOptions
{
  MultigridOptions multigrid;
  SolveOptions solve;
  /// In (0, 1]: iterate until the estimated algebraic error is this fraction of the error of the
  /// space. The tolerance in `solve` also ends the iteration. In this case, 0 stands for 1e-9,
  /// because the coarser levels may contain the solution. An accuracy of 0: iterate to the
  /// tolerance alone.
  double accuracy = 0.0;
};

/// With solve.maximumIterations = 0 the start is the result: the solution of the next coarser
/// level.
struct PoissonOptions : EquationOptions
{
  double screeningWeight = 1.0; // λ >= 0, per squared unit of length of the space
  IterationType iteration = IterationType::ConjugateGradients;
  bool estimateErrors = false; // estimate errors even if no iteration ends by them
  /// Coefficients to start from, such as the solution of a similar equation on the same space;
  /// null: nested iteration.
  const MultiVector* start = nullptr;
};

struct PoissonSolution
{
  MultiVector coefficients; // rows = functions, one column per component
  SolveReport report;
  SolutionAccuracy accuracy; // unknown unless asked for
  /// True if it has not converged and no iteration would. The numbers of the equation then do not
  /// determine the solution to the tolerance. This happens if all triangles are narrow or far
  /// smaller than the functions. A larger weight of the normal derivative helps.
  bool isAtRounding = false;
};

/// Solves the equation for all columns. The solution has the mean of f on every connected
/// component, for every λ >= 0. Its constant part is taken from f, and the rest is iterated
/// orthogonal to it, from a start by nested iteration. The iteration goes on in double precision if
/// single is not enough (SolveWithFallback).
/// @param values     ∫ f b_i (LoadOfValues), in the space's unit of length
/// @param gradients  ∫ <s, ∇b_i> (LoadOfGradients); no columns: s = 0
/// @param multigrid  of λM + L, built with the same λ
/// Columns may have any size in the range of numbers, because they are scaled by powers of two.
/// Same bits for any number of threads. Collective; progress is aborted for all processes or none.
/// Shared rows of the integrals are complete in all processes. Each process reports the largest
/// error at its own points.
PoissonSolution SolvePoisson(const SpaceLevels& space, const Multigrid& multigrid,
  const MultiVector& values, const MultiVector& gradients, const PoissonOptions& options,
  const Progress& progress = {});

} // namespace gridfem

#endif
