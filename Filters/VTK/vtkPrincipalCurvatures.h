/**
 * @class   vtkPrincipalCurvatures
 * @brief   how a surface bends at its points: two curvatures and their directions
 *
 * On every triangle the second fundamental form is fitted to how the normals of its corners differ,
 * and every point takes the mean over its triangles (Rusinkiewicz, Estimating Curvatures and Their
 * Derivatives on Triangle Meshes, 2004). With a SmoothingScale the normals are smoothed along the
 * surface before, in the function space of the shared properties, which takes away the noise of
 * scans and the errors of irregular triangles.
 *
 * Curvatures are positive where the surface is convex seen from outside: normals have to point
 * outwards, as the order of the corners says. A triangle that is turned the other way than its
 * neighbours counts as turned round.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips.
 *
 * Output port 0 (vtkPolyData): the input with point data, double, per unit of length:
 * - `MinimumCurvature`, `MaximumCurvature` (1 component each): the smaller and the larger one, with
 *   their signs
 * - `MinimumCurvatureDirection`, `MaximumCurvatureDirection` (3): unit vectors across the normal,
 *   of no particular sign; any two where the curvatures are equal
 * - `MeanCurvature` and `GaussianCurvature` (1; the latter per squared unit of length): half of
 *   their sum, and their product
 * - `ShapeIndex` (1; no unit): -1 cup, -0.5 rut, 0 saddle or plane, 0.5 ridge, 1 cap
 * - `Bending` (1; no unit), the active scalars: the mean curvature for the eye, in (-1, 1): 2/π
 * atan(H / h) with h the median of |H|, at least 1/√area, so that a few extremes do not hide the
 * rest
 *
 * All are 0 at points that no polygon with an area uses. With a SmoothingScale the field data have
 * `Converged`, `Iterations`, `Residual`, `ConvergenceFactor` and `DoublePrecisionSince` of the
 * smoothing, as in vtkScreenedPoisson.
 *
 * Without a SmoothingScale only WeldCoincidentPoints and NumberOfThreads are used. Tolerance is
 * 1e-4 and NormalStabilization 1e-2 by default. The function space has stages; the fit is the stage
 * Solve.
 */
#ifndef vtkPrincipalCurvatures_h
#define vtkPrincipalCurvatures_h

#include "vtkSurfaceFEMAlgorithm.h"

class VTKGRIDFEMFILTERS_EXPORT vtkPrincipalCurvatures : public vtkSurfaceFEMAlgorithm
{
public:
  static vtkPrincipalCurvatures* New();
  vtkTypeMacro(vtkPrincipalCurvatures, vtkSurfaceFEMAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Normals are smoothed as by a Gaussian of this standard deviation along the surface, in the unit
   * of length of ParameterUnits: what is smaller bends nothing. 0 (default) smooths nothing. One to
   * two edges of the mesh suit scans. A negative one is refused when the filter runs.
   */
  vtkSetMacro(SmoothingScale, double);
  vtkGetMacro(SmoothingScale, double);
  ///@}

protected:
  vtkPrincipalCurvatures();
  ~vtkPrincipalCurvatures() override;

  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  void FreeStages() override;

  double SmoothingScale = 0.0;

private:
  vtkPrincipalCurvatures(const vtkPrincipalCurvatures&) = delete;
  void operator=(const vtkPrincipalCurvatures&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
