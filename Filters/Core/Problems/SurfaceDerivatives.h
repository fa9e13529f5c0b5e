// The surface gradient and the Laplacian of a given field, in the weak sense of a space.
#ifndef GridFEM_SurfaceDerivatives_h
#define GridFEM_SurfaceDerivatives_h

#include "Problems/Poisson.h"
#include "Spaces/SurfaceSpace.h"

namespace gridfem
{

/// World units. C components of the field; vectors in columns 3c .. 3c+2.
struct SurfaceDerivatives
{
  MultiVector gradientOnTriangles; // 3 C columns, in the planes of the triangles
  MultiVector gradientAtPoints;    // 3 C columns; 0 at points that no function reaches
  MultiVector laplacianOnTriangles;
  MultiVector laplacianAtPoints; // div grad f: negative at a maximum
  /// Of a field with three components, the vectors v; else without columns. The divergence along
  /// the surface, where a part of v along the normal counts with the curvature, and n · rot v with
  /// the normal n, of the triangle or the mean around the point.
  MultiVector divergenceOnTriangles;
  MultiVector divergenceAtPoints;
  MultiVector curlOnTriangles;
  MultiVector curlAtPoints;
  SolveReport report;        // of the projection that took most iterations
  SolutionAccuracy accuracy; // of the worst one
};

/// The field is projected into the space, its gradient on triangles is projected again, and the
/// Laplacian is the divergence of that: so it needs no condition at a boundary. A projection u of g
/// solves (M + δL) u = ∫ g b_i with δ a tenth of a squared unit of length, which smooths less than
/// a grid of that unit does; a field on points has its ∇f beside it, so that a function of the
/// space stays what it is.
/// @param triangles  of the mesh that the space was made from
/// Throws InvalidInput when the field does not fit, and Aborted. Same bits for any number of
/// threads. Where processes hold the surface together, all of them call it, as SolvePoisson.
SurfaceDerivatives ComputeDerivatives(const SurfaceSpace& space, const TriangleMesh& mesh,
  const Field& f, const EquationOptions& options, const Job& job = {});

} // namespace gridfem

#endif
