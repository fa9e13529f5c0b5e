// Waves on a surface: M u'' + d M u' + c² L u = 0, with a little of L in M (MassSmoothing).
#ifndef GridFEM_DampedWave_h
#define GridFEM_DampedWave_h

#include "Equations/Evolution.h"

#include <memory>

namespace gridfem
{

struct WaveTerms
{
  double speed = 1.0;   // c > 0, units of length of the space per time
  double damping = 0.0; // d >= 0, per time
};

/// Newmark's method with β = 1/4 and γ = 1/2, which is the trapezoidal rule for (u, u'). The order
/// is 2. Any step is stable, and without damping the energy stays. Each step
/// solves for w = (u' + next u') / 2. Boundaries are free and reflect. [Newmark: A method of
/// computation for structural dynamics, 1959]
class DampedWave : public Evolution
{
public:
  /// @param step  > 0
  /// Throws InvalidInput unless all numbers are finite and in their range, and Aborted.
  DampedWave(std::shared_ptr<const SpaceLevels> space, const WaveTerms& terms,
    const EquationOptions& equation, double step, const Job& job = {});

  /// @param coefficients  column 0: u, column 1: u'
  void Start(MultiVector coefficients) override;
  SolveReport Advance(const Job& job) override;
  const MultiVector& Coefficients() const override { return now_; }

  /// (∫ u'² + MassSmoothing |∇u'|² + c² |∇u|²) / 2
  double Energy(const Job& job) const override;

private:
  std::shared_ptr<const SpaceLevels> space_;
  WaveTerms terms_;
  EquationOptions equation_;
  double step_ = 0.0;
  double weight_ = 0.0; // of M beside L, when M + MassSmoothing L is the mass
  double share_ = 1.0;  // of the stiffness in the matrix that MassSmoothing leaves
  SparseMatrix mass_;
  SparseMatrix stiffness_;
  std::unique_ptr<const Multigrid> multigrid_; // of weight M + L
  MultiVector now_;
  MultiVector mean_;       // w of the step before; no rows before the first step
  MultiVector meanBefore_; // of the step before that
};

} // namespace gridfem

#endif
