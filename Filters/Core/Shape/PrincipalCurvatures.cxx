#include "Shape/PrincipalCurvatures.h"

#include "Base/Errors.h"
#include "Base/Parallel.h"
#include "Equations/Poisson.h"
#include "Grid/OrientedMesh.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gridfem
{
namespace
{

/// A symmetric tensor in the plane across a normal.
using Tensor = Eigen::Matrix3d;

void RequireHats(const TriangleMesh& mesh, const HatFunctions& hats)
{
  if (hats.ofPoint.size() != mesh.points.size())
  {
    throw InvalidInput("The triangles around the points are those of another mesh.");
  }
}

/// Calls body(function) for all functions, in parallel.
template<class Body>
void ForEachFunction(const HatFunctions& hats, int threads, Body&& body)
{
  ParallelRanges(hats.Count(), threads,
    [&](Id begin, Id end)
    {
      for (Id function = begin; function < end; ++function)
      {
        body(function);
      }
    });
}

/// The normal of a corner's triangle with the weight of Max.
Vec3 WeightedNormal(const HatTriangle& triangle, int corner)
{
  const double first = triangle.edge[(corner + 1) % 3].squaredNorm();
  const double second = triangle.edge[(corner + 2) % 3].squaredNorm();
  return triangle.areaVector / (first * second);
}

Vec3 NormalOf(const TriangleMesh& mesh, const HatFunctions& hats, Id function)
{
  constexpr double Canceled = 1e-6;
  Vec3 sum = Vec3::Zero();
  Vec3 first = Vec3::Zero();
  double size = 0.0;
  for (Id k = hats.begin[function]; k < hats.begin[function + 1]; ++k)
  {
    const TriangleCorner corner = hats.corners[k];
    const HatTriangle triangle(mesh, corner.Triangle(), hats.unitLength);
    const Vec3 normal = WeightedNormal(triangle, corner.Corner());
    first = k == hats.begin[function] ? normal : first;
    sum += normal;
    size += normal.norm();
  }
  return (sum.norm() > Canceled * size ? sum : first).stableNormalized();
}

/// The neighbors of a function: the functions at the other corners of its triangles, each once.
struct Neighbors
{
  std::vector<Index> all;
  bool isAtBoundary = false; // some edge has only one triangle

  void Collect(const TriangleMesh& mesh, const HatFunctions& hats, Id function)
  {
    all.clear();
    isAtBoundary = false;
    for (Id k = hats.begin[function]; k < hats.begin[function + 1]; ++k)
    {
      const std::array<Id, 3>& corners = mesh.triangles[hats.corners[k].Triangle()];
      for (int side = 1; side < 3; ++side)
      {
        all.push_back(hats.ofPoint[corners[(hats.corners[k].Corner() + side) % 3]]);
      }
    }
    std::sort(all.begin(), all.end());
    for (std::size_t k = 0; k < all.size() && !isAtBoundary; ++k)
    {
      isAtBoundary =
        (k == 0 || all[k - 1] != all[k]) && (k + 1 == all.size() || all[k + 1] != all[k]);
    }
    all.erase(std::unique(all.begin(), all.end()), all.end());
  }
};

/// One mesh point for each function, any of the points that share it.
std::vector<Index> PointsOfFunctions(const HatFunctions& hats)
{
  std::vector<Index> point(hats.Count());
  for (std::size_t p = 0; p < hats.ofPoint.size(); ++p)
  {
    if (hats.ofPoint[p] >= 0)
    {
      point[hats.ofPoint[p]] = static_cast<Index>(p);
    }
  }
  return point;
}

/// Corrects normals at a boundary, whose triangles are all on one side. On a quadratic surface, the
/// mean of the normals at the ends of an edge is perpendicular to the edge. Edges to points with
/// known normals therefore determine the normal.
class BoundaryNormals
{
public:
  BoundaryNormals(const TriangleMesh& mesh, const HatFunctions& hats, MultiVector& normals)
    : mesh_(mesh), hats_(hats), normals_(normals), point_(PointsOfFunctions(hats)),
      known_(hats.Count(), 1)
  {
  }

  void Correct(int threads)
  {
    const std::vector<Index> boundary = this->Find(threads);
    // Corners come later than the points next to them.
    constexpr int Passes = 4;
    for (int pass = 0; pass < Passes; ++pass)
    {
      std::vector<std::pair<Index, Vec3>> corrected;
      Neighbors neighbors;
      for (const Index function : boundary)
      {
        neighbors.Collect(mesh_, hats_, function);
        Vec3 normal;
        if (!known_[function] && this->Fit(function, neighbors.all, normal))
        {
          corrected.emplace_back(function, normal);
        }
      }
      for (const auto& [function, normal] : corrected)
      {
        std::copy(normal.data(), normal.data() + 3, &normals_(function, 0));
        known_[function] = 1;
      }
    }
  }

private:
  Vec3 NormalAt(Index function) const { return Eigen::Map<const Vec3>(&normals_(function, 0)); }

  std::vector<Index> Find(int threads)
  {
    ParallelRanges(hats_.Count(), threads,
      [&](Id begin, Id end)
      {
        Neighbors neighbors;
        for (Id function = begin; function < end; ++function)
        {
          neighbors.Collect(mesh_, hats_, function);
          known_[function] = !neighbors.isAtBoundary;
        }
      });
    std::vector<Index> boundary;
    for (Index function = 0; function < hats_.Count(); ++function)
    {
      if (!known_[function])
      {
        boundary.push_back(function);
      }
    }
    return boundary;
  }

  /// @return  false if the known neighbors lie along one line
  bool Fit(Index function, const std::vector<Index>& neighbors, Vec3& normal) const
  {
    constexpr double SmallestSpread = 1e-3;
    const Vec3 own = this->NormalAt(function);
    const Vec3 first = own.unitOrthogonal();
    const Vec3 second = own.cross(first);
    Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    for (const Index neighbor : neighbors)
    {
      const Vec3 edge = mesh_.points[point_[neighbor]] - mesh_.points[point_[function]];
      const Vec3 other = this->NormalAt(neighbor);
      if (known_[neighbor] && other.dot(own) > 0.0)
      {
        const Vec3 direction = edge.stableNormalized();
        const Eigen::Vector2d row(first.dot(direction), second.dot(direction));
        A += row * row.transpose();
        b -= (own + other).dot(direction) * row;
      }
    }
    if (!(A.determinant() > SmallestSpread * A.trace() * A.trace()))
    {
      return false;
    }
    const Eigen::Vector2d change = A.inverse() * b;
    normal = (own + change[0] * first + change[1] * second).normalized();
    return true;
  }

  const TriangleMesh& mesh_;
  const HatFunctions& hats_;
  MultiVector& normals_;
  std::vector<Index> point_;
  std::vector<char> known_;
};

/// 1, or -1 if a normal points to the other side of a triangle.
double SideOf(const Vec3& normal, const Vec3& ofTriangle)
{
  return normal.dot(ofTriangle) < 0.0 ? -1.0 : 1.0;
}

/// The second fundamental form that best fits the differences of the normals along the edges.
/// [Rusinkiewicz 2004, §2]
Tensor FitTriangle(const HatTriangle& triangle, const std::array<Vec3, 3>& normals)
{
  constexpr double Regularization = 1e-14; // for the unknown height of needles
  const Vec3 normal = triangle.areaVector.normalized();
  const Vec3 first = triangle.edge[0].normalized();
  const Vec3 second = normal.cross(first);
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Vec3 b = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
  {
    const double u = triangle.edge[k].dot(first);
    const double v = triangle.edge[k].dot(second);
    const int from = (k + 1) % 3;
    const int to = (k + 2) % 3;
    const Vec3 turn =
      SideOf(normals[to], normal) * normals[to] - SideOf(normals[from], normal) * normals[from];
    const double p = turn.dot(first);
    const double q = turn.dot(second);
    A(0, 0) += u * u;
    A(0, 1) += u * v;
    A(2, 2) += v * v;
    b += Vec3(p * u, p * v + q * u, q * v);
  }
  A(1, 1) = A(0, 0) + A(2, 2);
  A(1, 0) = A(2, 1) = A(1, 2) = A(0, 1);
  A.diagonal().array() += Regularization * A(1, 1);
  const Vec3 form = A.ldlt().solve(b);
  return form[0] * first * first.transpose() + form[2] * second * second.transpose() +
         form[1] * (first * second.transpose() + second * first.transpose());
}

/// The part of a triangle's area that is nearest to a corner. In an obtuse triangle, half belongs
/// to the obtuse corner and a quarter to each of the others. [Meyer, Desbrun, Schröder, Barr 2002]
double NearestArea(const HatTriangle& triangle, int corner)
{
  std::array<double, 3> cosine; // times the lengths of both edges
  int obtuse = -1;
  for (int k = 0; k < 3; ++k)
  {
    cosine[k] = -triangle.edge[(k + 1) % 3].dot(triangle.edge[(k + 2) % 3]);
    obtuse = cosine[k] < 0.0 ? k : obtuse;
  }
  if (obtuse >= 0)
  {
    return triangle.area * (corner == obtuse ? 0.5 : 0.25);
  }
  double sum = 0.0;
  for (int side = 1; side < 3; ++side)
  {
    const int opposite = (corner + side) % 3;
    sum += triangle.edge[opposite].squaredNorm() * cosine[opposite];
  }
  return sum / (16.0 * triangle.area);
}

std::vector<Tensor> FitTriangles(
  const TriangleMesh& mesh, const HatFunctions& hats, const MultiVector& normals, int threads)
{
  std::vector<Tensor> tensors(mesh.triangles.size(), Tensor::Zero());
  ParallelRanges(static_cast<Id>(tensors.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id t = begin; t < end; ++t)
      {
        const HatTriangle triangle(mesh, t, hats.unitLength);
        if (triangle.IsFlat())
        {
          continue;
        }
        std::array<Vec3, 3> atCorners;
        for (int k = 0; k < 3; ++k)
        {
          atCorners[k] = Eigen::Map<const Vec3>(&normals(mesh.triangles[t][k], 0));
        }
        tensors[t] = FitTriangle(triangle, atCorners);
      }
    });
  return tensors;
}

/// The mean tensor of a point's triangles, rotated into its tangent plane.
Tensor GatherTensor(const TriangleMesh& mesh, const HatFunctions& hats,
  const std::vector<Tensor>& tensors, Id function, const Vec3& normal)
{
  Tensor sum = Tensor::Zero();
  double area = 0.0;
  for (Id k = hats.begin[function]; k < hats.begin[function + 1]; ++k)
  {
    const TriangleCorner corner = hats.corners[k];
    const HatTriangle triangle(mesh, corner.Triangle(), hats.unitLength);
    const double side = SideOf(normal, triangle.areaVector);
    const Eigen::Matrix3d turn =
      Eigen::Quaterniond::FromTwoVectors(side * triangle.areaVector, normal).toRotationMatrix();
    const double weight = NearestArea(triangle, corner.Corner());
    sum += side * weight * turn * tensors[corner.Triangle()] * turn.transpose();
    area += weight;
  }
  return area > 0.0 ? Tensor(sum / area) : sum;
}

/// Ascending eigenvalues and the eigenvectors of a tensor across a normal.
struct PrincipalFrame
{
  std::array<double, 2> curvature;
  std::array<Vec3, 2> direction;

  PrincipalFrame(const Tensor& tensor, const Vec3& normal)
  {
    const Vec3 first = normal.unitOrthogonal();
    const Vec3 second = normal.cross(first);
    const double a = first.dot(tensor * first);
    const double b = first.dot(tensor * second);
    const double c = second.dot(tensor * second);
    const double mean = 0.5 * (a + c);
    const double difference = std::hypot(0.5 * (a - c), b);
    const double angle = 0.5 * std::atan2(b, 0.5 * (a - c)); // angle of the maximum
    curvature = { mean - difference, mean + difference };
    direction[1] = std::cos(angle) * first + std::sin(angle) * second;
    direction[0] = normal.cross(direction[1]);
  }
};

} // namespace

