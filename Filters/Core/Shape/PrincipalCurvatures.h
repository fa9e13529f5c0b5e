// Principal curvatures of a triangle mesh. The turn of its normals along the surface is fitted on
// every triangle and gathered at the points. [Rusinkiewicz, Estimating Curvatures and Their
// Derivatives on Triangle Meshes, 3DPVT 2004]
#ifndef GridFEM_PrincipalCurvatures_h
#define GridFEM_PrincipalCurvatures_h

#include "Krylov/ConjugateGradients.h"
#include "Spaces/FiniteElementSpace.h"
#include "Spaces/HatFunctions.h"

namespace gridfem
{

/// Curvatures at the points of the mesh, per world length. Points without a triangle that has an
/// area get 0 and no direction. Curvatures are positive where the surface is convex, seen from the
/// side of its normals. Directions are unit vectors in the tangent plane, up to their sign; they
/// are arbitrary where both curvatures are equal.
struct PrincipalCurvatures
{
  std::vector<double> minimum;
  std::vector<double> maximum; // never below the minimum
  std::vector<Vec3> minimumDirection;
  std::vector<Vec3> maximumDirection;
};

/// Unit normals at the points, exact for points of a sphere. They are the normals of the triangles,
/// weighted as in Max, Weights for Computing Vertex Normals from Facet Normals, 1999. If triangles
/// of opposite orientation cancel, the point takes the normal of the first triangle. Points without
/// a triangle get 0. Normals at a boundary follow from the neighbors' normals, so that a quadratic
/// surface keeps its curvature there.
/// @param hats  of the mesh: the triangles around each point, with coincident points welded or not
/// @return      points x 3
MultiVector PointNormals(const TriangleMesh& mesh, const HatFunctions& hats, int threads = 0);

struct NormalSmoothing
{
  double scale = 0.0; // world length: standard deviation of a Gaussian; above 0
  MultigridOptions multigrid;
  SolveOptions solve;
};

/// Removes detail smaller than the scale from normals, by one implicit step of diffusion. Its time
/// is half of the squared scale. The normals are then scaled to unit length again. The normals of a
/// sphere and of a cylinder stay the same.
/// @param report  of the solver
MultiVector SmoothNormals(const FiniteElementSpace& space, const MultiVector& normals,
  const NormalSmoothing& options, SolveReport& report, const Job& job = {});

/// The curvatures of the surface with these normals. On every triangle the second fundamental form
/// is fitted to the differences of the normals along its edges. A point takes the mean over its
/// triangles, rotated into its tangent plane and weighted by the part of their area that is nearest
/// to it. A triangle with the opposite orientation to its neighbors counts as turned round.
/// @param normals  points x 3, unit or zero
/// Throws InvalidInput when the rows do not fit. Same bits for any number of threads.
PrincipalCurvatures ComputeCurvatures(const TriangleMesh& mesh, const HatFunctions& hats,
  const MultiVector& normals, const Job& job = {});

/// The facts about a computation of curvatures.
struct CurvatureReport
{
  SolveReport smoothing;
  Id turned = 0;      // triangles that faced against their component and count as turned round
  Index oneSided = 0; // components that have no outside, such as a Möbius strip
};

/// Computes the curvatures of a surface from start to end, with or without smoothing. The triangles
/// of a component are first made to face alike (Orient).
/// @param weldCoincidentPoints  coincident points share their triangles
/// @param space      of the mesh; null if nothing is smoothed
/// @param smoothing  scale 0: no smoothing
PrincipalCurvatures CurvaturesOfSurface(const TriangleMesh& mesh, bool weldCoincidentPoints,
  const FiniteElementSpace* space, const NormalSmoothing& smoothing, CurvatureReport& report,
  const Job& job = {});

/// Koenderink's shape index in [-1, 1]: -1 cup, -0.5 rut, 0 saddle, 0.5 ridge, 1 cap; 0 if both
/// curvatures are 0.
double ShapeIndex(double minimum, double maximum);

/// Mean curvatures H for display: 2/π atan(H / h), in (-1, 1). The unit h is the median of |H|, so
/// half of the points lie beyond ±0.5, and a few extremes do not matter. It is at least 1/√area, so
/// that flat parts stay near 0.
std::vector<double> BendingOf(const std::vector<double>& meanCurvature, double area);

} // namespace gridfem

#endif
