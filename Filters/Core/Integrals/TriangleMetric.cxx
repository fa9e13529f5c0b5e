#include "Integrals/TriangleMetric.h"

#include "Base/Errors.h"
#include "Grid/TriangleArea.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace gridfem
{
namespace
{

constexpr double SmallestEigenvalue = 1e-100;
constexpr double LargestEigenvalue = 1e100;
constexpr double LargestQuotient = 1e14;

} // namespace

TriangleFrame::TriangleFrame(const TriangleMesh& mesh, Id triangle)
{
  constexpr double SmallestHeight = 1e-10;
  const std::array<Id, 3>& corner = mesh.triangles[triangle];
  a = mesh.points[corner[1]] - mesh.points[corner[0]];
  b = mesh.points[corner[2]] - mesh.points[corner[0]];
  normal = a.cross(b);
  const double longest2 = std::max({ a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm() });
  isFlat = !(normal.norm() > SmallestHeight * longest2);
}

double TriangleMetric::AreaOf(const TriangleMesh& mesh) const
{
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    sum += area[t] * gridfem::AreaOf(mesh, static_cast<Id>(t));
  }
  return sum;
}

Field TriangleMetric::Transform(const TriangleMesh& mesh, const Field& s) const
{
  RequireVectors(s, mesh);
  RequireMetric(*this, mesh);
  return MapVectors(mesh, s, [this](Id t) { return tensor[t]; });
}

PlaneTensor::PlaneTensor(const TriangleMesh& mesh, Id triangle, const Eigen::Matrix3d& tensor)
{
  const TriangleFrame edges(mesh, triangle);
  if (edges.isFlat)
  {
    return;
  }
  hasPlane_ = true;
  first_ = edges.a.normalized();
  second_ = edges.normal.normalized().cross(first_);
  E_ = first_.dot(tensor * first_);
  F_ = first_.dot(tensor * second_);
  G_ = second_.dot(tensor * second_);
}

std::array<double, 2> PlaneTensor::Eigenvalues() const
{
  const double mean = 0.5 * E_ + 0.5 * G_;
  const double radius = std::hypot(0.5 * E_ - 0.5 * G_, F_);
  if (mean > 0.0 && mean + radius < LargestEigenvalue && mean + radius > SmallestEigenvalue)
  {
    const double large = mean + radius; // computing the smaller one as a quotient keeps its digits
    return { (E_ / large) * G_ - (F_ / large) * F_, large };
  }
  return { mean - radius, mean + radius };
}

bool PlaneTensor::IsMetric() const
{
  const auto [small, large] = this->Eigenvalues();
  return small >= SmallestEigenvalue && large <= LargestEigenvalue &&
         large < LargestQuotient * small;
}

double PlaneTensor::Area() const
{
  const auto [small, large] = this->Eigenvalues();
  return std::sqrt(small) * std::sqrt(large);
}

Eigen::Matrix3d PlaneTensor::InverseTimesArea() const
{
  if (!hasPlane_)
  {
    return Eigen::Matrix3d::Identity();
  }
  const double area = this->Area();
  return G_ / area * first_ * first_.transpose() + E_ / area * second_ * second_.transpose() -
         F_ / area * (first_ * second_.transpose() + second_ * first_.transpose());
}

Eigen::Matrix3d SymmetricTensor(const double* six)
{
  Eigen::Matrix3d tensor;
  tensor << six[0], six[3], six[5], //
    six[3], six[1], six[4],         //
    six[5], six[4], six[2];
  return tensor;
}

TriangleMetric MetricOfTensors(const TriangleMesh& mesh, const Field& tensors)
{
  RequireField(tensors, mesh);
  if (tensors.values.cols() != 6)
  {
    throw InvalidInput("A symmetric tensor has six components.");
  }
  TriangleMetric metric;
  metric.area.resize(mesh.triangles.size());
  metric.tensor.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const std::array<Id, 3> row = tensors.RowsOf(static_cast<Id>(t), mesh.triangles[t]);
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (int k = 0; k < 3; ++k)
    {
      sum += SymmetricTensor(&tensors.values(row[k], 0));
    }
    const PlaneTensor plane(mesh, static_cast<Id>(t), sum / 3.0);
    if (!plane.IsMetric())
    {
      throw InvalidInput("The tensor on triangle " + std::to_string(t) + " is not a metric.");
    }
    metric.area[t] = plane.Area();
    metric.tensor[t] = plane.InverseTimesArea();
  }
  return metric;
}

TriangleMetric MetricOfMovedTriangles(
  const TriangleMesh& mesh, const TriangleMesh& moved, Id& singular)
{
  const std::size_t triangles = mesh.triangles.size();
  TriangleMetric metric;
  metric.area.assign(triangles, 0.0);
  metric.tensor.assign(triangles, Eigen::Matrix3d::Zero());
  singular = 0;
  for (std::size_t t = 0; t < triangles; ++t)
  {
    const TriangleFrame before(mesh, static_cast<Id>(t));
    if (before.isFlat)
    {
      continue;
    }
    const TriangleFrame after(moved, static_cast<Id>(t));
    const double square = before.normal.squaredNorm();
    const Eigen::Matrix3d map = (after.a * before.b.cross(before.normal).transpose() +
                                  after.b * before.normal.cross(before.a).transpose()) /
                                square;
    const PlaneTensor plane(mesh, static_cast<Id>(t), map.transpose() * map);
    if (!plane.IsMetric())
    {
      ++singular;
      continue;
    }
    metric.area[t] = plane.Area();
    metric.tensor[t] = plane.InverseTimesArea();
  }
  return metric;
}

void RequireMetric(const TriangleMetric& metric, const TriangleMesh& mesh)
{
  if (metric.area.size() != mesh.triangles.size() || metric.tensor.size() != mesh.triangles.size())
  {
    throw InvalidInput("A metric needs an area and a tensor for each triangle.");
  }
}

Field GradientsOf(const TriangleMesh& mesh, const Field& f)
{
  RequireOnPoints(f, mesh);
  Field gradients;
  gradients.association = FieldAssociation::Triangles;
  gradients.values = MultiVector::Zero(static_cast<Id>(mesh.triangles.size()), 3 * f.values.cols());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const TriangleFrame edges(mesh, static_cast<Id>(t));
    if (edges.isFlat)
    {
      continue;
    }
    const double square = edges.normal.squaredNorm();
    const Vec3 alongA = edges.b.cross(edges.normal) / square; // gradient of the second corner's hat
                                                              // function
    const Vec3 alongB = edges.normal.cross(edges.a) / square;
    const std::array<Id, 3>& corner = mesh.triangles[t];
    for (Id c = 0; c < f.values.cols(); ++c)
    {
      const double first = f.values(corner[0], c);
      gradients.values.row(static_cast<Id>(t)).segment<3>(3 * c) =
        ((f.values(corner[1], c) - first) * alongA + (f.values(corner[2], c) - first) * alongB)
          .transpose();
    }
  }
  return gradients;
}

} // namespace gridfem
