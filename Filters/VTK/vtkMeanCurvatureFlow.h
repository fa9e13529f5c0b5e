/**
 * @class   vtkMeanCurvatureFlow
 * @brief   a surface that moves by its mean curvature, step by step
 *
 * Every step solves (M + d L) X+ = M X for the coordinates X, with the mass M and the stiffness L
 * of the surface as it is, and the TimeStep d. The functions are those of the input; only the
 * metric that they are integrated in follows the surface, so that a step costs a fraction of a new
 * set-up. With Conformalized on L stays that of the input, and the map from the input tends to a
 * conformal one.
 *
 * What the flow guarantees: the area of the surface in its function space never grows, for any
 * TimeStep (without Rescale and FixedBoundary, up to Tolerance). What it does not: the surface may
 * intersect itself. The ordinary flow forms necks that become infinitely thin in finite time; there
 * its samples lock, and it may end with a warning. The conformalised flow of a closed surface
 * without handles ends as a sphere, in practice; other surfaces do not, and a warning says so.
 * Boundaries move freely, and open surfaces shrink, unless FixedBoundary makes a soap film of them.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis. Input port 1 (optional): the output of vtkConnectivityAwareBasis for
 * the mesh of port 0.
 *
 * Output port 0 (vtkPolyData): the input with moved points, in their precision (double when they
 * are integers), and
 * - point data, in the precision of the points: `Displacement` (3 components) from the input;
 *   `ConformalFactor`: the area around the point over what it was; `QuasiConformalError`: the
 *   larger over the smaller stretch of the map from the input, 1 where it keeps angles, at most
 *   1e7. The last two are means over the triangles around the point, weighted by their area in the
 *   input; 1 at points that no polygon uses, which do not move. The active normals, if the input
 *   has some at points, are those of the moved surface; those at cells are left out.
 * - field data: `Step` (int, 1), `FlowTime` (double, 1; squared world length), `Converged` (int,
 *   1): 0 when this step or one before it has not converged, or the flow has ended before
 *   NumberOfSteps; `DiscretizationError` (double, 1): the estimated error of the function space in
 *   the way of this step, relative to its length; `LargestDiscretizationError` (double, 1): at a
 *   point, in world units; `TrustedEstimate` (int, 1): 0 where the levels do not differ as they do
 *   where the grid resolves how far a step smooths, the root of TimeStep; `AlgebraicError`: not a
 *   number
 *
 * The arrays of the clip and the basis, and `Eigenvalues`, belong to the input and do not come out.
 *
 * Output port 1 (vtkTable): a row per step, the input being step 0, with `Step` (int), `Time`,
 * `Area`, `Volume` (of the cone to the centroid, when open), `Sphericity` (π^(1/3) (6 V)^(2/3) / A,
 * 1 for a sphere), `QuasiConformalError` (mean over the surface), `Iterations` (int),
 * `LockedSamples` (int; samples with a singular metric when the step began, which contribute
 * nothing), `DiscretizationError`, `Seconds`; world units.
 *
 * Time: every step is a time step, with its number as time value, from 0, the input. A request
 * without a time gets the last step. All steps are made once; a change of NumberOfSteps continues.
 * Steps are kept within a gigabyte, evenly spread, at 24 bytes for each function; the last is
 * always kept. The others are made again from the nearest kept step before them when they are
 * shown, with the same bits.
 *
 * A step that cannot be made (the surface has vanished, a matrix is not positive) ends the flow
 * with a warning; later times show the last step. Tolerance (default 5e-4) is on the energy of a
 * step's error, relative to the shape's. All shared properties are used; TimeStep is in the
 * squared unit of length of ParameterUnits.
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
   * How far a step goes in time, in the squared unit of length of ParameterUnits. Above 0, default
   * 5e-5. Details smaller than about the root of TimeStep vanish in one step. Towards a sphere with
   * Conformalized ten times the default is a good step.
   */
  vtkSetMacro(TimeStep, double);
  vtkGetMacro(TimeStep, double);
  ///@}

  ///@{
  /**
   * How many steps to make. 1..100000, default 10. More continue the flow; fewer compute nothing.
   */
  vtkSetClampMacro(NumberOfSteps, int, 1, 100000);
  vtkGetMacro(NumberOfSteps, int);
  ///@}

  ///@{
  /**
   * When on, the stiffness stays that of the input: necks do not form, and the map from the input
   * tends to a conformal one. Needs TrackMetric. Default off.
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
   * When on, points of edges with one polygon stay, so that the surface tends to the soap film
   * between its boundaries. The functions themselves are drawn there, after Nitsche; they are off
   * by some hundredths of a cell at rest, and more in steps that move the surface by many cells.
   * Not with Conformalized or Rescale. Default off: boundaries move freely.
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
   * What every step is scaled to, about its centroid: nothing, the area of the input, or its
   * volume. Automatic (default) is ConstantArea with Conformalized, which would shrink to nothing,
   * else NoRescale.
   */
  vtkSetClampMacro(Rescale, int, Automatic, ConstantVolume);
  vtkGetMacro(Rescale, int);
  ///@}

  /**
   * The input of port 1: the basis.
   */
  void SetBasisConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }

protected:
  vtkMeanCurvatureFlow();
  ~vtkMeanCurvatureFlow() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  std::vector<double> OwnTimeSteps() override;
  void FreeStages() override;
  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  double TimeStep = 5e-5;
  int NumberOfSteps = 10;
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
