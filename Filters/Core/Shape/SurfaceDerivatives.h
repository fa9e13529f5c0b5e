// Computes the surface gradient and the Laplacian of a given field, in the weak sense of a space.
#ifndef GridFEM_SurfaceDerivatives_h
#define GridFEM_SurfaceDerivatives_h

#include "Equations/Poisson.h"
#include "Spaces/SurfaceSpace.h"

namespace gridfem
{

/// Derivatives of a field, in world units. C is its number of components; vectors are in columns 3c
/// .. 3c+2.
struct SurfaceDerivatives
{
  MultiVector gradientOnTriangles; // 3 C columns, in the planes of the triangles
  MultiVector gradientAtPoints;    // 3 C columns; 0 at points that no function reaches
  MultiVector laplacianOnTriangles;
  MultiVector laplacianAtPoints; // div grad f: negative at a maximum
  /// Only for a field with three components, a vector field v; else without columns. The divergence
  /// along the surface includes the normal part of v, times the curvature. The curl is n · rot v
  /// with the normal n of the triangle, or the mean normal around the point.
  MultiVector divergenceOnTriangles;
  MultiVector divergenceAtPoints;
  MultiVector curlOnTriangles;
  MultiVector curlAtPoints;
  SolveReport report;        // of the projection with the most iterations
  SolutionAccuracy accuracy; // of the worst projection
};

/// Projects the field into the space, and its gradient on triangles once more. The Laplacian is the
/// divergence of the second projection.
/// A projection u of g solves (M + δL) u = ∫ g b_i with δ a tenth of a squared unit of length. This
/// smooths less than a grid of that unit does. The projection of a field on points also uses its
/// gradient ∇f, so that a function of the space does not change.
/// The smoothing flattens a projection towards a boundary, within about a unit of length. Slopes of
/// projections are therefore not used there, but continued from the triangles farther inside. Up to
/// the boundary, gradients are of first order. The Laplacian of a field on points is of first
/// order, too. An error of about 3 % remains in the Laplacian, for a field on triangles about a
/// sixth.
/// @param mesh        that the space was made from
/// @param onBoundary  ∫ b_i over the boundary, in world units, one column; null: no boundary
/// Throws InvalidInput when the field does not fit, and Aborted. Same bits for any number of
/// threads. Collective.
SurfaceDerivatives ComputeDerivatives(const SurfaceSpace& space, const TriangleMesh& mesh,
  const Field& f, const MultiVector* onBoundary, const EquationOptions& options,
  const Job& job = {});

} // namespace gridfem

#endif
