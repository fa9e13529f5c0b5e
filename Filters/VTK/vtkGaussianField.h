/**
 * @class   vtkGaussianField
 * @brief   random fields on a surface whose values are alike at nearby points
 *
 * Samples Gaussian random fields with mean 0 and Matérn covariance. Each field u solves
 *
 *     (k² - Δ)^((n + 1) / 2) u = W
 *
 * on the surface. W is white noise, n is the Smoothness, and k is sqrt(8 n) / Range. On a plane,
 * values at the distance Range have a correlation of about 0.14. Distances are along the surface.
 * At a boundary the normal derivative is 0. Within about one Range of the boundary, the variance is
 * therefore larger: twice as large on edges, and four times as large in corners.
 *
 * Samples depend on Seed and on the functions. They do not depend on the number of threads. A
 * larger NumberOfSamples adds samples, and the first ones stay the same up to rounding.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis.
 * Input port 1 (optional): the output of vtkConnectivityAwareBasis for the mesh of port 0.
 *
 * Output port 0 (vtkPolyData): the input with the following arrays.
 * - point data, double: `Sample000`, `Sample001` ..., one array for each sample.
 * - point data, double, with Statistics instead: `SampleMean` and `SampleStandardDeviation`.
 * - field data, of the worst solve: `Converged`, `Iterations`, `DoublePrecisionSince`, `Residual`
 *   and `ConvergenceFactor`. Values are NaN at points that no polygon uses.
 *
 * Tolerance is 1e-6 and NormalStabilization 1e-2 by default. The filter uses all shared properties.
 * Range is in the unit of length of ParameterUnits. On several MPI ranks the surface is gathered.
 */
#ifndef vtkGaussianField_h
#define vtkGaussianField_h

#include "vtkSurfaceFEMAlgorithm.h"

class VTKGRIDFEMFILTERS_EXPORT vtkGaussianField : public vtkSurfaceFEMAlgorithm
{
public:
  static vtkGaussianField* New();
  vtkTypeMacro(vtkGaussianField, vtkSurfaceFEMAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The distance at which the correlation has fallen to about 0.14, in the unit of length of
   * ParameterUnits. Above 0, default 0.2.
   */
  vtkSetMacro(Range, double);
  vtkGetMacro(Range, double);
  ///@}

  ///@{
  /**
   * How smooth the samples are: the parameter of the Matérn covariance. 1 gives rough samples. Each
   * step up makes them smoother. 1..3, default 2.
   */
  vtkSetClampMacro(Smoothness, int, 1, 3);
  vtkGetMacro(Smoothness, int);
  ///@}

  ///@{
  /**
   * The standard deviation of the values at a point. 0 or more, default 1.
   */
  vtkSetMacro(StandardDeviation, double);
  vtkGetMacro(StandardDeviation, double);
  ///@}

  ///@{
  /**
   * The seed of the random numbers. 0 or more, default 1.
   */
  vtkSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * The number of samples to compute. 1..100000, default 1.
   */
  vtkSetClampMacro(NumberOfSamples, int, 1, 100000);
  vtkGetMacro(NumberOfSamples, int);
  ///@}

  ///@{
  /**
   * When on, the output has the mean and the standard deviation of the samples at every point,
   * instead of the samples. This needs at least two samples. Default off.
   */
  vtkSetMacro(Statistics, bool);
  vtkGetMacro(Statistics, bool);
  vtkBooleanMacro(Statistics, bool);
  ///@}

  /**
   * The input of port 1: the basis.
   */
  void SetBasisConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }

protected:
  vtkGaussianField();
  ~vtkGaussianField() override;

  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  void FreeStages() override;

  double Range = 0.2;
  int Smoothness = 2;
  double StandardDeviation = 1.0;
  int Seed = 1;
  int NumberOfSamples = 1;
  bool Statistics = false;

private:
  vtkGaussianField(const vtkGaussianField&) = delete;
  void operator=(const vtkGaussianField&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
