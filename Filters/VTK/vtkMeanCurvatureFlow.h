/**
 * @class   vtkMeanCurvatureFlow
 * @brief   a surface that moves by its mean curvature, step by step
 *
 * Every step solves (M + δ L) X⁺ = M X for the coordinates X. M is the mass matrix and L the
 * stiffness matrix of the current surface, and δ is the TimeStep. The functions of the input stay.
 * Only the metric of their integrals follows the surface, so a step costs a fraction of a new
 * set-up. With Conformalized on, L stays the stiffness matrix of the input, and the map from the
 * input becomes nearly conformal.
 *
 * The area of the surface in its function space never grows, for any TimeStep, up to Tolerance and
 * without Rescale and FixedBoundary. The surface may, however, intersect itself. The ordinary flow
 * forms necks that become infinitely thin in finite time. Samples collapse and lock there, and the
 * flow may end with a warning. In practice, the conformalized flow of a closed surface without
 * handles ends as a sphere. Other surfaces do not become a sphere, and a warning says so.
 * Boundaries move freely, and open surfaces shrink, unless FixedBoundary makes a soap film of them.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis.
 * Input port 1 (optional): the output of vtkConnectivityAwareBasis for the mesh of port 0.
 *
 * Output port 0 (vtkPolyData): the input with moved points, in their precision (double when they
 * are integers), and the following arrays.
 * - point data, in the precision of the points: `Displacement` (3 components) from the input.
 * - point data, in the same precision: `ConformalFactor`, the ratio of the area around the point to
 *   its area in the input.
 * - point data, in the same precision: `QuasiConformalError`, the ratio of the larger to the
 *   smaller stretch of the map from the input. It is 1 where the map keeps angles, and at most 1e7.
 * - `ConformalFactor` and `QuasiConformalError` are means over the triangles around the point,
 *   weighted by their area in the input. They are 1 at points that no polygon uses, which do not
 *   move.
 * - The active point normals, if the input has some, become the normals of the moved surface.
 *   Normals at cells are left out.
 * - field data: `Step` (int, 1); `FlowTime` (double, 1; squared world length).
 * - field data: `Converged` (int, 1). It is 0 if this step or one before it has not converged, or
 *   if the flow has ended before NumberOfSteps.
 * - field data: `DiscretizationError` (double, 1), the estimated error of the function space in the
 *   displacement of this step, relative to the displacement.
 * - field data: `LargestDiscretizationError` (double, 1), the largest such error at a point, in
 *   world units.
 * - field data: `TrustedEstimate` (int, 1). It is 1 where the levels differ as they do on a grid
 *   that resolves the smoothing length of a step, the square root of TimeStep. Else it is 0.
 * - field data: `AlgebraicError`, which is NaN.
 *
 * The arrays of the clip and the basis, and `Eigenvalues`, belong to the input and are left out.
 *
 * Output port 1 (vtkTable) has a row per step, in world units. The input is step 0.
 * - `Step` (int), `Time`, `Area`, `Volume`. The volume of an open surface is the volume of the cone
 *   from the surface to its centroid.
 * - `Sphericity`: π^(1/3) (6 V)^(2/3) / A, 1 for a sphere.
 * - `QuasiConformalError`: the mean over the surface.
 * - `Iterations` (int).
 * - `LockedSamples` (int): samples with a singular metric at the start of the step, which
 *   contribute nothing.
 * - `DiscretizationError`, `Seconds`.
 *
 * Output port 2 (vtkTable) has the shown step and its sphericity as `Text`, in one row, for
 * ParaView's view.
 *
 * Time: every step is a time step, with its number as time value, from 0, the input. TimeFrom can
 * give the times of the input instead. A request without a time gets the last step. All steps are
 * computed once, and a larger NumberOfSteps continues. The filter keeps evenly spread steps within
 * a gigabyte, at 24 bytes for each function. It always keeps the last. To show another step, it
 * computes it again from the nearest kept step before, with the same bits.
 *
 * A step fails if the surface has vanished or a matrix is not positive. The flow then ends with a
 * warning, and later times show the last step. Tolerance (default 5e-4) is on the energy of a
 * step's error, relative to the energy of the shape. The filter uses all shared properties.
 * TimeStep is in the squared unit of length of ParameterUnits.
 */
