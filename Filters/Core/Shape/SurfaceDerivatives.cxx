#include "Shape/SurfaceDerivatives.h"

#include "Base/Parallel.h"
#include "Equations/L2Projection.h"
#include "Shape/MovedSurface.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

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

/// The triangles along a boundary, on which the slopes of projections are wrong. Collective.
class BoundaryStrip
{
public:
  /// @param onBoundary  as in ComputeDerivatives; null: there is no strip
  BoundaryStrip(const SurfaceSpace& space, const TriangleMesh& mesh, const MultiVector* onBoundary,
    L2Projection& projection, const EquationOptions& options, const Job& job)
    : space_(space), mesh_(mesh), options_(options)
  {
    if (onBoundary)
    {
      this->Measure(*onBoundary, projection, job.Part(0.0, 0.5));
      this->Weigh(job.Part(0.5, 1.0));
    }
  }

  bool IsThere() const { return projection_ != nullptr; }

  /// Makes the strip twice as wide, for slopes of a function that was continued into it.
  void Widen(const Job& job)
  {
    for (double& lost : lost_)
    {
      lost = std::sqrt(lost); // falls half as fast
    }
    this->Weigh(job);
  }

  /// Continues values on triangles into the strip. Returns the continued function.
  MultiVector Continue(MultiVector& onTriangles, const Job& job)
  {
    const MultiVector load = space_.LoadOfWeightedValues(
      { FieldAssociation::Triangles, onTriangles }, weight_, job.Part(0.0, 0.2));
    MultiVector u = projection_->Solve(load, {}, job.Part(0.2, 0.9));
    const MultiVector atPoints = space_.ValuesAtPoints(u, job.Part(0.9, 1.0));
    for (Id t = 0; t < onTriangles.rows(); ++t)
    {
      const auto& corner = mesh_.triangles[t];
      const Eigen::RowVectorXd continued =
        (atPoints.row(corner[0]) + atPoints.row(corner[1]) + atPoints.row(corner[2])) / 3.0;
      onTriangles.row(t) += (1.0 - weight_[t]) * (continued - onTriangles.row(t));
    }
    return u;
  }

  void AddReport(SurfaceDerivatives& result) const
  {
    KeepWorse(projection_->accuracy, result.accuracy);
    KeepWorse(projection_->report, result.report);
  }

private:
  /// Finds the part of a slope across the boundary that the projection removes. It is the whole
  /// slope at the boundary, and a share of about exp(-x / √δ) at the distance x. This part is
  /// itself the projection of a load on the boundary.
  void Measure(const MultiVector& onBoundary, L2Projection& projection, const Job& job)
  {
    const MultiVector layer = projection.Solve(
      std::sqrt(L2Projection::Smoothing) / space_.UnitLength() * onBoundary, {}, job);
    projection.accuracy = SolutionAccuracy::Exact(); // of the layer, which no one asked for
    const MultiVector lost = space_.ValuesAtPoints(layer.cwiseAbs(), job.threads);
    for (const auto& corner : mesh_.triangles)
    {
      lost_.push_back(std::max({ lost(corner[0], 0), lost(corner[1], 0), lost(corner[2], 0) }));
    }
  }

  /// Gives small weights to triangles where much of a slope is lost.
  void Weigh(const Job& job)
  {
    constexpr double Negligible = 0.03; // part of a slope
    constexpr double Smallest = 1e-6;   // keeps narrow surfaces determined
    weight_.clear();
    for (const double lost : lost_)
    {
      weight_.push_back(std::max(Smallest, std::pow(Negligible / std::max(lost, Negligible), 4)));
    }
    const std::unique_ptr<L2Projection> before = std::move(projection_);
    weighted_ = space_.WithWeightedMass(weight_, job.Part(0.0, 0.2));
    projection_ = std::make_unique<L2Projection>(*weighted_, options_, job.Part(0.2, 1.0));
    projection_->accuracy = before ? before->accuracy : SolutionAccuracy::Exact();
    projection_->report = before ? before->report : SolveReport::Solved();
  }

  const SurfaceSpace& space_;
  const TriangleMesh& mesh_;
  const EquationOptions& options_;
  std::vector<double> lost_;   // per triangle
  std::vector<double> weight_; // per triangle
  std::shared_ptr<const SurfaceSpace> weighted_;
  std::unique_ptr<L2Projection> projection_; // refers to it
};

