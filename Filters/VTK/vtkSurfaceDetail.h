/**
 * @class   vtkSurfaceDetail
 * @brief   sharpen or smooth a surface, or an array on it, everywhere or by its curvature
 *
 * Finds the shape (or array) u that minimizes, over the surface, the integral of
 *
 *     w (u - f)² + |∇u - s ∇f|²
 *
 * with the input f, the ScreeningWeight w and the DetailScale s. A scale above 1 sharpens, a scale
 * below 1 smooths, and 1 changes nothing. Details smaller than about 1 / sqrt(w) are scaled. Larger
 * details stay.
 *
 * With a selection, s is DetailScale at the selected points and OutsideScale elsewhere. Between
 * them it changes smoothly within the TransitionWidth, a distance along the surface from the
 * selected points (MarchDistance in Core). The selection has no effect beyond this distance.
 *
 * With a TransferFunction, curvature changes the lengths that the filter uses. Along a principal
 * direction with curvature κ, lengths are multiplied by α(κ). The input is kept where α is larger
 * than 1. LargePositive, for example, keeps the profile of ridges. Curvatures come from
 * vtkPrincipalCurvatures, divided by a usual curvature, which nine tenths of the area do not
 * exceed. Every element of the function space uses the mean over its area.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis.
 * Input port 1 (optional): the output of vtkConnectivityAwareBasis for the mesh of port 0.
 * Input port 2 (optional): vtkSelection of points or cells of port 0. A selected cell selects its
 * points.
 *
 * SetInputArrayToProcess chooses the arrays:
 * - index 0, `ValueArray`: f, a point array with any number of components. Without it f is the
 *   coordinates.
 * - index 1, `DetailScaleArray` (optional): a point or cell array with one component, which
 *   multiplies DetailScale and OutsideScale. Elements take its mean.
 *
 * Output port 0 (vtkPolyData): the input with the following changes.
 * - Without a ValueArray, the points move, in their precision (double when they are integers). The
 *   output has the point arrays `Displacement` (3 components) and `NormalDisplacement` (1; positive
 *   outward). Active normals at points become the normals of the moved surface. Other normals and
 *   the arrays of the clip and the basis are left out.
 * - With a ValueArray, the output has the point array `Filtered`, in the array's precision. Details
 *   that are too fine for the function space are scaled by s.
 * - With a selection, the output has the point array `Selected` (double, 1 component). It is 1 at
 *   selected points and falls to 0 within the TransitionWidth.
 * - field data: `DiscretizationError`, `LargestDiscretizationError`, `AlgebraicError` and
 *   `TrustedEstimate` of vtkPoissonAlgorithm. They are errors of the change that the filter makes,
 *   relative to this change. With a selection or a scale array, `LargestDiscretizationError` is an
 *   upper bound.
 * - field data: `Converged`, `Iterations`, `DoublePrecisionSince`, `Residual`, `ConvergenceFactor`,
 *   as in vtkScreenedPoisson.
 * - field data, with a TransferFunction: `UsualCurvature` (double, 1).
 *
 * The solution is linear in s, so a change of a scale only computes new points. Another selection,
 * array or width computes a right-hand side from the elements and solves. Another transfer function
 * first computes new weights of the elements. No change visits the triangles again (stages Metric,
 * Weights, Hierarchy, RightHandSide, Solve). Every solve starts from the last solution. Tolerance
 * (default 1e-4) is on the energy of the change, not of the shape. NormalStabilization is 1e-2 by
 * default.
 */
#ifndef vtkSurfaceDetail_h
#define vtkSurfaceDetail_h

#include "vtkSmartPointer.h" // for CustomTransferFunction
#include "vtkSurfaceFEMAlgorithm.h"

class vtkPiecewiseFunction;

class VTKGRIDFEMFILTERS_EXPORT vtkSurfaceDetail : public vtkSurfaceFEMAlgorithm
{
public:
  static vtkSurfaceDetail* New();
  vtkTypeMacro(vtkSurfaceDetail, vtkSurfaceFEMAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The factor s on the gradients: 0 smooths most, 1 changes nothing, a larger value sharpens. With
   * a selection it applies only to the selection. Default 2. Any finite number.
   */
  vtkSetMacro(DetailScale, double);
  vtkGetMacro(DetailScale, double);
  ///@}

  ///@{
  /**
   * The factor s outside the selection. Not used without a selection. Default 1. Any finite number.
   */
  vtkSetMacro(OutsideScale, double);
  vtkGetMacro(OutsideScale, double);
  ///@}

  ///@{
  /**
   * The distance from the selected points, along the surface, at which s becomes OutsideScale. The
   * length is in the units of ParameterUnits. 0 makes a sharp border. 0 or more, default 0.02.
   */
  vtkSetMacro(TransitionWidth, double);
  vtkGetMacro(TransitionWidth, double);
  ///@}

  ///@{
  /**
   * How strongly the result is held to the input, in one over the squared length of ParameterUnits.
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
   * The factor on lengths along a principal direction, by its curvature.
   * - Isotropic (default): 1.
   * - LargeNegative, LargePositive, LargeAbsolute: rises from 1 at curvature 0 to Anisotropy at the
   *   usual curvature.
   * - Custom: follows the CustomTransferFunction.
   */
  vtkSetInRangeMacro(TransferFunction, int, Isotropic, Custom);
  vtkGetMacro(TransferFunction, int);
  ///@}

  ///@{
  /**
   * The factor on lengths along directions of large curvature. 0.001..1000, default 5. A value
   * below 1 changes these directions more than others.
   */
  vtkSetInRangeMacro(Anisotropy, double, 1e-3, 1e3);
  vtkGetMacro(Anisotropy, double);
  ///@}

  ///@{
  /**
   * The function f of the TransferFunction Custom, with α(κ) = 1 + (Anisotropy - 1) f(κ). Its
   * argument is the curvature divided by the usual curvature: negative in valleys, positive on
   * ridges. α(κ) must be above 0. The default goes through (-1, 1), (0, 0) and (1, 1). It is linear
   * in between and constant beyond, like LargeAbsolute without the smooth ends. A change of the
   * function modifies the filter.
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
   * When on, the moved surface is scaled about its centroid to the volume of the input. The volume
   * of an open surface is the volume of the cone from the surface to its centroid. Default off.
   */
  vtkSetMacro(KeepVolume, bool);
  vtkGetMacro(KeepVolume, bool);
  vtkBooleanMacro(KeepVolume, bool);
  ///@}

protected:
  vtkSurfaceDetail();
  ~vtkSurfaceDetail() override;

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
};

#endif
