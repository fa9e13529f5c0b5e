#include "Problems/SurfaceDerivatives.h"

#include "Base/Parallel.h"
#include "Grid/TriangleArea.h"
#include "Problems/MovedSurface.h"
#include "Problems/Poisson.h"

#include <algorithm>

namespace gridfem
{
namespace
{

/// δ. Without it functions that hide in a flat surface are not known. Waves ten cells long lose 4
/// %, about what the space itself has as error in their gradients.
constexpr double Smoothing = 0.1;

/// Solves (M + δL) u = load for any number of columns, and keeps the worst report.
class L2Projection
{
public:
  L2Projection(const FiniteElementSpace& space, const DerivativeOptions& options, const Job& job)
    : space_(space),
      multigrid_(BuildMultigrid(space, 1.0 / Smoothing, 1.0, options.multigrid, job.progress))
  {
    poisson_.screeningWeight = 1.0 / Smoothing;
    poisson_.multigrid = options.multigrid;
    poisson_.solve = options.solve;
  }

  /// @param values, gradients  integrals of a field and of its gradient, which may have no rows
  MultiVector Solve(const MultiVector& values, const MultiVector& gradients, const Job& job)
  {
    PoissonSolution solution =
      SolvePoisson(space_, multigrid_, values, gradients, poisson_, job.progress);
    const bool isWorse = !solution.report.converged && report.converged;
    if (isWorse || (report.converged == solution.report.converged &&
                     solution.report.iterations >= report.iterations))
    {
      report = std::move(solution.report);
    }
    return std::move(solution.coefficients);
  }

  SolveReport report = []
  {
    SolveReport none;
    none.converged = true;
    return none;
  }();

private:
  const FiniteElementSpace& space_;
  Multigrid multigrid_;
  PoissonOptions poisson_;
};

/// Σ ∂_k of component k, for each vector: rows of nine numbers become one.
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

/// n · (∇ × v) for the gradients of v in rows of nine numbers, and a unit normal for each.
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

/// 0 for triangles without an area.
std::vector<Vec3> NormalsOfTriangles(const TriangleMesh& mesh)
{
  std::vector<Vec3> normals(mesh.triangles.size());
  std::transform(mesh.triangles.begin(), mesh.triangles.end(), normals.begin(),
    [&](const auto& corner) { return AreaVector(mesh.points, corner).stableNormalized(); });
  return normals;
}

void AddDerivativesOfVectors(const TriangleMesh& mesh, int threads, SurfaceDerivatives& derivatives)
{
  derivatives.divergenceOnTriangles = Divergence(derivatives.gradientOnTriangles);
  derivatives.divergenceAtPoints = Divergence(derivatives.gradientAtPoints);
  derivatives.curlOnTriangles = Curl(derivatives.gradientOnTriangles, NormalsOfTriangles(mesh));
  derivatives.curlAtPoints =
    Curl(derivatives.gradientAtPoints, NormalsAtPoints(mesh.points, mesh.triangles, threads));
}

} // namespace

SurfaceDerivatives ComputeDerivatives(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const Field& f, const DerivativeOptions& options, const Job& job)
{
  RequireField(f, mesh);
  SurfaceDerivatives result;
  L2Projection projection(space, options, job.Part(0.0, 0.2));
  const bool isOnPoints = f.association == FieldAssociation::Points;
  const MultiVector values = space.LoadOfValues(f, job.Part(0.2, 0.25));
  const MultiVector gradients =
    isOnPoints ? space.LoadOfGradientsOf(f, nullptr, job.Part(0.25, 0.3)) : MultiVector();
  const MultiVector u = projection.Solve(values, gradients, job.Part(0.3, 0.5));
  result.gradientOnTriangles = space.GradientsOnTriangles(u, job.threads);

  const MultiVector load = space.LoadOfValues(
    { FieldAssociation::Triangles, result.gradientOnTriangles }, job.Part(0.5, 0.55));
  const MultiVector gradient = projection.Solve(load, {}, job.Part(0.55, 0.8));
  result.gradientAtPoints = space.ValuesAtPoints(gradient, job.threads);
  result.laplacianOnTriangles = Divergence(space.GradientsOnTriangles(gradient, job.threads));

  const MultiVector loadOfLaplacian = space.LoadOfValues(
    { FieldAssociation::Triangles, result.laplacianOnTriangles }, job.Part(0.8, 0.85));
  result.laplacianAtPoints =
    space.ValuesAtPoints(projection.Solve(loadOfLaplacian, {}, job.Part(0.85, 1.0)), job.threads);
  if (f.values.cols() == 3)
  {
    AddDerivativesOfVectors(mesh, job.threads, result);
  }
  result.report = std::move(projection.report);
  return result;
}

} // namespace gridfem
