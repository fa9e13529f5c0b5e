/**
 * @class   vtkPrincipalCurvatures
 * @brief   principal curvatures and directions at the points of a surface
 *
 * Fits the second fundamental form of every triangle to the differences between the normals of its
 * corners. Every point takes the mean over its triangles (Rusinkiewicz, Estimating Curvatures and
 * Their Derivatives on Triangle Meshes, 2004). A SmoothingScale first smooths the normals along the
 * surface, in the function space of the shared properties. This removes the noise of scans and the
 * errors of irregular triangles.
 *
 * Curvatures are positive where the surface is convex seen from outside. The order of the corners
 * gives the normals, which have to point outward. A triangle that faces the other way than its
 * neighbors is treated as flipped.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips.
 *
 * Output port 0 (vtkPolyData): the input with point data, double, per unit of length.
 * - `MinimumCurvature`, `MaximumCurvature` (1 component each): the smaller and the larger
 *   curvature, with their signs.
 * - `MinimumCurvatureDirection`, `MaximumCurvatureDirection` (3): unit vectors perpendicular to the
 *   normal, with an arbitrary sign. If the curvatures are equal, the directions are any two such
 *   vectors.
 * - `MeanCurvature` (1): half of the sum of the curvatures.
 * - `GaussianCurvature` (1; per squared unit of length): their product.
 * - `ShapeIndex` (1; no unit): -1 cup, -0.5 rut, 0 saddle or plane, 0.5 ridge, 1 cap.
 * - `Bending` (1; no unit), the active scalars: the mean curvature H scaled for display, in (-1,
 *   1). It is 2/π atan(H / h), so that a few extremes do not hide the rest. h is the median of |H|,
 *   at least 1/√area.
 *
 * If some triangles of a component face the other way than the rest, they count as turned around. A
 * closed component with such triangles counts as facing outward. The field array `TurnedTriangles`
 * (int, 1) is the number of turned triangles. The filter warns about one-sided components, such as
 * a Möbius strip.
 *
 * With a SmoothingScale, the field data have `Converged`, `Iterations`, `Residual`,
 * `ConvergenceFactor` and `DoublePrecisionSince` of the smoothing, as in vtkScreenedPoisson.
 *
 * Without a SmoothingScale the filter uses only WeldCoincidentPoints and NumberOfThreads. Tolerance
 * is 1e-4 and NormalStabilization 1e-2 by default. The function space has the usual stages. The fit
 * is the stage Solve.
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
   * The standard deviation of the Gaussian that smooths the normals along the surface, in the unit
   * of length of ParameterUnits. Smaller details do not count. 0 (default) smooths nothing. For
   * scans, one to two edge lengths of the mesh are suitable. The filter refuses a negative value
   * when it runs.
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
