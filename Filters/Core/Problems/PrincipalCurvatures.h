// Principal curvatures of a triangle mesh: how its normals turn along the surface, fitted on every
// triangle and gathered at the points. [Rusinkiewicz, Estimating Curvatures and Their Derivatives
// on Triangle Meshes, 3DPVT 2004]
#ifndef GridFEM_PrincipalCurvatures_h
#define GridFEM_PrincipalCurvatures_h

#include "Krylov/ConjugateGradients.h"
#include "Spaces/FiniteElementSpace.h"
#include "Spaces/HatFunctions.h"

namespace gridfem
{

/// One entry per point of the mesh, per world length; 0, and no direction, at points without a
/// triangle that has an area. A surface that is convex seen from where its normals point has
/// positive curvatures. Directions are unit vectors across the normal, up to their sign; where both
/// curvatures are equal they are any two.
struct PrincipalCurvatures
{
  std::vector<double> minimum;
  std::vector<double> maximum; // never below the minimum
  std::vector<Vec3> minimumDirection;
  std::vector<Vec3> maximumDirection;
};

/// Unit normals at the points, exact for the points of a sphere: those of the triangles, weighted
/// as in Max, Weights for Computing Vertex Normals from Facet Normals, 1999. Where triangles of
/// opposite orientation cancel, that of the first one; 0 at points without a triangle. At a
/// boundary they follow from those of the neighbours, so that a quadratic surface keeps its
/// curvature there.
/// @param hats  of the mesh: which triangles are around a point, coincident ones welded or not
/// @return  points x 3
MultiVector PointNormals(const TriangleMesh& mesh, const HatFunctions& hats, int threads = 0);

struct NormalSmoothing
{
  double scale = 0.0; // world length: that of a Gaussian's standard deviation; above 0
  MultigridOptions multigrid;
  SolveOptions solve;
};

/// Normals without what is smaller than the scale: one implicit step of diffusion, whose time is
/// half of the squared scale, and unit length again. A sphere and a cylinder keep theirs.
/// @param report  of the solver
MultiVector SmoothNormals(const FiniteElementSpace& space, const MultiVector& normals,
  const NormalSmoothing& options, SolveReport& report, const Job& job = {});

/// The curvatures of the surface that has these normals. On every triangle the second fundamental
/// form is fitted to how the normals differ along its edges; a point takes the mean over its
/// triangles, turned into its tangent plane, weighted by the part of their area that is nearest to
/// it. A triangle that is turned the other way than its neighbours counts as turned round.
/// @param normals  points x 3, unit or zero
/// Throws InvalidInput when the rows do not fit. Same bits for any number of threads.
PrincipalCurvatures ComputeCurvatures(const TriangleMesh& mesh, const HatFunctions& hats,
  const MultiVector& normals, const Job& job = {});

/// All of this in one go, also without smoothing.
/// @param weldCoincidentPoints  triangles around coincident points are around one
/// @param space      of the mesh; null where nothing is smoothed
/// @param smoothing  of scale 0: none
/// @param report     of the smoothing
PrincipalCurvatures CurvaturesOfSurface(const TriangleMesh& mesh, bool weldCoincidentPoints,
  const FiniteElementSpace* space, const NormalSmoothing& smoothing, SolveReport& report,
  const Job& job = {});

/// Koenderink's shape index in [-1, 1]: -1 cup, -0.5 rut, 0 saddle, 0.5 ridge, 1 cap; 0 where both
/// curvatures are.
double ShapeIndex(double minimum, double maximum);

/// Mean curvatures H for the eye: 2/π atan(H / h), in (-1, 1). Half of the points lie beyond ±0.5,
/// whatever a few extremes are: h is the median of |H|, and at least 1/√area, so that what is flat
/// stays near 0.
std::vector<double> BendingOf(const std::vector<double>& meanCurvature, double area);

} // namespace gridfem

#endif
