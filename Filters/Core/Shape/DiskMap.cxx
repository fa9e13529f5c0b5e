#include "Shape/DiskMap.h"

#include "Base/Errors.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

namespace gridfem
{
namespace
{

constexpr double FullTurn = 2.0 * 3.14159265358979323846;

using Triplets = std::vector<Eigen::Triplet<double>>;

Eigen::SparseMatrix<double> CotangentStiffness(
  const Disk& disk, const std::vector<SideLengths>& sides)
{
  Triplets entries;
  entries.reserve(12 * disk.triangles.size());
  for (std::size_t t = 0; t < disk.triangles.size(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index a = disk.triangles[t][k];
      const Index b = disk.triangles[t][(k + 1) % 3];
      const double weight = 0.5 * sides[t].CotangentAt((k + 2) % 3);
      entries.emplace_back(a, a, weight);
      entries.emplace_back(b, b, weight);
      entries.emplace_back(a, b, -weight);
      entries.emplace_back(b, a, -weight);
    }
  }
  Eigen::SparseMatrix<double> stiffness(disk.NumberOfVertices(), disk.NumberOfVertices());
  stiffness.setFromTriplets(entries.begin(), entries.end());
  return stiffness;
}

/// Raises the weights of edges that are smaller than the least.
void RaiseWeights(double least, Eigen::SparseMatrix<double>& stiffness)
{
  using Entry = Eigen::SparseMatrix<double>::InnerIterator;
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
}

template<class Factor>
std::unique_ptr<Factor> Factored(const Eigen::SparseMatrix<double>& matrix, const Job& job)
{
  auto factor = std::make_unique<Factor>();
  factor->analyzePattern(matrix);
  job.Check(0.3);
  factor->factorize(matrix);
  job.Check(0.9);
  if (factor->info() != Eigen::Success)
  {
    throw InvalidInput("The system of the flat map has no solution. Triangles of very different "
                       "size can cause this. Clean the mesh first.");
  }
  return factor;
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

/// The energy of a step toward rigid triangles, and the right-hand side of the next.
struct Rigid
{
  double energy = 0.0;
  Eigen::MatrixXd load;
};

Rigid FitRotations(
  const Disk& disk, const std::vector<SideLengths>& sides, const MultiVector& plane)
{
  Rigid rigid;
  rigid.load.setZero(plane.rows(), 2);
  for (std::size_t t = 0; t < disk.triangles.size(); ++t)
  {
    const auto flat = sides[t].InPlane();
    const auto& corner = disk.triangles[t];
    std::array<std::complex<double>, 3> edge;
    std::array<std::complex<double>, 3> image;
    std::array<double, 3> weight{};
    std::complex<double> fit = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      const int next = (k + 1) % 3;
      const Vec2 e = flat[next] - flat[k];
      const Vec2 i = (plane.row(corner[next]) - plane.row(corner[k])).transpose();
      edge[k] = { e[0], e[1] };
      image[k] = { i[0], i[1] };
      weight[k] = 0.5 * sides[t].CotangentAt((k + 2) % 3);
      fit += weight[k] * std::conj(edge[k]) * image[k];
    }
    const double size = std::abs(fit);
    const std::complex<double> rotation = size > 0.0 ? fit / size : 1.0;
    for (int k = 0; k < 3; ++k)
    {
      const std::complex<double> wanted = rotation * edge[k];
      rigid.energy += weight[k] * std::norm(image[k] - wanted);
      const Eigen::RowVector2d pull(weight[k] * wanted.real(), weight[k] * wanted.imag());
      rigid.load.row(corner[(k + 1) % 3]) += pull;
      rigid.load.row(corner[k]) -= pull;
    }
  }
  return rigid;
}

/// The largest part of a step, up to 1, that turns no triangle over that is not turned already.
double LargestStep(const Disk& disk, const MultiVector& plane, const MultiVector& step)
{
  double largest = 1.0;
  for (const auto& c : disk.triangles)
  {
    const auto cross = [](const Eigen::RowVector2d& a, const Eigen::RowVector2d& b)
    { return a[0] * b[1] - a[1] * b[0]; };
    const Eigen::RowVector2d a = plane.row(c[1]) - plane.row(c[0]);
    const Eigen::RowVector2d b = plane.row(c[2]) - plane.row(c[0]);
    const Eigen::RowVector2d da = step.row(c[1]) - step.row(c[0]);
    const Eigen::RowVector2d db = step.row(c[2]) - step.row(c[0]);
    // The area after a part s of the step is p s² + q s + r.
    const double r = cross(a, b);
    const double q = cross(da, b) + cross(a, db);
    const double p = cross(da, db);
    const double root = q * q - 4.0 * p * r;
    const double denominator = root < 0.0 ? 0.0 : std::sqrt(root) - q;
    if (r > 0.0 && denominator > 0.0) // the area becomes 0 at the part 2 r / denominator
    {
      largest = std::min(largest, 0.9 * 2.0 * r / denominator);
    }
  }
  return largest;
}

} // namespace

DiskMap::DiskMap(const Disk& disk)
  : disk_(disk), sides_(MeasureTriangles(disk)), row_(disk.points.size(), 0)
{
  for (std::size_t k = 0; k < disk.loop.size(); ++k)
  {
    row_[disk.loop[k]] = ~static_cast<Index>(k);
  }
  for (Index& row : row_)
  {
    row = row < 0 ? row : inner_++;
  }
  stiffness_ = CotangentStiffness(disk, sides_);
}

/// Solves the Laplace equation with given values on the boundary.
MultiVector DiskMap::Extend(const Eigen::MatrixXd& onBoundary, const Job& job)
{
  if (!ofInner_ && inner_ > 0)
  {
    Triplets among;
    Triplets across;
    for (Index column = 0; column < stiffness_.cols(); ++column)
    {
      for (Matrix::InnerIterator entry(stiffness_, column); entry; ++entry)
      {
        const Index row = row_[entry.row()];
        if (row >= 0 && row_[column] >= 0)
        {
          among.emplace_back(row, row_[column], entry.value());
        }
        else if (row >= 0)
        {
          across.emplace_back(row, ~row_[column], entry.value());
        }
      }
    }
    Matrix matrix(inner_, inner_);
    matrix.setFromTriplets(among.begin(), among.end());
    toBoundary_.resize(inner_, static_cast<Index>(disk_.loop.size()));
    toBoundary_.setFromTriplets(across.begin(), across.end());
    ofInner_ = Factored<Factor>(matrix, job);
  }
  Eigen::MatrixXd inside;
  if (inner_ > 0)
  {
    inside = ofInner_->solve(Eigen::MatrixXd(-(toBoundary_ * onBoundary)));
  }
  MultiVector values(stiffness_.rows(), onBoundary.cols());
  for (Index vertex = 0; vertex < values.rows(); ++vertex)
  {
    const Index row = row_[vertex];
    values.row(vertex) =
      row < 0 ? Eigen::RowVectorXd(onBoundary.row(~row)) : Eigen::RowVectorXd(inside.row(row));
  }
  return values;
}

/// Solves the system of all vertices. Vertex 0 gets 0.
MultiVector DiskMap::SolvePinned(const Eigen::MatrixXd& b, const Job& job)
{
  const Id others = stiffness_.rows() - 1;
  if (!pinned_)
  {
    pinned_ = Factored<Factor>(Matrix(stiffness_.bottomRightCorner(others, others)), job);
  }
  MultiVector x = MultiVector::Zero(b.rows(), b.cols());
  x.bottomRows(others) = pinned_->solve(Eigen::MatrixXd(b.bottomRows(others)));
  return x;
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
  MultiVector scale = MultiVector::Zero(stiffness_.rows(), 1); // logarithm
  if (inner_ > 0)
  {
    this->Extend(Eigen::MatrixXd::Zero(edges, 1), job); // factors the matrix
    Eigen::VectorXd ofInner(inner_);
    for (Index vertex = 0; vertex < stiffness_.rows(); ++vertex)
    {
      if (row_[vertex] >= 0)
      {
        ofInner[row_[vertex]] = -missing(vertex, 0);
      }
    }
    ofInner = ofInner_->solve(ofInner).eval();
    for (Index vertex = 0; vertex < stiffness_.rows(); ++vertex)
    {
      scale(vertex, 0) = row_[vertex] < 0 ? 0.0 : ofInner[row_[vertex]];
    }
  }
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
  job.Check(0.1);
  const Eigen::MatrixXd boundary = this->LayOutBoundary(job.Part(0.1, 0.45));
  job.Check(0.45);
  const MultiVector extended = this->Extend(boundary);
  job.Check(0.5);
  const auto edges = static_cast<Index>(disk_.loop.size());
  Eigen::MatrixXd flux = Eigen::MatrixXd::Zero(stiffness_.rows(), 2); // of the conjugates
  for (Index k = 0; k < edges; ++k)
  {
    const Index before = (k + edges - 1) % edges;
    const Index after = (k + 1) % edges;
    flux(disk_.loop[k], 0) += 0.5 * (boundary(after, 1) - boundary(before, 1));
    flux(disk_.loop[k], 1) += 0.5 * (boundary(before, 0) - boundary(after, 0));
  }
  MultiVector plane = 0.5 * (extended + this->SolvePinned(flux, job.Part(0.5, 1.0)));
  RequireFinite(plane);
  job.Check(1.0);
  return plane;
}

bool DiskMap::HasTurned(const MultiVector& plane) const
{
  const auto distortions = MeasureDistortion(disk_, sides_, plane);
  return std::any_of(distortions.begin(), distortions.end(),
    [](const ChartDistortion& distortion) { return distortion.isTurned; });
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
  MultiVector plane = this->Extend(circle, job.Part(0.0, 0.5));
  job.Check(0.5);
  if (this->HasTurned(plane))
  {
    constexpr double LeastWeight = 0.01;
    const Matrix cotangents = stiffness_;
    RaiseWeights(LeastWeight, stiffness_);
    ofInner_.reset();
    plane = this->Extend(circle, job.Part(0.5, 1.0));
    stiffness_ = cotangents;
    ofInner_.reset();
  }
  RequireFinite(plane);
  job.Check(1.0);
  return plane;
}

MultiVector DiskMap::Isometric(MultiVector plane, const Job& job)
{
  constexpr int MostSteps = 100;
  constexpr double LeastGain = 1e-4; // of the energy, in a step
  Rigid rigid = FitRotations(disk_, sides_, plane);
  for (int k = 0; k < MostSteps && rigid.energy > 0.0; ++k)
  {
    job.Check(static_cast<double>(k) / MostSteps);
    const MultiVector step = this->SolvePinned(rigid.load) - plane;
    const MultiVector next = plane + LargestStep(disk_, plane, step) * step;
    Rigid after = FitRotations(disk_, sides_, next);
    if (!(after.energy < rigid.energy))
    {
      break;
    }
    const bool isDone = rigid.energy - after.energy < LeastGain * rigid.energy;
    plane = next;
    rigid = std::move(after);
    if (isDone)
    {
      break;
    }
  }
  RequireFinite(plane);
  job.Check(1.0);
  return plane;
}

} // namespace gridfem
