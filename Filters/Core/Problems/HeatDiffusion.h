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
  BackwardEuler = 0, // of first order; values stay in the range of the start but for the space
  SecondOrder = 1    // two stages with one matrix (SDIRK2, γ = 1 - 1/√2), L-stable, too
};

/// What each of several steps is solved to. Their errors add up, so that an accuracy is for one
/// step alone: after a hundred, each of which left a thirtieth of the error of the space at most,
/// as much was left as the space itself leaves (raptor, depth 7).
inline constexpr double ToleranceOfSteps = 1e-6;

/// Where values are held, errors are only estimated.
struct DiffusionOptions : EquationOptions
{
  double timeStep = 1.0; // δ > 0, squared units of length of the space
  TimeScheme scheme = TimeScheme::SecondOrder;
  HeldValues held; // values that stay as they are, columns as the start's; no rows: none
};

/// Steps (M + γδ L) U = ..., all with one matrix. No heat flows over boundaries, so that the
/// integral over every connected component changes by that of the sources alone; unless values are
/// held, where heat comes and goes. Same bits for any number of threads. Where processes hold the
/// surface together, all of them call all, as SolvePoisson and SolveConstrained.
/// Alexander: Diagonally Implicit Runge-Kutta Methods for Stiff O.D.E.'s, 1977.
class HeatDiffusion
{
public:
  /// @param start    ∫ f b_i of the field at time 0 (LoadOfValues)
  /// @param sources  ∫ s b_i of what is added per unit of time, with as many columns; no rows: none
  /// Throws InvalidInput when the time step is not a positive number or shapes do not fit, and
  /// Aborted.
  HeatDiffusion(std::shared_ptr<const SpaceLevels> space, MultiVector start, MultiVector sources,
    DiffusionOptions options, const Job& job = {});

  /// Makes the next step and says how its solves went. Aborted, which it throws, leaves the state
  /// as it was.
  SolveReport Advance(const Job& job = {});

  /// Errors of the solves of the last step, the worst of them.
  const SolutionAccuracy& Accuracy() const { return accuracy_; }

  /// How the last solve met what is held: without coefficients and report.
  const ConstrainedSolution& Held() const { return met_; }

  /// After the last step: rows = functions, columns as the start's. No rows before the first.
  const MultiVector& Coefficients() const { return coefficients_; }

private:
  PoissonSolution Solve(const MultiVector& load, const Job& job);
  MultiVector IntegralsOf(const MultiVector& coefficients, const Job& job) const;

  std::shared_ptr<const SpaceLevels> space_;
  DiffusionOptions options_;
  double stageStep_ = 0.0; // γδ
  SparseMatrix mass_;
  // One of them: of M / (γδ) + L, and with the penalties of what is held.
  std::unique_ptr<Multigrid> multigrid_;
  std::unique_ptr<ConstrainedHierarchy> constrained_;
  ConstrainedSolution met_;
  MultiVector load_; // ∫ u b_i now
  MultiVector sources_;
  MultiVector coefficients_;
  SolutionAccuracy accuracy_;
};

} // namespace gridfem

#endif
