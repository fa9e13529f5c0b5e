/**
 * @class   vtkGaussianField
 * @brief   random fields on a surface whose values are alike at nearby points, and their prediction
 *          from observations (kriging)
 *
 * Samples Gaussian random fields with mean 0 and Matérn covariance. Each field u solves
 *
 *     (k² - Δ)^((n + 1) / 2) u = W
 *
 * on the surface. W is white noise, n is the Smoothness, and k is sqrt(8 n) / Range. On a plane,
 * values at the distance Range have a correlation of about 0.14. Distances are along the surface. A
 * Range above half of the square root of the area of a connected component makes the standard
 * deviation there larger than StandardDeviation, with a warning.
 * At a boundary the normal derivative is 0. Within about one Range of the boundary, the variance is
 * therefore larger: twice as large on edges, and four times as large in corners.
 *
 * Samples depend on Seed and on the functions. They do not depend on the number of threads. A
 * larger NumberOfSamples adds samples, and the first ones stay the same up to rounding.
 *
 * With observations, such as temperatures at stations, the filter predicts the field at every point
 * (kriging). The field then has a constant mean, which the filter finds, and the observations have
 * errors of the standard deviation ObservationNoise. Samples agree with the observations and show
 * what these leave open. There may be up to 4,000 observations. Each takes n + 1 solves, and eight
 * are solved together.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis.
 * Input port 1 (optional): the output of vtkConnectivityAwareBasis for the mesh of port 0.
 * Input port 2 (optional, `Observations`): any data set with points. Its values count at the
 * nearest point of the surface that a polygon uses.
 * Input port 3 (optional): vtkSelection of points or cells of port 0. A selected cell selects its
 * points.
 *
 * SetInputArrayToProcess chooses arrays of one component:
 * - index 0, `ObservationArray` (optional): point data of port 0. NaN is unknown. Without it and
 *   without port 2 there are no observations.
 * - index 1, `MaskArray` (optional): point data of port 0. Values are known where it is neither 0
 *   nor NaN. With a mask or a selection, only masked and selected points have known values.
 * - index 2 (optional): point data of port 2, if port 2 is connected. If none is chosen, the filter
 *   takes the array of port 2 with the name of ObservationArray, or the active scalars if
 *   ObservationArray is not chosen either. The MaskArray and the selection are not used then.
 *
 * Each point of port 2 is an observation with an error of its own, also if several have the same
 * nearest point. Values of the ObservationArray at coincident points are one observation, their
 * mean, if WeldCoincidentPoints is on. Without either, the observations are those of
 * AddObservation.
 *
 * Output port 0 (vtkPolyData): the input with the following arrays.
 * - point data, double: `Sample000`, `Sample001` ..., one array for each sample.
 * - point data, double, with Statistics instead: `SampleMean` and `SampleStandardDeviation`.
 * - with observations: point data, double: `Prediction`, the most likely field, and
 *   `LeaveOneOutError` at the observed points: observation minus its prediction from all others.
 *   It is the mean of several observations of a point, and NaN at other points. With Statistics,
 *   `PredictionStandardDeviation` is the standard deviation of the error of Prediction. It has a
 *   relative standard error of 1 / sqrt(2 NumberOfSamples).
 * - with observations: field data: `LeaveOneOutRatio` (double, 1), the root mean square of the
 *   errors divided by their expected standard deviation, and `LogLikelihood` (double, 1), the
 *   restricted likelihood of the observations. Good parameters give a ratio near 1 and a large
 *   likelihood.
 * - field data, of the worst solve: `Converged`, `Iterations`, `DoublePrecisionSince`, `Residual`
 *   and `ConvergenceFactor`. Values are NaN at points that no polygon uses.
 *
 * Tolerance is 1e-6 and NormalStabilization 1e-2 by default. The covariances of observations are
 * solved to a tolerance of at most 1e-9. The filter uses all shared properties; it refuses
 * FunctionSpace SmoothGrid. Range is in the unit of length of ParameterUnits. On several MPI ranks
 * the surface is gathered.
 */
#ifndef vtkGaussianField_h
#define vtkGaussianField_h

#include "vtkSurfaceFEMAlgorithm.h"

class vtkDataSet;

namespace gridfem
{
struct GivenConstraints;
} // namespace gridfem

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
  vtkSetInRangeMacro(Smoothness, int, 1, 3);
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
  vtkSetInRangeMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * The number of samples to compute. 1..100000, default 1.
   */
  vtkSetInRangeMacro(NumberOfSamples, int, 1, 100000);
  vtkGetMacro(NumberOfSamples, int);
  ///@}

  ///@{
  /**
   * When on, the output has the mean and the standard deviation of the samples at every point,
   * instead of the samples. With observations it has the standard deviation of the error of the
   * prediction. One sample then stands for 100. Default off.
   */
  vtkSetMacro(Statistics, bool);
  vtkGetMacro(Statistics, bool);
  vtkBooleanMacro(Statistics, bool);
  ///@}

  ///@{
  /**
   * The standard deviation of the errors of observations. 0 or more, default 0. The least that is
   * used is a thousandth of StandardDeviation.
   */
  vtkSetMacro(ObservationNoise, double);
  vtkGetMacro(ObservationNoise, double);
  ///@}

  ///@{
  /**
   * Observations by the ids of points. A point may have several. The filter refuses an id that no
   * polygon uses when it runs. None by default.
   */
  void AddObservation(vtkIdType point, double value);
  void ClearObservations();
  vtkIdType GetNumberOfObservations();
  ///@}

  /**
   * The input of port 2: points with observations.
   */
  void SetObservationsConnection(vtkAlgorithmOutput* output)
  {
    this->SetInputConnection(2, output);
  }

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
  double ObservationNoise = 0.0;

private:
  vtkGaussianField(const vtkGaussianField&) = delete;
  void operator=(const vtkGaussianField&) = delete;

  gridfem::GivenConstraints FindObservations(vtkDataSet* places);
  void WriteResult(vtkPolyData* output);

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
