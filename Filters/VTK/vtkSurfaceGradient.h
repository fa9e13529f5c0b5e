/**
 * @class   vtkSurfaceGradient
 * @brief   gradient and Laplacian of an array along a surface
 *
 * Computes the derivatives of the array's projection into the function space, in the weak sense.
 * The gradient on cells is projected to points, and the Laplacian is the divergence of this
 * projection. The derivatives therefore do not depend on the layout of the triangles. Noise below
 * the resolution of the space is left out. Within about two cells of a boundary the Laplacian, and
 * the gradient of cell data, are continued from inside. They are of first order there, except for
 * the Laplacian of cell data, which keeps an error of about a sixth.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis.
 * Input port 1 (optional): the output of vtkConnectivityAwareBasis for the mesh of port 0.
 *
 * SetInputArrayToProcess(0, ...) chooses the array: point or cell data with any number of
 * components C. Without it the filter takes the coordinates. Their Laplacian is the mean curvature
 * vector (twice the mean curvature along the normal).
 *
 * Output port 0 (vtkPolyData): the input with the following arrays. Cells that are no polygons
 * get 0. A polygon has the mean of its triangles, weighted by area.
 * - point and cell data, double: `Gradient` (3 C components, the three components for component 0
 *   first; per unit of length).
 * - point and cell data, double: `Laplacian` (C components; per unit of length squared, negative at
 *   a maximum).
 * - the same, for an array of vectors (C = 3): `Divergence` (1; per unit of length) along the
 *   surface. The normal part of the vectors contributes through the curvature.
 * - the same, for an array of vectors: `Curl` (1; per unit of length), the part of the rotation
 *   along the normal. It is positive for counterclockwise rotation, seen from outside.
 * - point and cell data, double, for an array of vectors with HodgeDecomposition: `GradientPart`,
 *   `RotationPart` and `HarmonicPart` (3 components each, in the unit of the array). They are
 *   described below.
 * - point data, double, for an array of vectors with HodgeDecomposition: `Potential` and
 *   `StreamFunction` (1 component each, in the unit of the array times a length).
 * - field data, of the solve that took most iterations: `Converged`, `Iterations`,
 *   `DoublePrecisionSince`, `Residual`, `ConvergenceFactor`.
 * - field data: the estimated errors of vtkPoissonAlgorithm. They measure how well the functions
 *   follow the array, its gradient and its Laplacian. The largest error counts.
 *
 * The Hodge decomposition writes the part v of the vectors along the surface as ∇u + n x ∇w + h.
 * Here n is the normal, u the Potential, w the StreamFunction, and h the rest. The rest has neither
 * sources nor eddies. It goes around handles and holes, and holds everything that the functions
 * cannot follow. The three parts are orthogonal: the integrals of their squares add up to the
 * integral of v². If the surface has a boundary, this holds on hat functions, and on the grid up to
 * the error of the functions. On cells the parts add up to v. At points they are projected like the
 * gradient.
 *
 * w is 0 along boundaries, so h does not cross the boundary. Flow across the boundary is in the
 * gradient part. Edges of more than two triangles count as a boundary for w. Triangles may face
 * either way: each counts as facing like most of the area of its component. Components without two
 * sides, such as a Moebius strip, have no rotation part, and the filter warns.
 *
 * Accuracy or Tolerance applies to the projections and potentials. A StreamFunction that is held at
 * boundaries is solved to a Tolerance, which is 1e-4 if the property is 0. NormalStabilization is
 * 1e-2 by default. The filter uses all shared properties but ParameterUnits.
 *
 * All MPI ranks compute together. Rank 0 computes a HodgeDecomposition alone.
 */
#ifndef vtkSurfaceGradient_h
#define vtkSurfaceGradient_h

#include "vtkPoissonAlgorithm.h"

class VTKGRIDFEMFILTERS_EXPORT vtkSurfaceGradient : public vtkPoissonAlgorithm
{
public:
  static vtkSurfaceGradient* New();
  vtkTypeMacro(vtkSurfaceGradient, vtkPoissonAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * When on, the filter splits an array of vectors into gradient, rotation and rest. It then
   * refuses any other array. Default off.
   */
  vtkSetMacro(HodgeDecomposition, bool);
  vtkGetMacro(HodgeDecomposition, bool);
  vtkBooleanMacro(HodgeDecomposition, bool);
  ///@}

protected:
  vtkSurfaceGradient();
  ~vtkSurfaceGradient() override;

  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  bool NeedsWholeSurface() override;
  void FreeStages() override;

  bool HodgeDecomposition = false;

private:
  vtkSurfaceGradient(const vtkSurfaceGradient&) = delete;
  void operator=(const vtkSurfaceGradient&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
