/**
 * @class   vtkScreenedPoisson
 * @brief   fit a function on a surface to values and gradients
 *
 * Finds the function u that minimises, over the surface, the integral of
 *
 *     w (u - f)^2 + |grad u - s g|^2
 *
 * with the values f, the gradients g, the ScreeningWeight w and the gradient scale s. Without
 * gradients it smooths f; with amplified gradients it sharpens f; with gradients from elsewhere it
 * stitches and fills. The gradients' part normal to the surface does not count. Nothing flows
 * across boundaries, unless a flux is given or values are held there. The solution keeps the mean
 * of f on every connected component, for every w.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis. Input port 1 (optional): the output of vtkConnectivityAwareBasis for
 * the mesh of port 0. Input port 2 (optional): vtkSelection of points or cells of port 0, where the
 * solution has the values exactly, as where the ConstraintArray is not 0; a cell takes its points.
 *
 * Arrays, of any numeric type, as point or cell data of input port 0, chosen by
 * SetInputArrayToProcess:
 * - index 0, `ValueArray`: f, any number of components C; without it f is the coordinates
 * - index 1, `GradientArray` (optional): g in world units, 3 C components: the three of the first
 *   component of f, then those of the second, ...
 * - index 2, `GradientScaleArray` (optional): one component, multiplies GradientScale
 * - index 3, `ValueWeightArray` (optional): one component, 0 or more, multiplies ScreeningWeight;
 * on points its mean over a triangle counts
 * - index 4, `ConstraintArray` (optional): point data, one component; where it is neither 0 nor NaN
 *   the solution has the value exactly, which must be point data then
 * - index 5, `MetricArray` (optional): a symmetric tensor, six components (XX, YY, ZZ, XY, YZ, XZ)
 *   or nine: the metric that all integrals, gradients and the area of ParameterUnits are taken in,
 *   as if the surface had been moved to where it has that metric; J^T J for a map with the Jacobian
 *   J. Only its part in the plane of each triangle counts, which must be positive definite; on
 *   points its mean over a triangle. g is the derivative of a function of the input then, as
 *   Surface Gradient gives it.
 * - index 6, `BoundaryFluxArray` (optional): point data, C components, in units of f over length:
 *   the slope of u out of the surface, less that of s g, at points of the boundary;
 *   not with a MetricArray
 *
 * With weights, constraints, a flux, BoundaryValues or FillUnknown, the mean is kept only on
 * connected components that neither a weight nor a constraint holds; the filter warns of those,
 * once.
 *
 * Output port 0 (vtkPolyData): the input with
 * - point data: `Solution` (C components, named as those of f; float if f or the coordinates that
 *   stand in for it are float, else double). Points that no polygon uses (with HatFunctions: none
 * with an area) keep f if that is a point array, else get 0.
 * - without a ValueArray: the points are at the solution, and have the point arrays `Displacement`
 *   and `NormalDisplacement`. Normals follow; clip, basis and modes of the old shape are left out.
 * - field data: `Converged` (int, 1), `Iterations` (int, 1), `UsedDepth` (int, 1), `Residual`
 * (double, 1): the norm of the residual vector relative to the right-hand side, which is not the
 * measure that Tolerance is on; `ConvergenceFactor` (double, 1): mean reduction of the energy
 * residual per iteration; `DoublePrecisionSince` (int, 1): the iteration after which the smoother
 * went on in double precision, because single precision was too slow or broke down; -1: never;
 *   the estimated errors of vtkPoissonAlgorithm, also with a Tolerance; with
 * ConstraintArray, a selection or BoundaryValues also `Misfit` (double, 1): the largest difference
 * from a value that is to be held
 *
 * Output port 1 (vtkTable): a row per iteration with `Iteration` (int), 0 being the start by nested
 * iteration; `EnergyResidual` (double): an estimate of the error in the energy norm, relative to
 * the solution's, and `Residual` (double, relative to the right-hand side), the largest over the
 * components; `ConvergenceFactor` (double): the energy residual over that of the row before;
 * `Log10EnergyResidual` and `Log10Residual`; `AlgebraicError`, what the correction of the row
 * leaves, `DiscretizationError`, and their logarithms. The result is one correction ahead of the
 * last row.
 *
 * The iteration ends by Accuracy. With a Tolerance above 0 (default 0) it ends by the energy
 * residual instead, for those who want the solution of the discrete equations itself. Weighed,
 * unknown and held values are solved for to a tolerance, 1e-6 where it is 0; their errors are
 * estimated as well, by the rate at which three levels differ, because a solution is not smooth
 * where a value is held.
 * MaximumIterations is 200 by default. All shared properties are used; with HatFunctions as
 * FunctionSpace, QuadratureDegree touches the preconditioner alone, because all integrals over hat
 * functions are exact.
 *
 * All ranks of MPI compute together. A WantedError, a metric, TrackMetric and
 * points that move are left to rank 0.
 */
