/**
 * @class   vtkPoissonAlgorithm
 * @brief   base class of filters that solve Poisson equations to the accuracy of their space
 *
 * The error of the function space stays, no matter how long the solver iterates. The iteration
 * therefore ends when its own estimated error is at most Accuracy times the error of the space.
 * With a Tolerance above 0, it ends by the energy residual instead.
 *
 * Such filters add the following arrays to the field data of output port 0, besides `Converged`,
 * `Iterations`, `DoublePrecisionSince`, `Residual` and `ConvergenceFactor`.
 * - `DiscretizationError` (double, 1): the estimated error of the function space in the mean square
 *   over the surface, relative to the solution without its mean.
 * - `LargestDiscretizationError` (double, 1): the largest error at a point, in units of the
 *   solution.
 * - `AlgebraicError` (double, 1): the remaining error of the iteration, relative like
 *   `DiscretizationError`.
 * - `TrustedEstimate` (int, 1): 0 if the levels do not differ from each other as on a resolved
 *   surface. In this case `DiscretizationError` may be too small.
 *
 * With several components or solves, each value is the worst one. An unknown error, for example
 * without coarser levels, is NaN.
 */
#ifndef vtkPoissonAlgorithm_h
#define vtkPoissonAlgorithm_h

#include "vtkSurfaceFEMAlgorithm.h"

class VTKGRIDFEMFILTERS_EXPORT vtkPoissonAlgorithm : public vtkSurfaceFEMAlgorithm
{
public:
  vtkTypeMacro(vtkPoissonAlgorithm, vtkSurfaceFEMAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How exactly to solve the discrete equations. The iteration ends when its own estimated error is
   * this fraction of the error of the function space. The value is above 0 and at most 1, by
   * default 0.1. Used if Tolerance is 0. The estimates are in the field data.
   */
  vtkSetInRangeMacro(Accuracy, double, 1e-6, 1.0);
  vtkGetMacro(Accuracy, double);
  ///@}

  ///@{
  /**
   * The Tolerance of every solver may be 0 here. With 0 (default) Accuracy ends the iteration.
   */
  double GetToleranceMinValue() override { return 0.0; }
  ///@}

protected:
  vtkPoissonAlgorithm();
  ~vtkPoissonAlgorithm() override;

  double WantedAccuracy() const override { return this->Tolerance == 0.0 ? this->Accuracy : 0.0; }

  double Accuracy = 0.1;

private:
  vtkPoissonAlgorithm(const vtkPoissonAlgorithm&) = delete;
  void operator=(const vtkPoissonAlgorithm&) = delete;
};

#endif