/// Turns a field that is constant on triangles into a field with these slopes and the same means.
Field Tilted(const Field& f, const MultiVector& slopes, const TriangleMesh& mesh)
{
  Field tilted{ FieldAssociation::Corners, MultiVector(3 * f.values.rows(), f.values.cols()) };
  for (Id t = 0; t < f.values.rows(); ++t)
  {
    const auto& corner = mesh.triangles[t];
    const Vec3 middle =
      (mesh.points[corner[0]] + mesh.points[corner[1]] + mesh.points[corner[2]]) / 3.0;
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 way = mesh.points[corner[k]] - middle;
      for (Id c = 0; c < f.values.cols(); ++c)
      {
        tilted.values(3 * t + k, c) = f.values(t, c) + slopes(t, 3 * c) * way[0] +
                                      slopes(t, 3 * c + 1) * way[1] + slopes(t, 3 * c + 2) * way[2];
      }
    }
  }
  return tilted;
}

/// Projects a field into the space. Near a boundary, a field on triangles first gets the slopes
/// that its projection has farther inside.
MultiVector ProjectField(const SurfaceSpace& space, const TriangleMesh& mesh, const Field& f,
  L2Projection& projection, BoundaryStrip& strip, const Job& job)
{
  const MultiVector values = space.LoadOfValues(f, job.Part(0.0, 0.2));
  if (f.association == FieldAssociation::Points)
  {
    return projection.Solve(
      values, space.LoadOfGradientsOf(f, nullptr, job.Part(0.2, 0.4)), job.Part(0.4, 1.0));
  }
  MultiVector u = projection.Solve(values, {}, job.Part(0.2, 0.5));
  if (strip.IsThere() && f.association == FieldAssociation::Triangles)
  {
    Field slopes{ FieldAssociation::Triangles, space.GradientsOnTriangles(u, job.threads) };
    strip.Continue(slopes.values, job.Part(0.5, 0.7));
    const Field tilted = Tilted(f, slopes.values, mesh);
    u = projection.Solve(space.LoadOfValues(tilted, job.Part(0.7, 0.75)),
      space.LoadOfGradients(slopes, nullptr, job.Part(0.75, 0.8)), job.Part(0.8, 0.9));
    strip.Widen(job.Part(0.9, 1.0));
  }
  return u;
}

} // namespace

SurfaceDerivatives ComputeDerivatives(const SurfaceSpace& space, const TriangleMesh& mesh,
  const Field& f, const MultiVector* onBoundary, const EquationOptions& options, const Job& job)
{
  RequireField(f, mesh);
  SurfaceDerivatives result;
  L2Projection projection(space, options, job.Part(0.0, 0.1));
  BoundaryStrip strip(space, mesh, onBoundary, projection, options, job.Part(0.1, 0.25));
  const MultiVector u = ProjectField(space, mesh, f, projection, strip, job.Part(0.25, 0.45));
  result.gradientOnTriangles = space.GradientsOnTriangles(u, job.Part(0.45, 0.5));

  const MultiVector load = space.LoadOfValues(
    { FieldAssociation::Triangles, result.gradientOnTriangles }, job.Part(0.5, 0.55));
  const MultiVector gradient = projection.Solve(load, {}, job.Part(0.55, 0.75));
  result.gradientAtPoints = space.ValuesAtPoints(gradient, job.Part(0.75, 0.77));
  result.laplacianOnTriangles =
    Divergence(space.GradientsOnTriangles(gradient, job.Part(0.77, 0.8)));

  const MultiVector laplacian =
    strip.IsThere()
      ? strip.Continue(result.laplacianOnTriangles, job.Part(0.8, 1.0))
      : projection.Solve(
          space.LoadOfValues(
            { FieldAssociation::Triangles, result.laplacianOnTriangles }, job.Part(0.8, 0.85)),
          {}, job.Part(0.85, 1.0));
  result.laplacianAtPoints = space.ValuesAtPoints(laplacian, job.threads);
  if (f.values.cols() == 3)
  {
    AddDerivativesOfVectors(space, mesh, job.threads, result);
  }
  result.report = std::move(projection.report);
  result.accuracy = projection.accuracy;
  if (strip.IsThere())
  {
    strip.AddReport(result);
  }
  return result;
}

} // namespace gridfem
