/**
 * @class   vtkLaplaceSpectrum
 * @brief   the smallest eigenvalues and eigenfunctions of the Laplace operator of a surface
 *
 * The eigenfunctions are the standing waves of the surface, ascending in frequency. The first
 * modes, one per connected component, have eigenvalue 0 and are constant on every component.
 * Nothing flows across boundaries, unless ZeroBoundaryValues makes the modes vanish there.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis.
 * Input port 1 (optional): the output of vtkConnectivityAwareBasis for the mesh of port 0.
 *
 * SetInputArrayToProcess(5, ...), as in vtkScreenedPoisson, chooses the optional `MetricArray`,
 * point or cell data. A symmetric tensor of six components (XX, YY, ZZ, XY, YZ, XZ) or nine
 * replaces the surface's own metric. If a map with the Jacobian J moves the surface, J^T J gives
 * the modes of the moved surface. Only the tensor's part in the plane of each triangle counts, and
 * that part must be positive definite. A triangle takes the mean of a point array. The integral of
 * a squared mode is taken in this metric as well.
 *
 * Output port 0 (vtkPolyData): the input with the following arrays.
 * - point data, in the precision of the points (double when they are integers): `Mode` (1
 *   component), the shown mode. With AllModes on, the output has `Mode000`, `Mode001`, ... instead.
 *   The integral of a squared mode over the surface is 1 in world units. Modes that an
 *   earlier Laplace Spectrum has left on the input are left out.
 * - field data: `Eigenvalues` (double, 1), one tuple per mode, in one over squared world length.
 * - field data: `Converged` (int, 1).
 * - field data: `CutsGroup` (int, 1): 1 if the last modes are part of a longer group of equal
 *   eigenvalues. A larger NumberOfModes has all of it. Eigenvalues count as equal if they differ by
 *   less than 1 % and by less than a quarter of their mean distance.
 * - field data: `TrustedEstimate` (int, 1): 1 if every estimated error is trusted.
 * - field data: `UsedDepth` (int, 1), the depth of the space.
 *
 * Output port 1 (vtkTable) has a row per mode.
 * - `Mode` (int) and `Eigenvalue` (double).
 * - `Residual` (double): its square estimates the relative error of the eigenvalue in the function
 *   space.
 * - `EstimatedError` (double): the estimated relative error of the eigenvalue of the surface. The
 *   estimate comes from the values of the same mode in the spaces of half and of a quarter of the
 *   resolution. It is 1 if the first of them has no such mode. With HatFunctions the estimate also
 *   includes the difference to the eigenvalue of the grid, if the eigenvalue of the hat functions
 *   is larger. Both eigenvalues are upper bounds, so the estimate is the error of the worse of the
 *   two.
 * - `TrustedEstimate` (int): 1 if the three values approach each other as on a resolved surface. If
 *   it is 0, the error may be far larger.
 *
 * Output port 2 (vtkTable) has the shown mode and its eigenvalue as `Text`, in one row, for
 * ParaView's view. The text is empty with AllModes on.
 *
 * Time: every mode but mode 0 is a time step, with its index as time value, unless AllModes is on
 * or Mode is fixed. Mode 0 is constant and shows nothing; set Mode to 0 to see it. With
 * ZeroBoundaryValues it is a time step, too. All modes are computed once. A change of time or of
 * Mode computes nothing. All modes belong to the input at one time, which stays the same. With
 * AllModes on or Mode fixed, the times are the input's.
 *
 * Tolerance (default 1e-6) is the wanted relative error of the eigenvalues in the function space.
 * Depth or Accuracy determines the error of the space itself. The filter uses all shared properties
 * but ParameterUnits. Cycles run in single precision if that resolves the surface. Eigenvalues and
 * modes are always double.
 *
 * All MPI ranks compute together unless Accuracy is above 0, TrackMetric is on or a MetricArray is
 * chosen. They may order the zero modes of several components differently and may flip the sign of
 * a mode.
 */
#ifndef vtkLaplaceSpectrum_h
#define vtkLaplaceSpectrum_h

#include "vtkSurfaceFEMAlgorithm.h"

class vtkTable;

