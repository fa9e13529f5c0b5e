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
 * With a TransferFunction lengths count by how the surface bends: along a principal direction with
 * curvature k they are a(k) times as long. Where a is more than 1 the input is kept, so that
 * LargePositive, for example, leaves ridges as they are across them. Curvatures come from
 * vtkPrincipalCurvatures, relative to their usual size (what nine tenths of the area do not
 * exceed); every element of the function space has the mean of its own.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis. Input port 1 (optional): the output of vtkConnectivityAwareBasis for
 * the mesh of port 0. Arrays, chosen by SetInputArrayToProcess:
 * - index 0, `ValueArray`: f, a point array with any number of components; none: the coordinates
 * - index 1, `DetailScaleArray` (optional): point or cell array with one component, multiplies
 *   DetailScale. Elements take its mean.
 *
 * Output port 0 (vtkPolyData): the input
 * - without a ValueArray with moved points, in their precision (double when they are integers), and
 *   the point arrays `Displacement` (3 components) and `NormalDisplacement` (1; positive outwards).
 *   Active normals at points become those of the moved surface, others go, as do arrays of the clip
 *   and the basis.
 * - with a ValueArray with the point array `Filtered` in its precision. What is too fine for the
 *   function space is scaled by s.
 * - field data: `Converged`, `Iterations`, `DoublePrecisionSince`, `Residual`, `ConvergenceFactor`
 *   as in vtkScreenedPoisson; `UsualCurvature` (double, 1) with a TransferFunction
 *
 * The solution is linear in s, so that another DetailScale computes nothing but the new points.
 * Another array integrates and solves; another transfer function weighs the elements, which no
 * triangle is looked at for (stages Metric, Weights, Hierarchy, RightHandSide, Solve). Tolerance
 * (default 1e-4) is on the energy of the change, not on that of the shape. NormalStabilization is
 * 1e-2 by default.
 */
#ifndef vtkSurfaceDetail_h
#define vtkSurfaceDetail_h

#include "vtkSurfaceFEMAlgorithm.h"

#include <utility> // for std::pair
#include <vector>  // for std::vector

namespace gridfem
{
class Progress;
class StageKey;
} // namespace gridfem

class VTKGRIDFEMFILTERS_EXPORT vtkSurfaceDetail : public vtkSurfaceFEMAlgorithm
{
public:
  static vtkSurfaceDetail* New();
  vtkTypeMacro(vtkSurfaceDetail, vtkSurfaceFEMAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The factor s on the gradients: 0 smooths most, 1 changes nothing, more sharpens. Default 2. Any
   * finite number.
   */
  vtkSetMacro(DetailScale, double);
  vtkGetMacro(DetailScale, double);
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
   * curvature 0 to the usual size; Custom takes the TransferPoints.
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
   * The transfer function of Custom: pairs of a curvature, relative to the usual size (-1: as
   * hollow as usual, 1: as bulging), and what a length counts there, which must be above 0; linear
   * in between and constant beyond. Default (-1, 5), (0, 1), (1, 5).
   */
  void AddTransferPoint(double curvature, double length);
  void ClearTransferPoints();
  int GetNumberOfTransferPoints();
  ///@}

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

protected:
  vtkSurfaceDetail();
  ~vtkSurfaceDetail() override;

  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  void FreeStages() override;

  double DetailScale = 2.0;
  double ScreeningWeight = 3000.0;
  int TransferFunction = Isotropic;
  double Anisotropy = 5.0;
  std::vector<std::pair<double, double>> TransferPoints = { { -1.0, 5.0 }, { 0.0, 1.0 },
    { 1.0, 5.0 } };
  double SmoothingScale = 0.005;
  bool KeepVolume = false;

private:
  vtkSurfaceDetail(const vtkSurfaceDetail&) = delete;
  void operator=(const vtkSurfaceDetail&) = delete;

  void CheckProperties() const;
  void FindArrays(vtkPolyData* input);
  double LengthOf(double relativeCurvature) const;
  void UpdateMetric(const gridfem::Progress& progress);
  void UpdateLoad(const gridfem::Progress& progress);
  void UpdateSolution(const gridfem::Progress& progress);
  void WriteShape(vtkPolyData* input, vtkPolyData* output);
  void WriteArray(vtkPolyData* input, vtkPolyData* output);

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
