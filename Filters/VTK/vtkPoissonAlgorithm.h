/**
 * @class   vtkPoissonAlgorithm
 * @brief   base class of filters that solve Poisson equations to the accuracy of their space
 *
 * The iteration ends when its own error is estimated to be a part, Accuracy, of the error that the
 * function space has anyway. With a Tolerance above 0 it ends by the energy residual instead.
 *
 * Such filters add to the field data of output port 0, besides `Converged`, `Iterations`,
 * `DoublePrecisionSince`, `Residual` and `ConvergenceFactor`:
 * - `DiscretizationError` (double, 1): the estimated error of the function space, relative to the
 *   solution without its mean, in the mean square over the surface; `LargestDiscretizationError`
 *   (double, 1): the largest at a point, in units of the solution; `AlgebraicError` (double, 1):
 *   what the iteration has left, relative as the first. Of several components or solves the worst;
 *   not a number where nothing is known, as without coarser levels.
 * - `TrustedEstimate` (int, 1): 0 where levels do not differ as they do on a resolved surface: the
 *   first may be too small then.
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
   * How good the solution is to be as that of the discrete equations: the iteration ends when its
   * own error is estimated to be this part of the error that the function space has anyway. Above
   * 0, at most 1, default 0.1; used where Tolerance is 0. The estimates are in the field data.
   */
  vtkSetClampMacro(Accuracy, double, 1e-6, 1.0);
  vtkGetMacro(Accuracy, double);
  ///@}

  ///@{
  /**
   * As in every solver, but that 0 (default) is allowed: Accuracy decides then.
   */
  void SetTolerance(double tolerance) override;
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
