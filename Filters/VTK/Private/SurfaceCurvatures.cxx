#include "SurfaceCurvatures.h"

namespace gridfem
{
namespace
{

/// The triangles around the points, in units of the mesh's longest side.
HatFunctions TrianglesAroundPoints(const TriangleMesh& mesh, bool weldCoincidentPoints, int threads)
{
  const Bounds bounds = BoundsOf(mesh.points, UsedPoints(mesh, threads), threads);
  HatOptions options;
  options.weldCoincidentPoints = weldCoincidentPoints;
  options.unitLength = (bounds.high - bounds.low).maxCoeff();
  options.threads = threads;
  return NumberHatFunctions(mesh, options);
}

} // namespace

PrincipalCurvatures CurvaturesOfSurface(const SurfaceSolverState& state, const TriangleMesh& mesh,
  double scale, SolveReport& report, const Progress& progress)
{
  const int threads = state.options.space.threads;
  const HatFunctions around =
    TrianglesAroundPoints(mesh, state.options.space.weldCoincidentPoints, threads);
  MultiVector normals = PointNormals(mesh, around, threads);
  progress.Check(0.2);
  if (scale > 0.0)
  {
    NormalSmoothing smoothing;
    smoothing.scale = state.LengthInWorldUnits(scale);
    smoothing.multigrid = state.options.multigrid;
    smoothing.solve = state.options.solve;
    normals = SmoothNormals(
      *state.space, normals, smoothing, report, state.MakeJob(progress.Part(0.2, 0.7)));
  }
  return ComputeCurvatures(mesh, around, normals, state.MakeJob(progress.Part(0.7, 1.0)));
}

} // namespace gridfem