MultiVector PointNormals(const TriangleMesh& mesh, const HatFunctions& hats, int threads)
{
  RequireHats(mesh, hats);
  MultiVector ofFunction(hats.Count(), 3);
  ForEachFunction(hats, threads,
    [&](Id function)
    {
      const Vec3 normal = NormalOf(mesh, hats, function);
      std::copy(normal.data(), normal.data() + 3, &ofFunction(function, 0));
    });
  BoundaryNormals(mesh, hats, ofFunction).Correct(threads);
  return ValuesAtPoints(hats, ofFunction, threads);
}

MultiVector SmoothNormals(const FiniteElementSpace& space, const MultiVector& normals,
  const NormalSmoothing& options, SolveReport& report, const Job& job)
{
  if (!(options.scale > 0.0) || std::isinf(options.scale))
  {
    throw InvalidInput("The scale of the smoothing must be above 0 and finite.");
  }
  const double scale = options.scale / space.UnitLength();
  const PoissonOptions poisson{ { options.multigrid, options.solve }, 2.0 / (scale * scale) };
  const MultiVector load =
    space.LoadOfValues({ FieldAssociation::Points, normals }, job.Part(0.0, 0.1));
  const Multigrid multigrid = BuildMultigrid(
    space, poisson.screeningWeight, 1.0, options.multigrid, job.progress.Part(0.1, 0.4));
  PoissonSolution solution =
    SolvePoisson(space, multigrid, load, {}, poisson, job.progress.Part(0.4, 1.0));
  report = std::move(solution.report);
  MultiVector smooth = space.ValuesAtPoints(solution.coefficients, job.threads);
  for (Id point = 0; point < smooth.rows(); ++point)
  {
    Eigen::Map<Vec3>(&smooth(point, 0)).stableNormalize();
  }
  return smooth;
}

