/**
 * @class   vtkHeatDiffusion
 * @brief   an array that spreads along a surface as heat does, in time steps
 *
 * Solves du/dt = div grad u + s on the surface, from the array at time 0 to the DiffusionTime, in
 * NumberOfSteps equal steps, each of which is a time step of the output. They are of second order
 * in their length, with two solves each, and stable for any length. No heat flows over boundaries:
 * the integral over every connected component is kept, but for what the source adds; unless values
 * are held, where heat comes and goes.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis. Input port 1 (optional): the output of vtkConnectivityAwareBasis for
 * the mesh of port 0. Input port 2 (optional): vtkSelection of points or cells of port 0, whose
 * values are held. The array at time 0 is chosen by SetInputArrayToProcess(0, ...): point or cell
 * data with any number of components C; none: the coordinates. The source, what is added per unit
 * of time, by SetInputArrayToProcess(1, ...): point or cell data with C components; none: 0. The
 * ConstraintArray, by SetInputArrayToProcess(2, ...): point data with one component; where it is
 * not 0 the value stays that of time 0, which must be point data then.
 *
 * Output port 0 (vtkPolyData): the input with
 * - point data, double: `Diffused` (C components). Points that no polygon uses keep the array if it
 *   is a point array, else get 0. Without an array the points move to where their coordinates have
 *   spread: `Displacement` and `NormalDisplacement` are added, normals follow, and clip, basis and
 *   modes, which belong to the old shape, are left out.
 * - field data: `Step` (int, 1), `DiffusionTime` (double, 1; squared world length), `Converged`,
 *   `Iterations`, `DoublePrecisionSince`, `Residual`, `ConvergenceFactor` and the estimated errors
 *   of vtkPoissonAlgorithm, all of the solves of the step that is shown; `Misfit` (double, 1) where
 *   values are held: by how much they are missed at most
 *
 * Time: the steps are the time steps 1 .. NumberOfSteps. A request without a time gets the last.
 * Steps are made once and kept; more steps of the same length, DiffusionTime / NumberOfSteps, are
 * not made again.
 *
 * Accuracy ends the solves of a single step. The errors of several add up: they are solved to a
 * Tolerance, 1e-6 where it is 0, and have no estimates; and so are steps with values that are held.
 * NormalStabilization is 1e-2 by default. All shared properties are used; DiffusionTime is in the
 * squared unit of length of ParameterUnits, the source is per squared world length.
 *
 * All ranks of MPI compute together where an array spreads; coordinates are left to rank 0.
 */
#ifndef vtkHeatDiffusion_h
#define vtkHeatDiffusion_h

#include "vtkPoissonAlgorithm.h"

namespace gridfem
{
class SelectedPoints;
} // namespace gridfem

class VTKGRIDFEMFILTERS_EXPORT vtkHeatDiffusion : public vtkPoissonAlgorithm
{
public:
  static vtkHeatDiffusion* New();
  vtkTypeMacro(vtkHeatDiffusion, vtkPoissonAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How long heat spreads, in the squared unit of length of ParameterUnits: details smaller than
   * about its root vanish. Above 0, default 0.001.
   */
  vtkSetMacro(DiffusionTime, double);
  vtkGetMacro(DiffusionTime, double);
  ///@}

  ///@{
  /**
   * Equal steps that the time is cut into. 1..10000, default 1.
   */
  vtkSetClampMacro(NumberOfSteps, int, 1, 10000);
  vtkGetMacro(NumberOfSteps, int);
  ///@}

  ///@{
  /**
   * When on, values stay where the surface ends as well. Default off.
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
  vtkHeatDiffusion();
  ~vtkHeatDiffusion() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  std::vector<double> OwnTimeSteps() override;
  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  bool NeedsWholeSurface() override;
  void FreeStages() override;

  double DiffusionTime = 0.001;
  int NumberOfSteps = 1;
  bool BoundaryValues = false;

private:
  vtkHeatDiffusion(const vtkHeatDiffusion&) = delete;
  void operator=(const vtkHeatDiffusion&) = delete;

  void WriteStep(int shown, vtkPolyData* input, vtkPolyData* output);

  struct Internals;
  std::unique_ptr<Internals> Data;
  std::unique_ptr<gridfem::SelectedPoints> Selection;
};

#endif
