/**
 * @class   vtkSurfaceDetail
 * @brief   sharpen or smooth a surface, or an array on it, also by its curvature
 *
 * Finds the shape (or array) u that minimises, over the surface, the integral of
 *
 *     w (u - f)^2 + |grad u - s grad f|^2
 *
 * with the input f, the ScreeningWeight w and the DetailScale s: more than 1 sharpens, less
 * smooths, 1 changes nothing. Details smaller than about 1 / sqrt(w) are scaled; larger ones stay.
 *
 * With a selection s is DetailScale at the points that it takes and OutsideScale elsewhere, and
 * goes over from one to the other within the TransitionWidth, a distance along the surface
 * (MarchDistance in Core) from the selected points: smoothly, and without an effect beyond.
 *
 * With a TransferFunction lengths count by how the surface bends: along a principal direction with
 * curvature k they are a(k) times as long. Where a is more than 1 the input is kept, so that
 * LargePositive, for example, leaves ridges as they are across them. Curvatures come from
 * vtkPrincipalCurvatures, relative to their usual size (what nine tenths of the area do not
 * exceed); every element of the function space has the mean of its own.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis. Input port 1 (optional): the output of vtkConnectivityAwareBasis for
 * the mesh of port 0. Input port 2 (optional): vtkSelection of points or cells of port 0; a cell
 * takes its points. Arrays, chosen by SetInputArrayToProcess:
 * - index 0, `ValueArray`: f, a point array with any number of components; none: the coordinates
 * - index 1, `DetailScaleArray` (optional): point or cell array with one component, multiplies
 *   DetailScale and OutsideScale. Elements take its mean.
 *
 * Output port 0 (vtkPolyData): the input
 * - without a ValueArray with moved points, in their precision (double when they are integers), and
 *   the point arrays `Displacement` (3 components) and `NormalDisplacement` (1; positive outwards).
 *   Active normals at points become those of the moved surface, others go, as do arrays of the clip
 *   and the basis.
 * - with a ValueArray with the point array `Filtered` in its precision. What is too fine for the
 *   function space is scaled by s.
 * - with a selection the point array `Selected` (double, 1 component): 1 where it takes points,
 *   falling to 0 within the TransitionWidth
 * - field data: `DiscretizationError`, `LargestDiscretizationError`, `AlgebraicError` and
 *   `TrustedEstimate` of vtkPoissonAlgorithm, of what the filter changes and relative to that:
 *   with a selection or a scale array the second is a bound
 * - field data: `Converged`, `Iterations`, `DoublePrecisionSince`, `Residual`, `ConvergenceFactor`
 *   as in vtkScreenedPoisson; `UsualCurvature` (double, 1) with a TransferFunction
 *
 * The solution is linear in s, so that other scales compute nothing but the new points. Another
 * selection, array or width sums a right-hand side from the elements and solves; another transfer
 * function weighs the elements before that. No triangle is looked at for any of them (stages
 * Metric, Weights, Hierarchy, RightHandSide, Solve). Every solve starts from the last solution.
 * Tolerance (default 1e-4) is on the energy of the change, not on that of the shape.
 * NormalStabilization is 1e-2 by default.
 */
#ifndef vtkSurfaceDetail_h
#define vtkSurfaceDetail_h

#include "vtkSmartPointer.h" // for CustomTransferFunction
#include "vtkSurfaceFEMAlgorithm.h"

class vtkPiecewiseFunction;

namespace gridfem
{
class SelectedPoints;
} // namespace gridfem