PrincipalCurvatures ComputeCurvatures(
  const TriangleMesh& mesh, const HatFunctions& hats, const MultiVector& normals, const Job& job)
{
  RequireHats(mesh, hats);
  if (normals.rows() != static_cast<Id>(mesh.points.size()) || normals.cols() != 3)
  {
    throw InvalidInput("Curvatures need a normal for every point.");
  }
  const std::vector<Tensor> tensors = FitTriangles(mesh, hats, normals, job.threads);
  job.Check(0.5);
  const std::vector<Index> pointOf = PointsOfFunctions(hats);
  MultiVector frames(hats.Count(), 8);
  ForEachFunction(hats, job.threads,
    [&](Id function)
    {
      const Vec3 normal = Eigen::Map<const Vec3>(&normals(pointOf[function], 0));
      if (normal.isZero(0.0))
      {
        frames.row(function).setZero();
        return;
      }
      const PrincipalFrame frame(GatherTensor(mesh, hats, tensors, function, normal), normal);
      for (int k = 0; k < 2; ++k)
      {
        frames(function, k) = frame.curvature[k] / hats.unitLength;
        std::copy(
          frame.direction[k].data(), frame.direction[k].data() + 3, &frames(function, 2 + 3 * k));
      }
    });
  job.Check(0.9);
  const MultiVector atPoints = ValuesAtPoints(hats, frames, job.threads);
  PrincipalCurvatures result;
  for (Id point = 0; point < atPoints.rows(); ++point)
  {
    result.minimum.push_back(atPoints(point, 0));
    result.maximum.push_back(atPoints(point, 1));
    result.minimumDirection.emplace_back(Eigen::Map<const Vec3>(&atPoints(point, 2)));
    result.maximumDirection.emplace_back(Eigen::Map<const Vec3>(&atPoints(point, 5)));
  }
  job.Check(1.0);
  return result;
}

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

