#include "Shape/MovedSurface.h"

#include "Base/Parallel.h"
#include "Base/UnionFind.h"
#include "Grid/TriangleArea.h"
#include "Grid/TriangleSides.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gridfem
{
namespace
{

std::vector<double> Areas(const TriangleMesh& mesh, int threads)
{
  std::vector<double> area(mesh.triangles.size());
  ParallelRanges(static_cast<Id>(area.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id t = begin; t < end; ++t)
      {
        area[t] = 0.5 * AreaVector(mesh.points, mesh.triangles[t]).norm();
      }
    });
  return area;
}

/// The area, and the moment of the area about a point.
Eigen::Vector4d AreaMoments(const std::vector<Vec3>& points,
  const std::vector<std::array<Id, 3>>& triangles, const Vec3& about, int threads)
{
  const auto sum = [&](Id begin, Id end)
  {
    Eigen::Vector4d moments = Eigen::Vector4d::Zero();
    for (Id t = begin; t < end; ++t)
    {
      const auto& [a, b, c] = triangles[t];
      const double area = 0.5 * AreaVector(points, triangles[t]).norm();
      const Vec3 center = (points[a] + points[b] + points[c]) / 3.0 - about;
      moments += area * Eigen::Vector4d(1.0, center[0], center[1], center[2]);
    }
    return moments;
  };
  return ParallelSum(
    static_cast<Id>(triangles.size()), threads, Eigen::Vector4d(Eigen::Vector4d::Zero()), sum);
}

double VolumeAbout(const Vec3& center, const std::vector<Vec3>& points,
  const std::vector<std::array<Id, 3>>& triangles, int threads)
{
  const auto sum = [&](Id begin, Id end)
  {
    double volume = 0.0;
    for (Id t = begin; t < end; ++t)
    {
      const auto& [a, b, c] = triangles[t];
      volume += (points[a] - center).dot((points[b] - center).cross(points[c] - center)) / 6.0;
    }
    return volume;
  };
  return ParallelSum(static_cast<Id>(triangles.size()), threads, 0.0, sum);
}

/// The larger over the smaller singular value of the map between two triangles. With the trace T of
/// its metric and the ratio D of the areas, they are (√(T + 2D) ± √(T - 2D)) / 2.
double StretchRatio(const Vec3& u, const Vec3& v, double ratio, const Vec3& a, const Vec3& b)
{
  // The trace of the metric in the triangle's plane: (|a|²|v|² - 2 <a,b><u,v> + |b|²|u|²) / |u ×
  // v|².
  const double square = u.cross(v).squaredNorm();
  const double trace = (a.squaredNorm() * v.squaredNorm() - 2.0 * a.dot(b) * u.dot(v) +
                         b.squaredNorm() * u.squaredNorm()) /
                       square;
  const double plus = std::sqrt(std::max(trace + 2.0 * ratio, 0.0));
  const double minus = std::sqrt(std::max(trace - 2.0 * ratio, 0.0));
  // The product of both stretches is the ratio. It gives the smaller one without cancellation.
  const double larger = 0.5 * (plus + minus);
  const double quotient = larger * larger / ratio;
  return quotient < MapDistortion::LargestRatio ? std::max(quotient, 1.0)
                                                : MapDistortion::LargestRatio;
}

} // namespace

double SurfaceSize::Sphericity() const
{
  return area > 0.0
           ? std::cbrt(double(EIGEN_PI)) * std::pow(6.0 * std::abs(volume), 2.0 / 3.0) / area
           : 0.0;
}

SurfaceSize SizeOf(
  const std::vector<Vec3>& points, const std::vector<std::array<Id, 3>>& triangles, int threads)
{
  SurfaceSize size;
  if (triangles.empty())
  {
    return size;
  }
  const Vec3& near = points[triangles.front()[0]];
  const Eigen::Vector4d moments = AreaMoments(points, triangles, near, threads);
  size.area = moments[0];
  size.centroid = near;
  if (size.area > 0.0)
  {
    size.centroid += moments.tail<3>() / size.area;
  }
  size.volume = VolumeAbout(size.centroid, points, triangles, threads);
  return size;
}

MapDistortion DistortionOf(const TriangleMesh& mesh, const std::vector<Vec3>& moved, int threads)
{
  MapDistortion distortion;
  distortion.areaRatio.assign(mesh.triangles.size(), 1.0);
  distortion.stretchRatio.assign(mesh.triangles.size(), 1.0);
  ParallelRanges(static_cast<Id>(mesh.triangles.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id t = begin; t < end; ++t)
      {
        const std::array<Id, 3>& corner = mesh.triangles[t];
        const double area = AreaVector(mesh.points, corner).norm();
        const double ratio = AreaVector(moved, corner).norm() / area;
        if (!(area > 0.0) || !std::isfinite(ratio))
        {
          continue;
        }
        distortion.areaRatio[t] = ratio;
        distortion.stretchRatio[t] =
          ratio > 0.0 ? StretchRatio(mesh.points[corner[1]] - mesh.points[corner[0]],
                          mesh.points[corner[2]] - mesh.points[corner[0]], ratio,
                          moved[corner[1]] - moved[corner[0]], moved[corner[2]] - moved[corner[0]])
                      : MapDistortion::LargestRatio;
      }
    });
  return distortion;
}

