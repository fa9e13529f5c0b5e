#include "Shape/SurfaceDetail.h"

#include "Base/Errors.h"
#include "Base/Parallel.h"
#include "Grid/OrientedMesh.h"
#include "Grid/TriangleArea.h"
#include "Shape/MovedSurface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace gridfem
{
namespace
{

/// The mean of the corners' directions, each weighted by how distinct it is. Their signs follow the
/// corner with the most distinct direction.
Vec3 MeanDirection(const std::array<Id, 3>& corners, const PrincipalCurvatures& curvatures)
{
  const auto strength = [&](Id point)
  { return curvatures.maximum[point] - curvatures.minimum[point]; };
  const Id first = *std::max_element(
    corners.begin(), corners.end(), [&](Id a, Id b) { return strength(a) < strength(b); });
  const Vec3& sign = curvatures.maximumDirection[first];
  Vec3 sum = Vec3::Zero();
  for (const Id point : corners)
  {
    const Vec3& direction = curvatures.maximumDirection[point];
    sum += (direction.dot(sign) < 0.0 ? -strength(point) : strength(point)) * direction;
  }
  return sum;
}

} // namespace

TriangleCurvatures CurvaturesOnTriangles(
  const TriangleMesh& mesh, const PrincipalCurvatures& curvatures, int threads)
{
  const auto triangles = static_cast<Id>(mesh.triangles.size());
  TriangleCurvatures result;
  result.values.resize(triangles, 2);
  result.direction.resize(triangles);
  ParallelRanges(triangles, threads,
    [&](Id begin, Id end)
    {
      for (Id t = begin; t < end; ++t)
      {
        const auto& [a, b, c] = mesh.triangles[t];
        const auto mean = [a = a, b = b, c = c](const std::vector<double>& values)
        { return (values[a] + values[b] + values[c]) / 3.0; };
        result.values(t, 0) = mean(curvatures.maximum);
        result.values(t, 1) = mean(curvatures.minimum);
        result.direction[t] = MeanDirection(mesh.triangles[t], curvatures);
      }
    });
  return result;
}

double UsualCurvature(const TriangleMesh& mesh, const TriangleCurvatures& curvatures)
{
  constexpr double Share = 0.9;
  std::vector<double> size(mesh.triangles.size());
  std::vector<Id> order(mesh.triangles.size());
  double area = 0.0;
  for (Id t = 0; t < curvatures.values.rows(); ++t)
  {
    size[t] = curvatures.values.row(t).cwiseAbs().maxCoeff();
    area += AreaOf(mesh, t);
  }
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
    [&](Id a, Id b) { return size[a] != size[b] ? size[a] < size[b] : a < b; });
  double below = 0.0;
  for (const Id t : order)
  {
    below += AreaOf(mesh, t);
    if (below >= Share * area)
    {
      return size[t];
    }
  }
  return 0.0;
}

double SmoothStep(double x)
{
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double LengthOf(CurvatureTransfer transfer, double curvature, double largest)
{
  const auto partOfTheWay = [&]
  {
    switch (transfer)
    {
      case CurvatureTransfer::LargeNegative:
        return SmoothStep(-curvature);
      case CurvatureTransfer::LargePositive:
        return SmoothStep(curvature);
      case CurvatureTransfer::LargeAbsolute:
        return SmoothStep(std::abs(curvature));
      case CurvatureTransfer::Custom:
        return std::min(std::abs(curvature), 1.0);
      case CurvatureTransfer::Isotropic:
        break;
    }
    return 0.0;
  };
  return 1.0 + (largest - 1.0) * partOfTheWay();
}

std::vector<ElementWeights> WeightsOfMetric(
  const MultiVector& curvatures, const TransferFunction& alpha)
{
  const auto lengthOf = [&](double curvature)
  {
    const double length = alpha(curvature);
    if (!(length > 0.0) || std::isinf(length))
    {
      throw InvalidInput("The transfer function is " + std::to_string(length) +
                         " for the curvature " + std::to_string(curvature) +
                         "; it must be above 0 and finite.");
    }
    return length;
  };
  std::vector<ElementWeights> weights(curvatures.rows());
  for (Id element = 0; element < curvatures.rows(); ++element)
  {
    const double first = lengthOf(curvatures(element, 0));
    const double second = lengthOf(curvatures(element, 1));
    weights[element] = { first * second, { second / first, first / second } };
  }
  return weights;
}

SignalInSpace ShapeInSpace(const FiniteElementSpace& space, const Job& job)
{
  SignalInSpace signal;
  signal.coefficients = space.UnitLength() * space.EmbeddingOfMesh(job);
  signal.report = SolveReport::Solved();
  return signal;
}

SignalInSpace ProjectSignal(const FiniteElementSpace& space, const Field& f,
  const MultigridOptions& multigrid, const SolveOptions& solve, const Job& job)
{
  constexpr double Smoothing = 0.1; // squared units of length, as for SurfaceDerivatives
  const PoissonOptions options{ { multigrid, solve }, 1.0 / Smoothing };
  const MultiVector values = space.LoadOfValues(f, job.Part(0.0, 0.1));
  const MultiVector gradients = space.LoadOfGradientsOf(f, nullptr, job.Part(0.1, 0.2));
  const Multigrid hierarchy =
    BuildMultigrid(space, options.screeningWeight, 1.0, multigrid, job.progress.Part(0.2, 0.5));
  PoissonSolution solution =
    SolvePoisson(space, hierarchy, values, gradients, options, job.progress.Part(0.5, 1.0));
  SignalInSpace signal;
  signal.remainder = f.values - space.ValuesAtPoints(solution.coefficients, job);
  signal.coefficients = std::move(solution.coefficients);
  signal.report = std::move(solution.report);
  return signal;
}

void ScaleToVolume(
  const TriangleMesh& mesh, const std::vector<char>& moves, std::vector<Vec3>& points, int threads)
{
  const OrientedMesh oriented = Orient(mesh, true, threads);
  const double wanted = SizeOf(mesh.points, oriented.TrianglesOf(mesh), threads).volume;
  const SurfaceSize size = SizeOf(points, oriented.TrianglesOf(mesh), threads);
  const double factor = std::cbrt(wanted / size.volume);
  const bool isPossible = std::isfinite(factor) && factor > 0.0;
  for (std::size_t k = 0; isPossible && k < points.size(); ++k)
  {
    if (moves[k])
    {
      points[k] = size.centroid + factor * (points[k] - size.centroid);
    }
  }
}

} // namespace gridfem
