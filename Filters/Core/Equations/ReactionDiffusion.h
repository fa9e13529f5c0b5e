// Species that spread over a surface, react at every place, and may be carried along:
// M u' = M R(u) + T(u) - D L u, with a little of L in M.
#ifndef GridFEM_ReactionDiffusion_h
#define GridFEM_ReactionDiffusion_h

#include "Equations/Evolution.h"
#include "Equations/Reactions.h"

#include <functional>
#include <memory>
#include <vector>

namespace gridfem
{

struct ReactionTerms
{
  std::vector<double> diffusion; // D >= 0 of each species, squared units of length of the space

  ReactionRates react; // null: no reactions

  /// Returns ∫ <u w, ∇b_i> for a velocity w; null: nothing is carried along. A species that is
  /// carried along needs a diffusion above 0.
  std::function<MultiVector(const MultiVector& coefficients, const Job& job)> carry;
};

/// The spread is implicit, by BDF2. Reactions and transport are explicit, by extrapolation from the
/// two steps before (SBDF2). The order in time is 2. The first step is the mean of one and two
/// steps of Euler's method (the spread implicit) of 2/3 of the length. They have the same matrix,
/// and damp all details. [Ascher, Ruuth and Wetton: Implicit-explicit methods for time-dependent
/// partial differential equations, 1995; Ruuth 1995 (SBDF2 for patterns)]
///
/// Reactions act on values at samples of the surface (SampledFunctions). A coefficient whose grid
/// function hardly reaches the surface has hardly a part in them, and so cannot grow without bound.
///
/// Nothing flows over boundaries. Without reactions the integral of each species stays.
class ReactionDiffusion : public Evolution
{
public:
  /// @param step  > 0
  /// Throws InvalidInput unless all numbers are finite and in their range, and Aborted.
  ReactionDiffusion(std::shared_ptr<const FiniteElementSpace> space, ReactionTerms terms,
    const EquationOptions& equation, double step, const Job& job = {});

  void Start(MultiVector coefficients) override;
  SolveReport Advance(const Job& job) override;
  const MultiVector& Coefficients() const override { return now_; }
  Columns ExtrapolationErrors() const override { return errors_; }
  Columns LargestValues() const override { return largest_; }
  double Energy(const Job& job) const override;

private:
  struct Rates
  {
    MultiVector load; // integrals of reactions and transport
    Columns largest;  // absolute value of each species
  };

  Rates ExplicitPart(const MultiVector& coefficients, const Job& job) const;
  MultiVector SolveSpecies(const MultiVector& known, const MultiVector& explicitPart,
    const MultiVector& guess, SolveReport& report, const Job& job) const;
  MultiVector FirstStep(Columns& errors, SolveReport& report, const Job& job) const;
  Columns ErrorsOf(const MultiVector& extrapolated, const MultiVector& computed) const;

  std::shared_ptr<const FiniteElementSpace> space_;
  ReactionTerms terms_;
  EquationOptions equation_;
  double stage_ = 0.0;     // 2/3 of the step
  double smoothing_ = 0.0; // MassSmoothing
  SparseMatrix mass_;
  SampledFunctions samples_;
  /// Hierarchies for the mass and the spread of each species; null without diffusion, shared for
  /// equal ones.
  std::vector<std::shared_ptr<const Multigrid>> multigrid_;

  MultiVector now_;
  MultiVector before_;         // one step ago; no rows before the first step
  MultiVector twoBefore_;      // two steps ago; no rows before the second step
  Rates explicitNow_;          // of now_; no rows at the start
  MultiVector explicitBefore_; // of before_
  Columns errors_;             // of the last step
  Columns largest_;            // during the last step
};

} // namespace gridfem

#endif