class VTKGRIDFEMFILTERS_EXPORT vtkLaplaceSpectrum : public vtkSurfaceFEMAlgorithm
{
public:
  static vtkLaplaceSpectrum* New();
  vtkTypeMacro(vtkLaplaceSpectrum, vtkSurfaceFEMAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How many modes to compute. If fewer exist, a warning says so. 1..100000, default 20.
   */
  vtkSetInRangeMacro(NumberOfModes, int, 1, 100000);
  vtkGetMacro(NumberOfModes, int);
  ///@}

  ///@{
  /**
   * The mode to show, from 0. With -1 (default) the requested time chooses the mode. Without a
   * requested time the filter shows the first time step. The filter refuses a mode that does not
   * exist when it runs. AllModes ignores this property.
   */
  vtkSetMacro(Mode, int);
  vtkGetMacro(Mode, int);
  ///@}

  ///@{
  /**
   * When on, the output has an array for each mode. Default off.
   */
  vtkSetMacro(AllModes, bool);
  vtkGetMacro(AllModes, bool);
  vtkBooleanMacro(AllModes, bool);
  ///@}

  ///@{
  /**
   * When on, the modes vanish on the boundary, as those of a drum, and nothing is constant on a
   * component with a boundary. On the grid they vanish up to the error of the functions. Default
   * off: nothing flows across the boundary.
   */
  vtkSetMacro(ZeroBoundaryValues, bool);
  vtkGetMacro(ZeroBoundaryValues, bool);
  vtkBooleanMacro(ZeroBoundaryValues, bool);
  ///@}

  ///@{
  /**
   * When on, the functions stay as long as only points of the surface move, as in the next time
   * step of an animation. This is faster than starting again. The grid, the clip and the patterns
   * belong to the surface seen first, and integrals are in the metric of the current surface. The
   * filter starts again if cells have changed or a triangle has lost its area.
   *
   * The functions move with the surface. They stay as good as on the surface seen first where the
   * motion bends it. They become poorer where the motion stretches one direction more than another.
   * Parts that come close to each other later do not interact.
   *
   * Results therefore depend, within the error of the space, on the time step that was computed
   * first. After a change of Depth or a similar property, the next step counts as the first. The
   * field array `ReferenceTime` names this time step if the input has times. The field array
   * `LargestStretchRatio` measures how far the map from there is from keeping angles; 1 keeps them.
   *
   * Needs ReleaseDataFlagOff, the default, and excludes MetricArray. It has no effect with an
   * Accuracy above 0. Default off.
   */
  vtkSetMacro(TrackMetric, bool);
  vtkGetMacro(TrackMetric, bool);
  vtkBooleanMacro(TrackMetric, bool);
  ///@}

  ///@{
  /**
   * The wanted relative error of the eigenvalues of the surface. Above 0, it replaces Depth: the
   * filter chooses the depth at which the estimated error of every eigenvalue is at most Accuracy.
   * Estimates that are not trusted have to hold at one more depth. If the depth does not fit into
   * memory or a basis is given, Accuracy may not be reached. A warning says so, and `Converged` is
   * 0. With HatFunctions the mesh may be too coarse, and no depth changes its error. 0..0.5,
   * default 0: Depth is used.
   */
  vtkSetInRangeMacro(Accuracy, double, 0.0, 0.5);
  vtkGetMacro(Accuracy, double);
  ///@}

protected:
  vtkLaplaceSpectrum();
  ~vtkLaplaceSpectrum() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  std::vector<double> OwnTimeSteps() override;
  bool NeedsWholeSurface() override;
  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  void FreeStages() override;

  int NumberOfModes = 20;
  int Mode = -1;
  bool AllModes = false;
  bool ZeroBoundaryValues = false;
  bool TrackMetric = false;
  double Accuracy = 0.0;

private:
  vtkLaplaceSpectrum(const vtkLaplaceSpectrum&) = delete;
  void operator=(const vtkLaplaceSpectrum&) = delete;

  void Solve();
  int FirstTimeStep(int numberOfModes) const;
  int ShownMode(vtkInformation* output) const;
  void AddMode(int mode, const std::string& name, vtkPolyData* output);
  int WriteModes(vtkPolyData* input, vtkInformation* info, vtkPolyData* output);
  void WriteFields(vtkPolyData* output) const;
  void WriteLabel(int shown, vtkTable* label) const;
  void WriteTable(vtkTable* table) const;

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
