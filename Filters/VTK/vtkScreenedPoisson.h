/**
 * @class   vtkScreenedPoisson
 * @brief   fit a function on a surface to values and gradients
 *
 * Finds the function u that minimizes, over the surface, the integral of
 *
 *     w (u - f)² + |∇u - s g|²
 *
 * with the values f, the gradients g, the ScreeningWeight w and the gradient scale s. Without
 * gradients it smooths f. With amplified gradients it sharpens f. With gradients from elsewhere it
 * stitches and fills. The part of the gradients normal to the surface does not count. Nothing flows
 * across boundaries, unless a flux is given or values are held there. The solution keeps the mean
 * of f on every connected component, for every w.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis.
 * Input port 1 (optional): the output of vtkConnectivityAwareBasis for the mesh of port 0.
 * Input port 2 (optional): vtkSelection of points or cells of port 0. The solution has exactly the
 * given values there. A selected cell selects its points. The selection adds to the
 * ConstraintArray.
 *
 * Arrays are point or cell data of input port 0, of any numeric type. SetInputArrayToProcess
 * chooses them:
 * - index 0, `ValueArray`: f, with any number of components C. Without it f is the coordinates.
 * - index 1, `GradientArray` (optional): g in world units, 3 C components. The gradient of the
 *   first component of f comes first.
 * - index 2, `GradientScaleArray` (optional): one component, which multiplies GradientScale.
 * - index 3, `ValueWeightArray` (optional): one component, 0 or more, which multiplies
 *   ScreeningWeight. A triangle takes the mean of a point array. Values of weight 0 do not count.
 *   They may be any number or NaN. With UseValueGradient their gradients still count, unless they
 *   are NaN.
 * - index 4, `ConstraintArray` (optional): point data, one component. The solution has exactly the
 *   value f at points where the array is neither 0 nor NaN. The values must be point data in this
 *   case.
 * - index 5, `MetricArray` (optional): a symmetric tensor of six components (XX, YY, ZZ, XY, YZ,
 *   XZ) or nine. It is the metric of all integrals and gradients and of the area in ParameterUnits,
 *   as if the surface had been moved to a shape with this metric. For a map with the Jacobian J,
 *   use J^T J. Only the tensor's part in the plane of each triangle counts, and that part must be
 *   positive definite. A triangle takes the mean of a point array. With a metric, g is the
 *   derivative of a function on the input, as vtkSurfaceGradient computes it.
 * - index 6, `BoundaryFluxArray` (optional): point data, C components, in units of f over length.
 *   It is the outward slope of u minus the outward slope of s g, at points of the boundary. It
 *   cannot be combined with a MetricArray.
 *
 * With weights, constraints, a flux, BoundaryValues or FillUnknown, the mean is kept only on
 * connected components without a weight or constraint that holds them. The filter warns once about
 * such components.
 *
 * Output port 0 (vtkPolyData): the input with the following arrays.
 * - point data: `Solution` (C components with the names of the components of f). It is of bytes if
 *   f holds colors (three or four bytes). It is float if f, or the coordinates in its place, are
 *   float. Otherwise it is double.
 * - without a ValueArray: the points move to the solution and have the point arrays `Displacement`
 *   and `NormalDisplacement`. Normals follow. The clip, basis and modes of the old shape are left
 *   out.
 * - field data: `Converged` (int, 1), `Iterations` (int, 1), `UsedDepth` (int, 1).
 * - field data: `Residual` (double, 1), the norm of the residual vector relative to the right-hand
 *   side. Tolerance applies to the energy residual instead.
 * - field data: `ConvergenceFactor` (double, 1), the mean reduction of the energy residual per
 *   iteration.
 * - field data: `DoublePrecisionSince` (int, 1), the iteration after which the smoother used double
 *   precision, because single precision was too slow or broke down. -1 means never.
 * - field data: the estimated errors of vtkPoissonAlgorithm, also with a Tolerance.
 * - field data, with a ConstraintArray, a selection or BoundaryValues: `Misfit` (double, 1), the
 *   largest difference from a held value.
 *
 * Output port 1 (vtkTable) has a row per iteration. The result is one correction ahead of the last
 * row.
 * - `Iteration` (int): 0 is the start by nested iteration.
 * - `EnergyResidual` (double): an estimate of the error in the energy norm, relative to the energy
 *   norm of the solution. It is the largest value over the components.
 * - `Residual` (double): relative to the right-hand side, the largest over the components.
 * - `ConvergenceFactor` (double): the energy residual divided by the residual of the row before.
 * - `Log10EnergyResidual` and `Log10Residual`.
 * - `AlgebraicError`, the error that the correction of the row leaves, `DiscretizationError`, and
 *   the logarithms of both.
 *
 * The iteration ends by Accuracy. With a Tolerance above 0 (default 0) it ends by the energy
 * residual instead. Use it to solve the discrete equations themselves. Weighted, unknown and held
 * values are solved for to a tolerance, which is 1e-6 if the property is 0. The estimates of their
 * errors use the rate at which three levels differ, because a solution is not smooth where a value
 * is held.
 *
 * MaximumIterations is 200 by default. The filter uses all shared properties. With HatFunctions as
 * FunctionSpace, QuadratureDegree affects only the preconditioner, because all integrals over hat
 * functions are exact.
 *
 * All MPI ranks compute together. Rank 0 computes alone with a WantedError, a metric, TrackMetric
 * or points that move.
 */