class VTKGRIDFEMFILTERS_EXPORT vtkSurfaceDetail : public vtkSurfaceFEMAlgorithm
{
public:
  static vtkSurfaceDetail* New();
  vtkTypeMacro(vtkSurfaceDetail, vtkSurfaceFEMAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The factor s on the gradients: 0 smooths most, 1 changes nothing, more sharpens; with a
   * selection the one inside of it. Default 2. Any finite number.
   */
  vtkSetMacro(DetailScale, double);
  vtkGetMacro(DetailScale, double);
  ///@}

  ///@{
  /**
   * The factor s outside of the selection; not used without one. Default 1. Any finite number.
   */
  vtkSetMacro(OutsideScale, double);
  vtkGetMacro(OutsideScale, double);
  ///@}

  ///@{
  /**
   * How far from the selected points, along the surface, s becomes OutsideScale; a length of
   * ParameterUnits. 0: at once. 0 or more, default 0.02.
   */
  vtkSetMacro(TransitionWidth, double);
  vtkGetMacro(TransitionWidth, double);
  ///@}

  ///@{
  /**
   * How strongly the result is held to the input; one over the squared length of ParameterUnits.
   * Details smaller than about 1 / sqrt(ScreeningWeight) are scaled. 0 or more, default 3000.
   */
  vtkSetMacro(ScreeningWeight, double);
  vtkGetMacro(ScreeningWeight, double);
  ///@}

  enum TransferFunctionType
  {
    Isotropic = 0,
    LargeNegative = 1,
    LargePositive = 2,
    LargeAbsolute = 3,
    Custom = 4
  };
  ///@{
  /**
   * How lengths along a principal direction count, by its curvature: Isotropic (default) all as
   * they are; LargeNegative, LargePositive and LargeAbsolute rise from 1 to Anisotropy from
   * curvature 0 to the usual size; Custom as the CustomTransferFunction says.
   */
  vtkSetClampMacro(TransferFunction, int, Isotropic, Custom);
  vtkGetMacro(TransferFunction, int);
  ///@}

  ///@{
  /**
   * What lengths count along directions of large curvature. 0.001..1000, default 5. Below 1 these
   * directions are changed more than others.
   */
  vtkSetClampMacro(Anisotropy, double, 1e-3, 1e3);
  vtkGetMacro(Anisotropy, double);
  ///@}

  ///@{
  /**
   * Of Custom: what part of the way from 1 to Anisotropy lengths count, a(k) = 1 + (Anisotropy - 1)
   * f(k), for a curvature relative to the usual size (-1: as hollow as usual, 1: as bulging). a(k)
   * must be above 0. Default: (-1, 1), (0, 0), (1, 1), linear in between and constant beyond, as
   * LargeAbsolute without its smooth ends. A change of the function is one of the filter.
   */
  virtual void SetCustomTransferFunction(vtkPiecewiseFunction* function);
  vtkPiecewiseFunction* GetCustomTransferFunction();
  ///@}

  vtkMTimeType GetMTime() override;

  ///@{
  /**
   * The SmoothingScale of the curvatures, as in vtkPrincipalCurvatures. 0 or more, default 0.005.
   */
  vtkSetMacro(SmoothingScale, double);
  vtkGetMacro(SmoothingScale, double);
  ///@}

  ///@{
  /**
   * When on, the moved surface is scaled about its centroid to the volume of the input. Default
   * off. Of an open surface that of the cone to the centroid counts.
   */
  vtkSetMacro(KeepVolume, bool);
  vtkGetMacro(KeepVolume, bool);
  vtkBooleanMacro(KeepVolume, bool);
  ///@}

  /**
   * The input of port 1: the basis.
   */
  void SetBasisConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }

  /**
   * The input of port 2: a selection of what DetailScale counts for.
   */
  void SetSelectionConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(2, output); }

protected:
  vtkSurfaceDetail();
  ~vtkSurfaceDetail() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  void FreeStages() override;

  double DetailScale = 2.0;
  double OutsideScale = 1.0;
  double TransitionWidth = 0.02;
  double ScreeningWeight = 3000.0;
  int TransferFunction = Isotropic;
  double Anisotropy = 5.0;
  vtkSmartPointer<vtkPiecewiseFunction> CustomTransferFunction;
  double SmoothingScale = 0.005;
  bool KeepVolume = false;

private:
  vtkSurfaceDetail(const vtkSurfaceDetail&) = delete;
  void operator=(const vtkSurfaceDetail&) = delete;

  void WriteArray(vtkPolyData* output);
  void WriteFacts(vtkPolyData* output);

  struct Internals;
  std::unique_ptr<Internals> Data;
  std::unique_ptr<gridfem::SelectedPoints> Selection;
};

#endif