#ifndef vtkScreenedPoisson_h
#define vtkScreenedPoisson_h

#include "vtkPoissonAlgorithm.h"

namespace gridfem
{
class SelectedPoints;
} // namespace gridfem

class VTKGRIDFEMFILTERS_EXPORT vtkScreenedPoisson : public vtkPoissonAlgorithm
{
public:
  static vtkScreenedPoisson* New();
  vtkTypeMacro(vtkScreenedPoisson, vtkPoissonAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How strongly the solution is held to the values; one over the squared length of ParameterUnits.
   * Features smaller than about 1 / sqrt(ScreeningWeight) follow the gradients. 0 or more, default
   * 100. A negative one is refused when the filter runs.
   */
  vtkSetMacro(ScreeningWeight, double);
  vtkGetMacro(ScreeningWeight, double);
  ///@}

  ///@{
  /**
   * Factor on the gradients: 0 smooths, 1 (default) keeps them, more than 1 sharpens.
   */
  vtkSetMacro(GradientScale, double);
  vtkGetMacro(GradientScale, double);
  ///@}

  ///@{
  /**
   * When on and no GradientArray is chosen, the gradients are those of the values, which must be
   * point data then. When off (default), no GradientArray means zero gradients.
   */
  vtkSetMacro(UseValueGradient, bool);
  vtkGetMacro(UseValueGradient, bool);
  vtkBooleanMacro(UseValueGradient, bool);
  ///@}

  ///@{
  /**
   * When on, and only points of the surface have moved since its functions were made, as in the
   * next time step of an animation, the functions stay: the grid, the clip and the patterns are
   * those of the surface seen first, and integrals are in the metric of where it is now. Faster
   * than to start again, as when cells have changed or a triangle has lost its area. The functions
   * move with the surface: they are as good as on the surface seen first where the motion bends,
   * and become poorer where it stretches one direction more than another; parts that come near to
   * each other later do not feel each other. So results depend, within the error of the space, on
   * the time step that was computed first, or at the last change of Depth and the like: the field
   * array `ReferenceTime` says which, where the input has times, and `LargestStretchRatio` how far
   * the map from there is from keeping angles, which is 1. Needs ReleaseDataFlagOff, the default,
   * and does not go with MetricArray or BoundaryFluxArray. Without effect with a WantedError.
   * Default off.
   */
  vtkSetMacro(TrackMetric, bool);
  vtkGetMacro(TrackMetric, bool);
  vtkBooleanMacro(TrackMetric, bool);
  ///@}

  ///@{
  /**
   * Above 0, Depth is chosen such that the estimated error of the function space, relative to the
   * solution without its mean, is at most this; the field array `UsedDepth` says which. Not used
   * with a given basis. The error of HatFunctions is that of the mesh: where it is too large, a
   * warning says so, as it does where the next depth does not fit into memory; `Converged` is 0
   * then. 0..0.5, default 0: Depth counts.
   */
  vtkSetClampMacro(WantedError, double, 0.0, 0.5);
  vtkGetMacro(WantedError, double);
  ///@}

  ///@{
  /**
   * When on, a tuple of values with a NaN is unknown, and so is a triangle with such a corner: the
   * solution fills it in, from the gradients and from around. When off (default), NaN is refused.
   */
  vtkSetMacro(FillUnknown, bool);
  vtkGetMacro(FillUnknown, bool);
  vtkBooleanMacro(FillUnknown, bool);
  ///@}

  ///@{
  /**
   * When on, the solution has the values f where the surface ends: along the edges of one triangle,
   * but for those with an unknown value. f must be point data then. Default off.
   */
  vtkSetMacro(BoundaryValues, bool);
  vtkGetMacro(BoundaryValues, bool);
  vtkBooleanMacro(BoundaryValues, bool);
  ///@}

  /**
   * The input of port 1: the basis.
   */
  void SetBasisConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }

  /**
   * The input of port 2: a selection of points that are held.
   */
  void SetSelectionConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(2, output); }

protected:
  vtkScreenedPoisson();
  ~vtkScreenedPoisson() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  bool NeedsWholeSurface() override;
  void FreeStages() override;

  double ScreeningWeight = 100.0;
  bool TrackMetric = false;
  double WantedError = 0.0;
  double GradientScale = 1.0;
  bool UseValueGradient = false;
  bool FillUnknown = false;
  bool BoundaryValues = false;

private:
  vtkScreenedPoisson(const vtkScreenedPoisson&) = delete;
  void operator=(const vtkScreenedPoisson&) = delete;

  void FindArrays();
  void RequireFluxFits() const;
  void WriteSolution(vtkPolyData* input, vtkPolyData* output);

  struct Internals;
  std::unique_ptr<Internals> Data;
  std::unique_ptr<gridfem::SelectedPoints> Selection;
};

#endif