#ifndef vtkScreenedPoisson_h
#define vtkScreenedPoisson_h

#include "vtkPoissonAlgorithm.h"

class VTKGRIDFEMFILTERS_EXPORT vtkScreenedPoisson : public vtkPoissonAlgorithm
{
public:
  static vtkScreenedPoisson* New();
  vtkTypeMacro(vtkScreenedPoisson, vtkPoissonAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How strongly the solution is held to the values, in one over the squared length of
   * ParameterUnits. Features smaller than about 1 / sqrt(ScreeningWeight) follow the gradients. 0
   * or more, default 100. The filter refuses a negative value when it runs.
   */
  vtkSetMacro(ScreeningWeight, double);
  vtkGetMacro(ScreeningWeight, double);
  ///@}

  ///@{
  /**
   * The factor on the gradients. 0 smooths, 1 (default) keeps the gradients, and more than 1
   * sharpens.
   */
  vtkSetMacro(GradientScale, double);
  vtkGetMacro(GradientScale, double);
  ///@}

  ///@{
  /**
   * When on and no GradientArray is chosen, the filter uses the gradients of the values, which must
   * be point data. When off (default), no GradientArray means zero gradients.
   */
  vtkSetMacro(UseValueGradient, bool);
  vtkGetMacro(UseValueGradient, bool);
  vtkBooleanMacro(UseValueGradient, bool);
  ///@}

  ///@{
  /**
   * When on, the functions stay as long as only points of the surface move, as in the next time
   * step of an animation. This is faster than starting again. The grid, the clip and the patterns
   * belong to the surface seen first, and integrals are in the metric of the current surface. The
   * filter starts again if cells have changed or a triangle has lost its area.
   *
   * The functions move with the surface. They stay as good as on the surface seen first if the
   * motion only bends the surface. They become poorer if the motion stretches one direction more
   * than another. Parts that come close to each other later do not interact.
   *
   * Results therefore depend, within the error of the space, on the time step that was computed
   * first. After a change of Depth or a similar property, the next step counts as the first. The
   * field array `ReferenceTime` names this time step if the input has times. The field array
   * `LargestStretchRatio` measures how much the motion since then changes angles; 1 means not at
   * all.
   *
   * Needs ReleaseDataFlagOff, the default, and excludes MetricArray and BoundaryFluxArray. It has
   * no effect with a WantedError. Default off.
   */
  vtkSetMacro(TrackMetric, bool);
  vtkGetMacro(TrackMetric, bool);
  vtkBooleanMacro(TrackMetric, bool);
  ///@}

  ///@{
  /**
   * The wanted error of the function space, relative to the solution without its mean. Above 0, the
   * filter chooses a depth at which the estimated error is at most this value. The error has to be
   * trusted, or small enough at two depths, one after the other. The field array `UsedDepth` gives
   * the depth. Not used with a given basis. The error of HatFunctions is the error of the mesh. If
   * the error stays too large, or the next depth does not fit into memory, the filter warns and
   * `Converged` is 0. 0..0.5, default 0: Depth is used.
   */
  vtkSetInRangeMacro(WantedError, double, 0.0, 0.5);
  vtkGetMacro(WantedError, double);
  ///@}

  ///@{
  /**
   * When on, a tuple of values with a NaN is unknown, and so is a triangle with such a corner. The
   * solution fills it in from the gradients and from the surroundings. When off (default), the
   * filter refuses NaN.
   */
  vtkSetMacro(FillUnknown, bool);
  vtkGetMacro(FillUnknown, bool);
  vtkBooleanMacro(FillUnknown, bool);
  ///@}

  ///@{
  /**
   * When on, the solution has the values f along the boundary, except at unknown values. The
   * boundary consists of the edges with one triangle. f must be point data in this case. Default
   * off.
   */
  vtkSetMacro(BoundaryValues, bool);
  vtkGetMacro(BoundaryValues, bool);
  vtkBooleanMacro(BoundaryValues, bool);
  ///@}

  ///@{
  /**
   * Further arrays that are solved for together with the array of index 0, and in the same way.
   * They are of points if this array is, else of cells. The result of each has the name of the
   * array before its name, as in `Thickness_Solution`. All errors, and all other numbers in the
   * field data, are then the worst of all arrays. None by default.
   */
  void AddFurtherArray(const char* name);
  void ClearFurtherArrays();
  ///@}

protected:
  vtkScreenedPoisson();
  ~vtkScreenedPoisson() override;

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
};

#endif
