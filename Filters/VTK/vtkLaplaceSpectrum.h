/**
 * @class   vtkLaplaceSpectrum
 * @brief   the smallest eigenvalues and eigenfunctions of the Laplace operator of a surface
 *
 * The eigenfunctions are the standing waves of the surface, ascending in frequency. The first
 * modes, one per connected component, have eigenvalue 0 and are constant on every component.
 * Nothing flows across boundaries.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis. Input port 1 (optional): the output of vtkConnectivityAwareBasis for
 * the mesh of port 0.
 *
 * SetInputArrayToProcess(5, ...), as in vtkScreenedPoisson, chooses the `MetricArray` (optional),
 * point or cell data: a symmetric tensor of six components (XX, YY, ZZ, XY, YZ, XZ) or nine, the
 * metric in place of the surface's own; J^T J for the surface that a map with the Jacobian J would
 * move it to. Only its part in the plane of each triangle counts, which must be positive definite;
 * on points its mean over a triangle. The integral of a squared mode is taken in it as well.
 *
 * Output port 0 (vtkPolyData): the input with
 * - point data, in the precision of the points (double when they are integers): `Mode` (1
 *   component), the mode that is shown; or, with AllModes on, `Mode000`, `Mode001`, ... The
 *   integral of a squared mode over the surface is 1 in world units. Points that no polygon uses
 *   get 0. Such arrays of the input are left out.
 * - field data: `Eigenvalues` (double, 1; a tuple per mode, one over squared world length),
 *   `Converged` (int, 1), `UsedDepth` (int, 1): the depth of the space
 *
 * Output port 1 (vtkTable): a row per mode with `Mode` (int), `Eigenvalue` (double), `Residual`
 * (double), whose square estimates the relative error of the eigenvalue as one of the space, and
 * `EstimatedError` (double): the relative error of the eigenvalue as one of the surface, estimated
 * from the space of half the resolution, whose errors are four times as large; 1 where that space
 * has no such mode. With HatFunctions as FunctionSpace what the hat functions lie above the grid is
 * added: both are upper bounds, so this is the error of the worse of the two.
 *
 * Time: unless AllModes is on or Mode is fixed, every mode but mode 0 is a time step, with its
 * index as time value. Mode 0 is constant, so there is nothing to see; Mode = 0 shows it. All modes
 * are computed once; a change of time or of Mode computes nothing. The modes are those of the input
 * at one time, which stays the same. With AllModes on or Mode fixed, the times are the input's.
 *
 * Tolerance (default 1e-6) is the wanted relative error of the eigenvalues as those of the space;
 * Depth, or Accuracy, decides about the error of the space. All shared properties
 * but ParameterUnits are used. Cycles run in single precision where that resolves the surface;
 * eigenvalues and modes are always double.
 *
 * All ranks of MPI compute together unless Accuracy is above 0, TrackMetric is on or a MetricArray
 * is chosen. Zero modes of several components may come in another order, and modes with the other
 * sign.
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
   * How many modes to compute. A warning says when fewer exist, and when the last of them belongs
   * to a group of equal eigenvalues that is cut. Eigenvalues count as equal when they differ by
   * less than 1 % and by less than a quarter of their mean distance. 1..100000, default 20.
   */
  vtkSetClampMacro(NumberOfModes, int, 1, 100000);
  vtkGetMacro(NumberOfModes, int);
  ///@}

  ///@{
  /**
   * The mode to show, from 0; -1 (default) shows the mode of the time that is asked for, the first
   * time step when none is. A mode that does not exist is refused when the filter runs; AllModes
   * ignores this property.
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
   * and does not go with MetricArray. It has no effect with an Accuracy above 0. Default off.
   */
  vtkSetMacro(TrackMetric, bool);
  vtkGetMacro(TrackMetric, bool);
  vtkBooleanMacro(TrackMetric, bool);
  ///@}

  ///@{
  /**
   * The wanted relative error of the eigenvalues as those of the surface. Above 0 it chooses the
   * depth, and Depth is not used: the estimated error of every eigenvalue is at most Accuracy. A
   * warning, and `Converged` = 0, say when it is not reached: with a basis that is given, or for
   * want of memory. With HatFunctions the mesh may be too coarse, and no depth changes its error.
   * At 0 (default) Depth is used. 0..0.5.
   */
  vtkSetClampMacro(Accuracy, double, 0.0, 0.5);
  vtkGetMacro(Accuracy, double);
  ///@}

  /**
   * The input of port 1: the basis.
   */
  void SetBasisConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }

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
  bool TrackMetric = false;
  double Accuracy = 0.0;

private:
  vtkLaplaceSpectrum(const vtkLaplaceSpectrum&) = delete;
  void operator=(const vtkLaplaceSpectrum&) = delete;

  void Solve();
  int ShownMode(vtkInformation* output) const;
  void AddMode(int mode, const std::string& name, vtkPolyData* output);
  void WriteModes(vtkPolyData* input, vtkInformation* info, vtkPolyData* output);
  void WriteFields(vtkPolyData* output) const;
  void WriteTable(vtkTable* table) const;

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
