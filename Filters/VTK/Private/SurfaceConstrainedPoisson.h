// The screened Poisson equation of a filter's surface where not all values are known or count the
// same, or some are held exactly, with its stages.
#ifndef GridFEM_SurfaceConstrainedPoisson_h
#define GridFEM_SurfaceConstrainedPoisson_h

#include "GivenValues.h"
#include "SurfacePoisson.h"

#include "Problems/EdgeConditions.h"
#include "Problems/PartialField.h"
#include "Problems/PointConstraints.h"

#include <functional>
#include <memory>

namespace gridfem
{

/// What is known, and the gradients.
struct ConstrainedLoad
{
  PartialField field;
  bool isWeighed = true; // else all is known and counts 1, on all ranks
  MultiVector gradients; // may have no rows
  MultiVector flux;      // integrals over the boundary; may have no rows
  HeldValues held;       // what the solution has exactly
  std::string warning;   // of what was given
};

class SurfaceConstrainedPoisson
{
public:
  using Integrate = std::function<ConstrainedLoad(const Job&)>;

  /// As SurfacePoisson::Update; of the request the weight and the scale of the gradients count.
  void Update(SurfaceSolverState& state, const StageKey& fields, const Integrate& integrate,
    const PoissonRequest& request, const Progress& progress);

  /// At the points of the mesh; NaN on components of which nothing is known.
  MultiVector Values(const SurfaceSolverState& state) const;

  /// The largest difference from a value that is to be held.
  double Misfit() const { return solution_.misfit; }

  const SolveReport& Report() const { return solution_.report; }
  const SolutionAccuracy& Accuracy() const { return solution_.accuracy; }

  /// What to warn of; empty when there is nothing.
  std::string Warning(double tolerance) const;

private:
  MultiVector BalancedFlux(const SurfaceSolverState& state, double weight);
  void UpdateSystem(SurfaceSolverState& state, StageKey fields, const Integrate& integrate,
    const Progress& progress);
  void Solve(SurfaceSolverState& state, const PoissonRequest& request, const Progress& progress);

  ConstrainedLoad load_;
  MultiVector values_;                              // ∫ w f b_i
  MultiVector meanOfField_;                         // of components
  std::shared_ptr<const SurfaceSpace> weighted_;    // the space with the mass of what is known
  std::unique_ptr<ConstrainedHierarchy> hierarchy_; // refers to it
  ConstrainedSolution solution_;
  Id unbalanced_ = 0; // components that nothing holds with a flux that does not add up to 0
};

} // namespace gridfem

#endif
