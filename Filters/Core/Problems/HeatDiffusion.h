// Heat that spreads over a surface in time: M u' = s - L u, step by step. [DESIGN §3]
#ifndef GridFEM_HeatDiffusion_h
#define GridFEM_HeatDiffusion_h

#include "Problems/EdgeConditions.h"
#include "Problems/PointConstraints.h"
#include "Problems/Poisson.h"

#include <memory>

namespace gridfem
{

enum class TimeScheme
{
  BackwardEuler = 0, // first order; values stay in range, up to the error of the space
  SecondOrder = 1    // two stages with one matrix (SDIRK2, γ = 1 - 1/√2), also L-stable
};

/// Tolerance of each solve when there are several steps. Errors add up over the steps, while an
/// accuracy applies to one step alone. With an accuracy of a thirtieth of the space's error per
/// step, a hundred steps added an error as large as the space's own (raptor, depth 7).
inline constexpr double ToleranceOfSteps = 1e-6;

/// With held values, errors are only estimated.
struct DiffusionOptions : EquationOptions
{
  double timeStep = 1.0; // δ > 0, squared units of length of the space
  TimeScheme scheme = TimeScheme::SecondOrder;
  HeldValues held; // values that are kept constant, columns as the start's; no rows: none
};

/// Steps (M + γδ L) U = ..., all with one matrix. No heat flows over boundaries, so only the
/// sources change the integral over a connected component. With held values, heat enters and leaves
/// there. Collective. Same bits for any number of threads.
/// Alexander: Diagonally Implicit Runge-Kutta Methods for Stiff O.D.E.'s, 1977.
class HeatDiffusion
{
public:
  /// @param start    ∫ f b_i of the field at time 0 (LoadOfValues)
  /// @param sources  ∫ s b_i of the heat added per unit of time, as many columns; no rows: none
  /// Throws InvalidInput when the time step is not a positive number or shapes do not fit, and
  /// Aborted.
  HeatDiffusion(std::shared_ptr<const SpaceLevels> space, MultiVector start, MultiVector sources,
    DiffusionOptions options, const Job& job = {});

  /// Makes the next step and reports how its solves went. Throws Aborted and then leaves the state
  /// as it was.
  SolveReport Advance(const Job& job = {});

  /// The worst errors of the last step's solves.
  const SolutionAccuracy& Accuracy() const { return accuracy_; }

  /// How the last solve met the held values, without coefficients and report.
  const ConstrainedSolution& Held() const { return met_; }

  /// Coefficients after the last step: rows = functions, columns as the start's. No rows before the
  /// first step.
  const MultiVector& Coefficients() const { return coefficients_; }

private:
  PoissonSolution Solve(const MultiVector& load, const Job& job);
  MultiVector IntegralsOf(const MultiVector& coefficients, const Job& job) const;

  std::shared_ptr<const SpaceLevels> space_;
  DiffusionOptions options_;
  double stageStep_ = 0.0; // γδ
  SparseMatrix mass_;
  // One of the two exists: the hierarchy of M / (γδ) + L, or that with the penalties of held
  // values.
  std::unique_ptr<Multigrid> multigrid_;
  std::unique_ptr<ConstrainedHierarchy> constrained_;
  ConstrainedSolution met_;
  MultiVector load_; // ∫ u b_i at the current time
  MultiVector sources_;
  MultiVector coefficients_;
  SolutionAccuracy accuracy_;
};

} // namespace gridfem

#endif
