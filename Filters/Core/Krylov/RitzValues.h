// Estimates of the spectrum of the preconditioned operator, a by-product of conjugate gradients.
#ifndef GridFEM_RitzValues_h
#define GridFEM_RitzValues_h

#include "Krylov/LinearOperator.h"

#include <vector>

namespace gridfem
{

/// The tridiagonal matrix of the Lanczos method for B A, for each right-hand side. It follows from
/// the coefficients of conjugate gradients. Its eigenvalues are the Ritz values. The smallest one
/// approaches from above the smallest eigenvalue of B A that the right-hand side excites.
/// Saad: Iterative Methods for Sparse Linear Systems, section 6.7.3.
class RitzValues
{
public:
  explicit RitzValues(Id columns) : matrices_(columns) {}

  /// Adds α of the next step. Columns with α = 0 have made no step.
  void AddStep(const Columns& step);

  /// Adds β, the factor of the old direction in the next one. Each call follows a call of AddStep.
  void AddFactor(const Columns& factor);

  /// NaN before the first step.
  Columns Smallest() const;

private:
  struct Tridiagonal
  {
    std::vector<double> diagonal;
    std::vector<double> offDiagonal; // as long as `diagonal` after AddFactor
    double lastStep = 0.0;
    double lastFactor = 0.0;
  };
  std::vector<Tridiagonal> matrices_;
};

} // namespace gridfem

#endif
