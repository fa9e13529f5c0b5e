#include "Problems/SurfaceDerivatives.h"

#include "Base/Parallel.h"
#include "Problems/L2Projection.h"
#include "Problems/MovedSurface.h"

namespace gridfem
{
namespace
{

/// Σ ∂_k of component k, for each vector. Nine numbers of a row become one.
MultiVector Divergence(const MultiVector& gradients)
{
  const Id vectors = gradients.cols() / 9;
  MultiVector divergence(gradients.rows(), vectors);
  for (Id v = 0; v < vectors; ++v)
  {
    divergence.col(v) = gradients.col(9 * v) + gradients.col(9 * v + 4) + gradients.col(9 * v + 8);
  }
  return divergence;
}

/// n · (∇ × v), from the gradients of v in rows of nine numbers and a unit normal for each row.
MultiVector Curl(const MultiVector& gradients, const std::vector<Vec3>& normals)
{
  MultiVector curl(gradients.rows(), 1);
  for (Id k = 0; k < curl.rows(); ++k)
  {
    const auto g = gradients.row(k); // ∂_j v_i is g[3 i + j]
    curl(k, 0) = normals[k].dot(Vec3(g[7] - g[5], g[2] - g[6], g[3] - g[1]));
  }
  return curl;
}

void AddDerivativesOfVectors(
  const SurfaceSpace& space, const TriangleMesh& mesh, int threads, SurfaceDerivatives& derivatives)
{
  MultiVector areaVectors = AreaVectorsAtPoints(mesh.points, mesh.triangles);
  space.SumAtPoints(areaVectors);
  derivatives.divergenceOnTriangles = Divergence(derivatives.gradientOnTriangles);
  derivatives.divergenceAtPoints = Divergence(derivatives.gradientAtPoints);
  derivatives.curlOnTriangles = Curl(derivatives.gradientOnTriangles, NormalsOfTriangles(mesh));
  derivatives.curlAtPoints = Curl(derivatives.gradientAtPoints, UnitVectors(areaVectors, threads));
}

} // namespace

SurfaceDerivatives ComputeDerivatives(const SurfaceSpace& space, const TriangleMesh& mesh,
  const Field& f, const EquationOptions& options, const Job& job)
{
  RequireField(f, mesh);
  SurfaceDerivatives result;
  L2Projection projection(space, options, job.Part(0.0, 0.2));
  const bool isOnPoints = f.association == FieldAssociation::Points;
  const MultiVector values = space.LoadOfValues(f, job.Part(0.2, 0.25));
  const MultiVector gradients =
    isOnPoints ? space.LoadOfGradientsOf(f, nullptr, job.Part(0.25, 0.3)) : MultiVector();
  const MultiVector u = projection.Solve(values, gradients, job.Part(0.3, 0.45));
  result.gradientOnTriangles = space.GradientsOnTriangles(u, job.Part(0.45, 0.5));

  const MultiVector load = space.LoadOfValues(
    { FieldAssociation::Triangles, result.gradientOnTriangles }, job.Part(0.5, 0.55));
  const MultiVector gradient = projection.Solve(load, {}, job.Part(0.55, 0.75));
  result.gradientAtPoints = space.ValuesAtPoints(gradient, job.Part(0.75, 0.77));
  result.laplacianOnTriangles =
    Divergence(space.GradientsOnTriangles(gradient, job.Part(0.77, 0.8)));

  const MultiVector loadOfLaplacian = space.LoadOfValues(
    { FieldAssociation::Triangles, result.laplacianOnTriangles }, job.Part(0.8, 0.85));
  result.laplacianAtPoints =
    space.ValuesAtPoints(projection.Solve(loadOfLaplacian, {}, job.Part(0.85, 1.0)), job.threads);
  if (f.values.cols() == 3)
  {
    AddDerivativesOfVectors(space, mesh, job.threads, result);
  }
  result.report = std::move(projection.report);
  result.accuracy = projection.accuracy;
  return result;
}

} // namespace gridfem