#ifndef vtkMeanCurvatureFlow_h
#define vtkMeanCurvatureFlow_h

#include "vtkSurfaceFEMAlgorithm.h"

class VTKGRIDFEMFILTERS_EXPORT vtkMeanCurvatureFlow : public vtkSurfaceFEMAlgorithm
{
public:
  static vtkMeanCurvatureFlow* New();
  vtkTypeMacro(vtkMeanCurvatureFlow, vtkSurfaceFEMAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The length of a time step, in the squared unit of length of ParameterUnits. Above 0, default
   * 5e-5. Details as long as the square root of TimeStep fade to 2.5 % in one step. The flow is of
   * first order in TimeStep. To reach a sphere with Conformalized on, use ten times the default.
   */
  vtkSetMacro(TimeStep, double);
  vtkGetMacro(TimeStep, double);
  ///@}

  ///@{
  /**
   * The number of steps to compute. 1..100000, default 10. A larger number continues the flow. A
   * smaller number computes nothing.
   */
  vtkSetInRangeMacro(NumberOfSteps, int, 1, 100000);
  vtkGetMacro(NumberOfSteps, int);
  ///@}

  enum TimeFromType
  {
    Steps = 0,
    Input = 1
  };
  ///@{
  /**
   * The meaning of time. Steps (default): every step is a time step of the output, and the input
   * stays at one time. Input: the output has the times of the input, with the last step at each of
   * them.
   */
  vtkSetInRangeMacro(TimeFrom, int, Steps, Input);
  vtkGetMacro(TimeFrom, int);
  ///@}

  ///@{
  /**
   * When on, every step uses the stiffness matrix of the input. Necks do not form, and the map from
   * the input becomes nearly conformal. Needs TrackMetric. Default off.
   */
  vtkSetMacro(Conformalized, bool);
  vtkGetMacro(Conformalized, bool);
  vtkBooleanMacro(Conformalized, bool);
  ///@}

  ///@{
  /**
   * When on (default), the functions of the input are kept and only their metric follows the
   * surface. When off, the moved mesh is clipped again in every step, which takes longer.
   */
  vtkSetMacro(TrackMetric, bool);
  vtkGetMacro(TrackMetric, bool);
  vtkBooleanMacro(TrackMetric, bool);
  ///@}

  ///@{
  /**
   * When on, points of edges with one polygon stay. The surface tends to the soap film between its
   * boundaries. The functions themselves are drawn to the boundary, after Nitsche. They miss the
   * boundary by some hundredths of a cell at rest, and by more in steps that move the surface by
   * many cells. Excludes Conformalized and Rescale. Default off: boundaries move freely.
   */
  vtkSetMacro(FixedBoundary, bool);
  vtkGetMacro(FixedBoundary, bool);
  vtkBooleanMacro(FixedBoundary, bool);
  ///@}

  enum RescaleType
  {
    Automatic = 0,
    NoRescale = 1,
    ConstantArea = 2,
    ConstantVolume = 3
  };
  ///@{
  /**
   * The quantity that every step keeps by scaling about its centroid: none, the area of the input,
   * or its volume. Automatic (default) is ConstantArea with Conformalized, because the surface
   * would shrink to nothing. Otherwise it is NoRescale.
   */
  vtkSetInRangeMacro(Rescale, int, Automatic, ConstantVolume);
  vtkGetMacro(Rescale, int);
  ///@}

protected:
  vtkMeanCurvatureFlow();
  ~vtkMeanCurvatureFlow() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  std::vector<double> OwnTimeSteps() override;
  void FreeStages() override;
  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  double TimeStep = 5e-5;
  int NumberOfSteps = 10;
  int TimeFrom = Steps;
  bool Conformalized = false;
  bool TrackMetric = true;
  bool FixedBoundary = false;
  int Rescale = Automatic;

private:
  vtkMeanCurvatureFlow(const vtkMeanCurvatureFlow&) = delete;
  void operator=(const vtkMeanCurvatureFlow&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