/// Gives points whose triangles are all copies the values of the points at their places.
void ShareWithCopies(const std::vector<Id>& pointWithTriangle, PrincipalCurvatures& curvatures)
{
  for (std::size_t point = 0; point < pointWithTriangle.size(); ++point)
  {
    const Id from = pointWithTriangle[point];
    curvatures.minimum[point] = curvatures.minimum[from];
    curvatures.maximum[point] = curvatures.maximum[from];
    curvatures.minimumDirection[point] = curvatures.minimumDirection[from];
    curvatures.maximumDirection[point] = curvatures.maximumDirection[from];
  }
}

} // namespace

PrincipalCurvatures CurvaturesOfSurface(const TriangleMesh& given, bool weldCoincidentPoints,
  const FiniteElementSpace* space, const NormalSmoothing& smoothing, CurvatureReport& report,
  const Job& job)
{
  OrientedMesh oriented = Orient(given, weldCoincidentPoints, job.threads);
  const TriangleMesh& mesh = oriented.mesh ? *oriented.mesh : given;
  report.turned = oriented.turned;
  report.oneSided = oriented.oneSided;
  const HatFunctions around = TrianglesAroundPoints(mesh, weldCoincidentPoints, job.threads);
  job.Check(0.1);
  MultiVector normals = PointNormals(mesh, around, job.threads);
  job.Check(0.2);
  if (smoothing.scale > 0.0)
  {
    normals = SmoothNormals(*space, normals, smoothing, report.smoothing, job.Part(0.2, 0.7));
  }
  PrincipalCurvatures curvatures = ComputeCurvatures(mesh, around, normals, job.Part(0.7, 1.0));
  ShareWithCopies(oriented.pointWithTriangle, curvatures);
  return curvatures;
}

double ShapeIndex(double minimum, double maximum)
{
  return minimum == 0.0 && maximum == 0.0
           ? 0.0
           : 2.0 / double(EIGEN_PI) * std::atan2(minimum + maximum, maximum - minimum);
}

std::vector<double> BendingOf(const std::vector<double>& meanCurvature, double area)
{
  std::vector<double> size;
  for (const double curvature : meanCurvature)
  {
    if (std::isfinite(curvature))
    {
      size.push_back(std::abs(curvature));
    }
  }
  double unit = area > 0.0 ? 1.0 / std::sqrt(area) : 0.0;
  if (!size.empty())
  {
    const auto middle = size.begin() + static_cast<std::ptrdiff_t>(size.size() / 2);
    std::nth_element(size.begin(), middle, size.end());
    unit = std::max(unit, *middle);
  }
  std::vector<double> bending(meanCurvature.size());
  std::transform(meanCurvature.begin(), meanCurvature.end(), bending.begin(),
    [unit](double curvature) { return 2.0 / double(EIGEN_PI) * std::atan2(curvature, unit); });
  return bending;
}

} // namespace gridfem
