// Solves the screened Poisson equation of a surface if some values are unknown, count differently,
// or are held exactly.
#ifndef GridFEM_ConstrainedEquation_h
#define GridFEM_ConstrainedEquation_h

#include "Equations/EdgeConditions.h"
#include "Equations/PartialField.h"
#include "Equations/PointConstraints.h"
#include "Solvers/PoissonEquation.h"

#include <functional>
#include <memory>
#include <string>

namespace gridfem
{

/// The known values and the gradients.
struct ConstrainedLoad
{
  PartialField field;
  bool isWeighted = true; // false: all processes know all values, which count 1
  MultiVector gradients;  // may have no rows
  MultiVector flux;       // boundary integrals; may have no rows
  HeldValues held;        // values that the solution has exactly
  std::string warning;    // about the input; may be empty
};

/// Repeats a stage only when something it depends on has changed. Collective.
class ConstrainedEquation
{
public:
  using Integrate = std::function<ConstrainedLoad(const Job&)>;

  /// Works as PoissonEquation::Update. The request's weight and scale of the gradients count.
  /// Throws InvalidInput if some weights are too large beside the others.
  void Update(const Surface& surface, const StageKey& fields, const Integrate& integrate,
    const PoissonRequest& request, EquationOptions options, const Progress& progress);

  /// The solution. It is NaN on components where nothing is known.
  const MultiVector& Coefficients() const { return solution_.coefficients; }

  /// The largest difference from a value that is to be held.
  double Misfit() const { return solution_.misfit; }

  const SolveReport& Report() const { return solution_.report; }
  const SolutionAccuracy& Accuracy() const { return solution_.accuracy; }

  /// The warning about the last update. Empty if there is none.
  /// @param tolerance  the tolerance of the update
  std::string Warning(double tolerance) const;

private:
  MultiVector BalancedFlux(const Surface& surface, double weight);
  void RequireResolvable(double weight) const;
  void UpdateSystem(
    const Surface& surface, StageKey fields, const Integrate& integrate, const Progress& progress);
  void Solve(const Surface& surface, const PoissonRequest& request, const EquationOptions& options,
    const Progress& progress);

  ConstrainedLoad load_;
  MultiVector values_;         // ∫ w f b_i
  MultiVector meanOfField_;    // mean of each component
  double largestWeight_ = 0.0; // of a triangle
  double leastWeight_ = 0.0;
  std::shared_ptr<const SurfaceSpace> weighted_;    // space with the mass of known values
  std::unique_ptr<ConstrainedHierarchy> hierarchy_; // refers to it
  ConstrainedSolution solution_;
  Id unbalanced_ = 0; // free components whose flux does not add up to 0
};

} // namespace gridfem

#endif
