#include "Shape/DiskMap.h"

#include "Base/Errors.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gridfem
{
namespace
{

constexpr double FullTurn = 2.0 * double(EIGEN_PI);

/// Raises the weights of edges that are smaller than the least.
DiskMatrix WithRaisedWeights(DiskMatrix stiffness, double least)
{
  using Entry = DiskMatrix::InnerIterator;
  for (Index column = 0; column < stiffness.cols(); ++column)
  {
    double sum = 0.0;
    for (Entry entry(stiffness, column); entry; ++entry)
    {
      if (entry.row() != column)
      {
        entry.valueRef() = std::min(entry.value(), -least);
        sum -= entry.value();
      }
    }
    stiffness.coeffRef(column, column) = sum;
  }
  return stiffness;
}

void RequireFinite(const MultiVector& plane)
{
  if (!plane.allFinite())
  {
    throw InvalidInput("The flat map has no finite coordinates. Triangles of very different size "
                       "can cause this. Clean the mesh first.");
  }
}

/// Changes the lengths of a boundary as little as possible so that it closes.
/// @param direction  of each edge, unit vectors as columns
void CloseLoop(const Eigen::Matrix2Xd& direction, Eigen::VectorXd& length)
{
  const Eigen::Matrix2Xd weighted = direction * length.asDiagonal();
  const Eigen::Matrix2d square = weighted * direction.transpose();
  const Vec2 gap = direction * length;
  const double determinant = square.determinant();
  constexpr double Rounding = 1e-12;
  if (determinant > Rounding * square.squaredNorm()) // else all edges are parallel
  {
    length -= weighted.transpose() * (square.inverse() * gap);
  }
}

} // namespace

DiskMap::DiskMap(const Disk& disk)
  : disk_(disk), sides_(MeasureTriangles(disk)),
    stiffness_(CotangentStiffness(disk, sides_, std::vector<double>(sides_.size(), 1.0)))
{
}

const InnerSystem& DiskMap::Inner(const Job& job)
{
  if (!inner_)
  {
    inner_ = std::make_unique<InnerSystem>(disk_, stiffness_, job);
  }
  return *inner_;
}

/// The boundary in the plane if the scale stays along it. Its exterior angles follow from the scale
/// inside, which makes the disk flat.
Eigen::MatrixXd DiskMap::LayOutBoundary(const Job& job)
{
  Eigen::MatrixXd missing = Eigen::MatrixXd::Constant(stiffness_.rows(), 1, FullTurn);
  for (const Index vertex : disk_.loop)
  {
    missing(vertex, 0) = 0.5 * FullTurn;
  }
  for (std::size_t t = 0; t < disk_.triangles.size(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      missing(disk_.triangles[t][k], 0) -= sides_[t].AngleAt(k);
    }
  }
  const auto edges = static_cast<Index>(disk_.loop.size());
  // The logarithm of the scale, 0 on the boundary.
  const Job part = job.Part(0.9, 1.0);
  const MultiVector scale = this->Inner(job.Part(0.0, 0.9)).Solve(-missing, part);
  const Eigen::MatrixXd exterior = missing + stiffness_ * Eigen::MatrixXd(scale);
  Eigen::Matrix2Xd direction(2, edges);
  Eigen::VectorXd length(edges);
  double angle = 0.0;
  for (Index k = 0; k < edges; ++k)
  {
    const Index from = disk_.loop[k];
    angle += exterior(from, 0);
    direction.col(k) << std::cos(angle), std::sin(angle);
    length[k] = (disk_.points[disk_.loop[(k + 1) % edges]] - disk_.points[from]).norm();
  }
  CloseLoop(direction, length);
  Eigen::MatrixXd boundary = Eigen::MatrixXd::Zero(edges, 2);
  for (Index k = 1; k < edges; ++k)
  {
    boundary.row(k) = boundary.row(k - 1) + length[k - 1] * direction.col(k - 1).transpose();
  }
  return boundary;
}

MultiVector DiskMap::Conformal(const Job& job)
{
  const Eigen::MatrixXd boundary = this->LayOutBoundary(job.Part(0.0, 0.45));
  const Job part = job.Part(0.45, 0.5);
  const MultiVector extended = this->Inner(part).Extend(boundary, part);
  const auto edges = static_cast<Index>(disk_.loop.size());
  Eigen::MatrixXd flux = Eigen::MatrixXd::Zero(stiffness_.rows(), 2); // of the conjugates
  for (Index k = 0; k < edges; ++k)
  {
    const Index before = (k + edges - 1) % edges;
    const Index after = (k + 1) % edges;
    flux(disk_.loop[k], 0) += 0.5 * (boundary(after, 1) - boundary(before, 1));
    flux(disk_.loop[k], 1) += 0.5 * (boundary(before, 0) - boundary(after, 0));
  }
  PinnedSystem ofAll;
  if (!ofAll.Factor(stiffness_, job.Part(0.5, 0.9)))
  {
    RefuseSystem();
  }
  MultiVector plane = 0.5 * (extended + ofAll.Solve(flux, job.Part(0.9, 1.0)));
  RequireFinite(plane);
  return this->WithAreaOfSurface(std::move(plane));
}

bool DiskMap::HasFlipped(const MultiVector& plane) const
{
  const auto distortions = MeasureDistortion(disk_, sides_, plane);
  return std::any_of(distortions.begin(), distortions.end(),
    [](const ChartDistortion& distortion) { return distortion.isFlipped; });
}

MultiVector DiskMap::ToCircle(const Job& job)
{
  const auto edges = static_cast<Index>(disk_.loop.size());
  std::vector<double> length{ 0.0 };
  for (Index k = 0; k < edges; ++k)
  {
    length.push_back(
      length.back() +
      (disk_.points[disk_.loop[(k + 1) % edges]] - disk_.points[disk_.loop[k]]).norm());
  }
  Eigen::MatrixXd circle(edges, 2);
  for (Index k = 0; k < edges; ++k)
  {
    const double angle = FullTurn * length[k] / length.back();
    circle.row(k) << std::cos(angle), std::sin(angle);
  }
  MultiVector plane = this->Inner(job.Part(0.0, 0.45)).Extend(circle, job.Part(0.45, 0.5));
  if (this->HasFlipped(plane))
  {
    constexpr double LeastWeight = 0.01;
    const InnerSystem raised(disk_, WithRaisedWeights(stiffness_, LeastWeight), job.Part(0.5, 0.9));
    plane = raised.Extend(circle, job.Part(0.9, 1.0));
  }
  RequireFinite(plane);
  job.Check(1.0);
  return this->WithAreaOfSurface(std::move(plane));
}

/// Scales a map so that its area is that of the surface.
MultiVector DiskMap::WithAreaOfSurface(MultiVector plane) const
{
  double area = 0.0;
  for (std::size_t t = 0; t < sides_.size(); ++t)
  {
    area += disk_.triangleOf[t] < 0 ? 0.0 : sides_[t].Area();
  }
  const double flat = AreaInPlane(disk_, plane);
  return flat > 0.0 ? MultiVector(plane * std::sqrt(area / flat)) : plane;
}

} // namespace gridfem
