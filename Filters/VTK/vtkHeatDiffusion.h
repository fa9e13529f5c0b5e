/**
 * @class   vtkHeatDiffusion
 * @brief   spread an array along a surface as heat spreads, in time steps
 *
 * Solves ∂u/∂t = Δu + s on the surface, with the source s, from the array u at time 0 to the
 * DiffusionTime. Instead of the time you can give the width of the Gaussian that smooths: FWHM or
 * Sigma. The time is divided into NumberOfSteps equal steps, and each is a time step of the output.
 * Steps are of second order in their length and stable for any length. The first step takes three
 * solves and damps details of any size; each later one takes two. One step leaves at most 0.006 of
 * a detail with the wrong sign, and heat from a single point stays positive. The result overshoots
 * the given values only at jumps within a cell.
 *
 * No heat flows over boundaries. The integral over every connected component changes only by the
 * source. Held values, however, let heat enter and leave.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis.
 * Input port 1 (optional): the output of vtkConnectivityAwareBasis for the mesh of port 0.
 * Input port 2 (optional): vtkSelection of points or cells of port 0, whose values are held.
 *
 * SetInputArrayToProcess chooses the arrays:
 * - index 0: the array at time 0, point or cell data with any number of components C. Without it
 *   the filter takes the coordinates.
 * - index 1: the source, which is added per unit of time, point or cell data with C components.
 *   Without it the source is 0.
 * - index 2, the ConstraintArray: point data with one component. Points at which it is not 0 keep
 *   the value of time 0. The array at time 0 must be point data in this case.
 *
 * Output port 0 (vtkPolyData): the input with the following arrays.
 * - point data: `Diffused` (C components). It is of bytes if the array holds colors (three or four
 *   bytes), float if the array is float, else double. Without an array, the points move to their
 *   spread coordinates. The output then has `Displacement` and `NormalDisplacement`, and normals
 *   follow. The clip, basis and modes belong to the old shape and are left out.
 * - field data: `Step` (int, 1).
 * - field data: `DiffusionTime` (double, 1; squared world length).
 * - field data, of all solves of the shown step: `Converged`, `Iterations`, `DoublePrecisionSince`,
 *   `Residual`, `ConvergenceFactor` and the estimated errors of vtkPoissonAlgorithm.
 * - field data, if values are held: `Misfit` (double, 1), the largest difference from a held value.
 *
 * Time: the steps are the time steps 1 .. NumberOfSteps. A request without a time gets the last
 * step. With a single step, or with TimeFrom, the output has the times of the input instead. Steps
 * are computed once and kept. If you ask for more steps of the same length, DiffusionTime /
 * NumberOfSteps, the filter computes only the new ones.
 *
 * Accuracy ends the solves of a single step. The errors of several steps add up. Several steps, and
 * steps with held values, are therefore solved to a Tolerance, which is 1e-6 if the property is 0.
 * They have no estimated errors. NormalStabilization is 1e-2 by default. The filter uses all shared
 * properties. DiffusionTime is in the squared unit of length of ParameterUnits. FWHM and Sigma are
 * in the unit of the points, and the source is per squared world length.
 *
 * All MPI ranks compute together if an array spreads. Rank 0 computes alone if the coordinates
 * spread.
 */
#ifndef vtkHeatDiffusion_h
#define vtkHeatDiffusion_h

#include "vtkPoissonAlgorithm.h"

class VTKGRIDFEMFILTERS_EXPORT vtkHeatDiffusion : public vtkPoissonAlgorithm
{
public:
  static vtkHeatDiffusion* New();
  vtkTypeMacro(vtkHeatDiffusion, vtkPoissonAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum AmountType
  {
    Time = 0,
    FullWidth = 1,
    StandardDeviation = 2
  };
  ///@{
  /**
   * The property that states how far heat spreads. Time (default): DiffusionTime. FullWidth: FWHM.
   * StandardDeviation: Sigma.
   */
  vtkSetInRangeMacro(Amount, int, Time, StandardDeviation);
  vtkGetMacro(Amount, int);
  ///@}

  ///@{
  /**
   * How long heat spreads, in the squared unit of length of ParameterUnits. Waves of length l fade
   * by exp(-(2 pi / l)^2 t): to 2 % if l is 3.2 times the square root of the time t. Above 0,
   * default 0.001.
   */
  vtkSetMacro(DiffusionTime, double);
  vtkGetMacro(DiffusionTime, double);
  ///@}

  ///@{
  /**
   * The full width at half maximum of the Gaussian that smooths, in the unit of the points. The
   * diffusion time is FWHM^2 / (16 ln 2). Above 0, default 6.
   */
  vtkSetMacro(FWHM, double);
  vtkGetMacro(FWHM, double);
  ///@}

  ///@{
  /**
   * The standard deviation of the Gaussian that smooths, in the unit of the points. The diffusion
   * time is Sigma^2 / 2. Above 0, default 2.5.
   */
  vtkSetMacro(Sigma, double);
  vtkGetMacro(Sigma, double);
  ///@}

  ///@{
  /**
   * The number of equal time steps. 1..10000, default 1.
   */
  vtkSetInRangeMacro(NumberOfSteps, int, 1, 10000);
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
   * them. A single step always follows the input.
   */
  vtkSetInRangeMacro(TimeFrom, int, Steps, Input);
  vtkGetMacro(TimeFrom, int);
  ///@}

  ///@{
  /**
   * When on, values are also held along the boundary of the surface. Default off.
   */
  vtkSetMacro(BoundaryValues, bool);
  vtkGetMacro(BoundaryValues, bool);
  vtkBooleanMacro(BoundaryValues, bool);
  ///@}

  ///@{
  /**
   * Further arrays that are smoothed together with the array of index 0, and in the same way. They
   * are of points if this array is, else of cells. The result of each has the name of the array
   * before its name, as in `Thickness_Diffused`. All errors, and all other numbers in the field
   * data, are then the worst of all arrays. None by default.
   */
  void AddFurtherArray(const char* name);
  void ClearFurtherArrays();
  ///@}

protected:
  vtkHeatDiffusion();
  ~vtkHeatDiffusion() override;

  std::vector<double> OwnTimeSteps() override;
  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  bool NeedsWholeSurface() override;
  void FreeStages() override;

  int Amount = Time;
  double DiffusionTime = 0.001;
  double FWHM = 6.0;
  double Sigma = 2.5;
  int NumberOfSteps = 1;
  int TimeFrom = Steps;
  bool BoundaryValues = false;

private:
  vtkHeatDiffusion(const vtkHeatDiffusion&) = delete;
  void operator=(const vtkHeatDiffusion&) = delete;

  void WriteStep(int shown, vtkPolyData* input, vtkPolyData* output);

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
