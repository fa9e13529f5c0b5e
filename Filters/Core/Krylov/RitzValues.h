// What conjugate gradients learn of the spectrum of the preconditioned operator on their way.
#ifndef GridFEM_RitzValues_h
#define GridFEM_RitzValues_h

#include "Krylov/LinearOperator.h"

#include <vector>

namespace gridfem
{

/// The tridiagonal matrix of the Lanczos method for B A, from the coefficients of conjugate
/// gradients, for each right-hand side. Its eigenvalues are Ritz values: those of B A are not
/// smaller than the smallest but for what the right-hand side does not excite.
/// Saad: Iterative Methods for Sparse Linear Systems, section 6.7.3.
class RitzValues
{
public:
  explicit RitzValues(Id columns) : matrices_(columns) {}

  /// α of the next step; columns with 0 stand still.
  void AddStep(const Columns& step);

  /// β, the factor of the direction before in the next one; follows a step.
  void AddFactor(const Columns& factor);

  /// Not a number before the first step.
  Columns Smallest() const;

private:
  struct Tridiagonal
  {
    std::vector<double> diagonal;
    std::vector<double> offDiagonal; // as long, after a factor
    double lastStep = 0.0;
    double lastFactor = 0.0;
  };
  std::vector<Tridiagonal> matrices_;
};

} // namespace gridfem

#endif
