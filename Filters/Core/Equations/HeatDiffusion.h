// Heat that spreads over a surface in time: M u' = s - L u, step by step. [DESIGN §3]
#ifndef GridFEM_HeatDiffusion_h
#define GridFEM_HeatDiffusion_h

#include "Algebra/SparseCholesky.h"
#include "Equations/EdgeConditions.h"
#include "Equations/PointConstraints.h"
#include "Equations/Poisson.h"

#include <memory>

namespace gridfem
{

enum class TimeScheme
{
  BackwardEuler = 0, // first order; overshoots only where the space does, below a cell
  SecondOrder = 1    // SDIRK2 after a first step that damps, see HeatDiffusion
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
  /// For many fields: the matrix is also factored, unless it is large or values are held.
  bool isFactored = false;
};

/// How the solves of a step are made.
enum class HeatSolves
{
  ByIteration,
  ByFactor // of the matrix: exact but for rounding, without estimated errors
};

/// The equation (M + γδ L) U = load of steps of one length, with its hierarchy. It serves any
/// number of fields, one after the other.
class HeatEquation
{
public:
  /// @param held  where values are kept constant; no rows: nowhere
  /// Throws InvalidInput when the time step is not a positive number, and Aborted. Collective.
  HeatEquation(std::shared_ptr<const SpaceLevels> space, const DiffusionOptions& options,
    HeldRows held = {}, const Job& job = {});

  const SpaceLevels& Space() const { return *space_; }
  TimeScheme Scheme() const { return options_.scheme; }

  /// γδ
  double StageStep() const { return stageStep_; }

  /// @param heldValues  a row for each held row, columns as the load's
  /// @param met         how the held values are met, without coefficients and report
  PoissonSolution Solve(const MultiVector& load, const MultiVector& heldValues,
    ConstrainedSolution& met, const Job& job) const;

  /// Whether the matrix has a factor. It has none if it is not positive definite to rounding.
  bool IsFactored() const { return factor_ != nullptr; }

  /// The same by the factor. Iterates if the residual shows that the factor does not suffice.
  PoissonSolution SolveByFactor(const MultiVector& load, const Job& job) const;

  /// Returns ∫ u b_i for the function u with these coefficients.
  MultiVector IntegralsOf(const MultiVector& coefficients, const Job& job) const;

  /// Throws InvalidInput when rows or columns do not fit.
  void Require(
    const MultiVector& start, const MultiVector& sources, const MultiVector& heldValues) const;

private:
  std::shared_ptr<const SpaceLevels> space_;
  DiffusionOptions options_;
  double stageStep_ = 0.0;
  Index heldRows_ = 0; // in this process
  SparseMatrix mass_;
  // One of the two exists: the hierarchy of M / (γδ) + L, or that with the penalties of held
  // values.
  std::unique_ptr<Multigrid> multigrid_;
  std::unique_ptr<const SparseCholesky> factor_; // null: none
  std::unique_ptr<ConstrainedHierarchy> constrained_;
};

/// Steps (M + γδ L) U = ..., all with one matrix. No heat flows over boundaries, so only the
/// sources change the integral over a connected component. With held values, heat enters and leaves
/// there. Collective. Same bits for any number of threads.
///
/// The second order scheme has γ = 1 - 1/√2. The first step makes three steps of Backward Euler of
/// length γδ, and follows the line through the last two of them to δ. It multiplies a mode of
/// eigenvalue z / δ by (1 - (1 - 3γ) z) / (1 + γz)³. On a plane the heat of a point stays positive,
/// and at the point itself it is exact. Each later step is SDIRK2, with the factor
/// (1 - (1 - 2γ) z) / (1 + γz)². This factor falls to -0.21, so that it must not come first.
/// The first factor is off by 0.12 z² for small z, so the order is 2. It is off by at most 0.055
/// for any z, and at least -0.0053. Alexander: Diagonally Implicit Runge-Kutta Methods for Stiff
/// O.D.E.'s, 1977. Rannacher: Finite Element Solution of Diffusion Problems with Irregular Data,
/// 1984 (the damping first steps).
class HeatDiffusion
{
public:
  /// @param start       ∫ f b_i of the field at time 0 (LoadOfValues)
  /// @param sources     ∫ s b_i of the heat added per unit of time, as many columns; no rows: none
  /// @param heldValues  a row for each held row of the equation, as many columns
  /// @param solves      ByFactor needs an equation that IsFactored
  /// Throws InvalidInput when shapes do not fit.
  HeatDiffusion(std::shared_ptr<const HeatEquation> equation, MultiVector start,
    MultiVector sources = {}, MultiVector heldValues = {},
    HeatSolves solves = HeatSolves::ByIteration);

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
  std::shared_ptr<const HeatEquation> equation_;
  HeatSolves solves_;
  bool hasStarted_ = false;
  ConstrainedSolution met_;
  MultiVector load_; // ∫ u b_i at the current time
  MultiVector sources_;
  MultiVector heldValues_;
  MultiVector coefficients_;
  SolutionAccuracy accuracy_;
};

} // namespace gridfem

#endif
