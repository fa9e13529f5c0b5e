/**
 * @class   vtkSurfaceGradient
 * @brief   gradient and Laplacian of an array along a surface
 *
 * The derivatives are those of the array's projection into the function space, in the weak sense:
 * the gradient on cells is projected to be one at points, and the Laplacian is the divergence of
 * that. So they do not depend on how the triangles lie, noise below the resolution of the space is
 * left out, and no condition is made at boundaries.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis. Input port 1 (optional): the output of vtkConnectivityAwareBasis for
 * the mesh of port 0. The array is chosen by SetInputArrayToProcess(0, ...): point or cell data
 * with any number of components C; none: the coordinates, whose Laplacian is the mean curvature
 * vector (twice the mean curvature along the normal).
 *
 * Output port 0 (vtkPolyData): the input with
 * - point and cell data, double: `Gradient` (3 C components, the three of component 0 first; per
 *   unit of length) and `Laplacian` (C; per unit of length squared, negative at a maximum). Cells
 *   that are no polygons and points that no polygon uses get 0. A polygon has the mean of its
 *   triangles, weighted by area.
 *   Of an array of vectors (C = 3) also `Divergence` along the surface, where a part along the
 * normal counts with the curvature, and `Curl` (one component each; per unit of length): the part
 * of the rotation along the normal, positive counterclockwise seen from outside
 * - with HodgeDecomposition, of an array of vectors, point and cell data, double: `GradientPart`,
 *   `RotationPart` and `HarmonicPart` (three components each, in the unit of the array), and point
 *   data `Potential` and `StreamFunction` (one component, times a length), see below
 * - field data: `Converged`, `Iterations`, `DoublePrecisionSince`, `Residual`, `ConvergenceFactor`
 *   of the solve that took most iterations, and the estimated errors of vtkPoissonAlgorithm: how
 *   well the functions follow the array, its gradient and its Laplacian, the worst of them
 *
 * The Hodge decomposition: the part v of the vectors along the surface is grad u + n x grad w + h
 * with the normal n, the Potential u, the StreamFunction w, and the rest h, which has neither
 * sources nor eddies: it goes around handles and holes, and holds what the functions cannot follow.
 * The three are orthogonal: their squares integrate to that of v. On cells they add up to v, at
 * points they are projected like the gradient. Where the surface ends w is 0, so h does not cross
 * the boundary, and what does is in the gradient. Triangles that face this way and that are taken
 * to face as most of their component's area does; on components without two sides, as a Moebius
 * strip, there is no rotation part, and the filter warns. Edges of more than two triangles count
 * as a boundary for w.
 *
 * Accuracy, or a Tolerance, is that of the projections and potentials; a StreamFunction that is
 * held at boundaries is solved for to a Tolerance, 1e-4 where it is 0. NormalStabilization is 1e-2
 * by default. All shared properties but ParameterUnits are used.
 *
 * All ranks of MPI compute together; a HodgeDecomposition is left to rank 0.
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
   * When on, an array of vectors is taken apart: gradient, rotation, rest. Any other array is
   * refused then. Default off.
   */
  vtkSetMacro(HodgeDecomposition, bool);
  vtkGetMacro(HodgeDecomposition, bool);
  vtkBooleanMacro(HodgeDecomposition, bool);
  ///@}

  /**
   * The input of port 1: the basis.
   */
  void SetBasisConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }

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