std::vector<double> MeansAtPoints(
  const TriangleMesh& mesh, const std::vector<double>& onTriangles, double none, int threads)
{
  const std::vector<double> area = Areas(mesh, threads);
  std::vector<double> mean(mesh.points.size(), 0.0);
  std::vector<double> weight(mesh.points.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (const Id point : mesh.triangles[t])
    {
      mean[point] += area[t] * onTriangles[t];
      weight[point] += area[t];
    }
  }
  for (std::size_t point = 0; point < mean.size(); ++point)
  {
    mean[point] = weight[point] > 0.0 ? mean[point] / weight[point] : none;
  }
  return mean;
}

double MeanOverSurface(
  const TriangleMesh& mesh, const std::vector<double>& onTriangles, int threads)
{
  const std::vector<double> area = Areas(mesh, threads);
  const auto sum = [&](Id begin, Id end)
  {
    Eigen::Vector2d sums = Eigen::Vector2d::Zero();
    for (Id t = begin; t < end; ++t)
    {
      sums += area[t] * Eigen::Vector2d(1.0, onTriangles[t]);
    }
    return sums;
  };
  const Eigen::Vector2d sums = ParallelSum(
    static_cast<Id>(area.size()), threads, Eigen::Vector2d(Eigen::Vector2d::Zero()), sum);
  return sums[0] > 0.0 ? sums[1] / sums[0] : 0.0;
}

std::vector<Vec3> NormalsOfTriangles(const TriangleMesh& mesh)
{
  std::vector<Vec3> normals(mesh.triangles.size());
  std::transform(mesh.triangles.begin(), mesh.triangles.end(), normals.begin(),
    [&](const auto& corner) { return AreaVector(mesh.points, corner).stableNormalized(); });
  return normals;
}

MultiVector AreaVectorsAtPoints(
  const std::vector<Vec3>& points, const std::vector<std::array<Id, 3>>& triangles)
{
  MultiVector sum = MultiVector::Zero(static_cast<Id>(points.size()), 3);
  for (const std::array<Id, 3>& corner : triangles)
  {
    const Vec3 areaVector = AreaVector(points, corner);
    for (const Id point : corner)
    {
      sum.block<1, 3>(point, 0) += areaVector.transpose();
    }
  }
  return sum;
}

std::vector<Vec3> UnitVectors(const MultiVector& rows, int threads)
{
  std::vector<Vec3> unit(rows.rows());
  ParallelRanges(rows.rows(), threads,
    [&](Id begin, Id end)
    {
      for (Id k = begin; k < end; ++k)
      {
        const Vec3 vector = rows.row(k).transpose();
        const double length = vector.norm();
        unit[k] = length > 0.0 ? Vec3(vector / length) : Vec3(Vec3::Zero());
      }
    });
  return unit;
}

std::vector<Vec3> NormalsAtPoints(
  const std::vector<Vec3>& points, const std::vector<std::array<Id, 3>>& triangles, int threads)
{
  return UnitVectors(AreaVectorsAtPoints(points, triangles), threads);
}

bool IsLikeASphere(const TriangleMesh& mesh, int threads)
{
  const std::vector<TriangleSide> sides =
    SortedSides(mesh, WeldCoincidentPoints(mesh.points, {}, threads));
  UnionFind pieces(static_cast<Id>(mesh.points.size()));
  std::vector<char> isUsed(mesh.points.size(), 0);
  for (const TriangleSide& side : sides)
  {
    pieces.Unite(side.low, side.high);
    isUsed[side.low] = isUsed[side.high] = 1;
  }
  bool isClosed = true;
  Id edges = 0;
  ForEachEdge(sides,
    [&](const TriangleSide*, Id triangles)
    {
      isClosed &= triangles == 2;
      ++edges;
    });
  Id points = 0;
  Id components = 0;
  for (std::size_t k = 0; k < isUsed.size(); ++k)
  {
    points += isUsed[k];
    components += isUsed[k] && pieces.IsRoot(static_cast<Index>(k));
  }
  const Id triangles = static_cast<Id>(sides.size()) / 3;
  return isClosed && components == 1 && points - edges + triangles == 2;
}

SurfaceBoundary BoundaryOf(const TriangleMesh& mesh, bool weldCoincidentPoints, int threads)
{
  SurfaceBoundary boundary;
  boundary.edges = FindSurfaceEdges(mesh, weldCoincidentPoints, threads).boundary;
  boundary.points = EndsOf(boundary.edges, mesh);
  if (weldCoincidentPoints)
  {
    const Array<Index> pointClass = WeldCoincidentPoints(mesh.points, {}, threads);
    std::vector<char> isEnd(mesh.points.size(), 0);
    for (const Id point : boundary.points)
    {
      isEnd[pointClass[point]] = 1;
    }
    boundary.points.clear();
    for (std::size_t k = 0; k < pointClass.size(); ++k)
    {
      if (isEnd[pointClass[k]])
      {
        boundary.points.push_back(static_cast<Id>(k));
      }
    }
  }
  return boundary;
}

} // namespace gridfem
