#include "Spaces/SmoothSpace.h"

#include "Base/Errors.h"
#include "Base/Parallel.h"

#include <cmath>
#include <string>
#include <utility>

namespace gridfem
{
namespace
{

/// A tensor in the plane of a triangle with weights along and across a direction. A direction
/// without a part in the plane counts as both directions equally.
Eigen::Matrix3d DirectionalTensor(
  const TriangleFrame& frame, const Vec3& direction, const std::array<double, 2>& weight)
{
  constexpr double SmallestPart = 1e-10;
  if (frame.isFlat)
  {
    return Eigen::Matrix3d::Zero();
  }
  const Vec3 normal = frame.normal.normalized();
  const Vec3 unit = direction.stableNormalized();
  const Vec3 along = unit - normal.dot(unit) * normal;
  if (!(along.norm() > SmallestPart))
  {
    const Eigen::Matrix3d plane = Eigen::Matrix3d::Identity() - normal * normal.transpose();
    return 0.5 * (weight[0] + weight[1]) * plane;
  }
  const Vec3 first = along.normalized();
  const Vec3 second = normal.cross(first);
  return weight[0] * first * first.transpose() + weight[1] * second * second.transpose();
}

bool IsUsableWeight(double weight)
{
  return weight >= 0.0 && std::isfinite(weight);
}

} // namespace

void SmoothSpace::FillMatrix(
  std::size_t level, double a, double b, SparseMatrix& matrix, const Job& job) const
{
  const SmoothMatrices& matrices = this->Matrices();
  Combine(a, matrices.mass.at(level), b, matrices.stiffness.at(level), matrix, job.threads);
}

Components SmoothSpace::FinestComponents() const
{
  return { operators_->component, operators_->numberOfComponents, {} };
}

const std::vector<double>& SmoothSpace::Integrals() const
{
  return this->Matrices().integral;
}

Columns SmoothSpace::SquaredNorms(const MultiVector& u, const Job& job) const
{
  MultiVector product;
  Multiply(this->Matrices().mass.front(), u, product, job.threads);
  return ColumnProducts(u, product, job.threads);
}

/// Quadratic B-splines reproduce coordinates: each coefficient is the center of its function's
/// cell.
MultiVector SmoothSpace::EmbeddingOfMesh(const Job& job) const
{
  const FunctionPlaces& places = operators_->places.front();
  MultiVector embedding(this->Finest().numberOfFunctions, 3);
  ParallelRanges(embedding.rows(), job.threads,
    [&](Id begin, Id end)
    {
      for (Id f = begin; f < end; ++f)
      {
        const Index place = places.item[places.begin[f]];
        const CellIndex cell = MortonDecode(this->Finest().cell[place / SmoothFunctionsPerPatch]);
        const int number = place % SmoothFunctionsPerPatch;
        embedding(f, 0) = cell[0] + number % 3 - 0.5;
        embedding(f, 1) = cell[1] + number / 3 % 3 - 0.5;
        embedding(f, 2) = cell[2] + number / 9 - 0.5;
      }
    });
  return embedding;
}

std::unique_ptr<FiniteElementSpace> SmoothSpace::Copy() const
{
  return std::make_unique<SmoothSpace>(*this);
}

Id SmoothSpace::SetMetric(const MultiVector& embedding, const Job& job, ElementParts parts)
{
  if (embedding.rows() != this->Finest().numberOfFunctions || embedding.cols() != 3)
  {
    throw InvalidInput("An embedding needs three coefficients for each function of the space.");
  }
  TriangleMesh moved = *mesh_;
  const MultiVector position = this->ValuesAtPoints(embedding, job.Part(0.0, 0.1));
  for (Id point = 0; point < position.rows(); ++point)
  {
    moved.points[point] = position.row(point).transpose() * this->UnitLength();
  }
  Id singular = 0;
  const TriangleMetric metric = MetricOfMovedTriangles(*mesh_, moved, singular);
  SmoothWeights weights;
  weights.mass = &metric.area;
  weights.tensor = &metric.tensor;
  auto matrices = std::make_shared<SmoothMatrices>(
    IntegrateMatrices(*grid_, *operators_, weights, job.Part(0.1, 1.0)));
  if (parts == ElementParts::Mass)
  {
    matrices->stiffness = this->Matrices().stiffness;
  }
  else
  {
    tensor_ = std::make_shared<const std::vector<Eigen::Matrix3d>>(metric.tensor);
    normal_.reset();
  }
  own_ = std::move(matrices);
  metric_.reset();
  return singular;
}

void SmoothSpace::IntegrateTriangles(const std::vector<double>& weight, const Job& job)
{
  SmoothWeights weights;
  weights.mass = &weight;
  weights.tensor = metric_ ? &metric_->tensor : nullptr;
  tensor_.reset();
  normal_.reset();
  own_ =
    std::make_shared<const SmoothMatrices>(IntegrateMatrices(*grid_, *operators_, weights, job));
}

void SmoothSpace::SplitStiffness(const std::vector<Vec3>& direction, const Job&)
{
  if (direction.size() < mesh_->triangles.size())
  {
    throw InvalidInput("Every source triangle needs a direction.");
  }
  direction_ = std::make_shared<const std::vector<Vec3>>(direction);
}

MultiVector SmoothSpace::MeansOnElements(const MultiVector& onTriangles, const Job&) const
{
  return onTriangles;
}

void SmoothSpace::Weigh(const std::vector<ElementWeights>& weights, const Job& job)
{
  const std::size_t triangles = mesh_->triangles.size();
  if (!direction_ || weights.size() != triangles)
  {
    throw InvalidInput("Weights need a split stiffness, and there has to be one per triangle.");
  }
  std::vector<double> mass(triangles);
  auto normal = std::make_shared<std::vector<double>>(triangles);
  auto tensor = std::make_shared<std::vector<Eigen::Matrix3d>>(triangles);
  for (std::size_t t = 0; t < triangles; ++t)
  {
    const auto& [ofMass, ofStiffness] = weights[t];
    if (!IsUsableWeight(ofMass) || !IsUsableWeight(ofStiffness[0]) ||
        !IsUsableWeight(ofStiffness[1]))
    {
      throw InvalidInput("Every triangle needs finite weights that are not negative.");
    }
    mass[t] = ofMass;
    (*normal)[t] = 0.5 * (ofStiffness[0] + ofStiffness[1]);
    (*tensor)[t] =
      DirectionalTensor(TriangleFrame(*mesh_, static_cast<Id>(t)), (*direction_)[t], ofStiffness);
  }
  metric_.reset();
  own_ = std::make_shared<const SmoothMatrices>(
    IntegrateMatrices(*grid_, *operators_, { &mass, tensor.get(), normal.get() }, job));
  tensor_ = std::move(tensor);
  normal_ = std::move(normal);
}

/// With scales, the stiffness is integrated again.
MultiVector SmoothSpace::StiffnessTimes(
  const MultiVector& u, const std::vector<double>& scale, const Job& job) const
{
  MultiVector result;
  if (scale.empty())
  {
    Multiply(this->Matrices().stiffness.front(), u, result, job.threads);
    return result;
  }
  if (scale.size() != mesh_->triangles.size())
  {
    throw InvalidInput("There are " + std::to_string(scale.size()) + " scales for " +
                       std::to_string(mesh_->triangles.size()) + " triangles.");
  }
  const std::vector<Eigen::Matrix3d>* const own = metric_ ? &metric_->tensor : tensor_.get();
  std::vector<Eigen::Matrix3d> tensor(scale.size());
  const std::vector<double> normal = normal_ ? ProductOf(scale, *normal_) : scale;
  for (std::size_t t = 0; t < scale.size(); ++t)
  {
    tensor[t] = scale[t] * (own ? (*own)[t]
                                : DirectionalTensor(TriangleFrame(*mesh_, static_cast<Id>(t)),
                                    Vec3::Zero(), { 1.0, 1.0 }));
  }
  const SmoothElementMatrices elements = IntegrateSmoothElements(
    *grid_, this->Rule(), operators_->normalStabilization, { nullptr, &tensor, &normal }, job);
  SparseMatrix stiffness = operators_->pattern.front();
  AssembleValues(this->Finest(), operators_->places.front(), elements.mass, 0.0, elements.stiffness,
    1.0, stiffness, job.threads);
  Multiply(stiffness, u, result, job.threads);
  return result;
}

SmoothSpace BuildSmoothSpace(
  TriangleMesh mesh, const GridSpaceOptions& options, const Progress& progress)
{
  const int threads = options.functions.threads;
  auto surface = std::make_shared<const TriangleMesh>(std::move(mesh));
  auto grid = std::make_shared<const GridFunctions>(
    BuildGridFunctions(*surface, options.functions, progress.Part(0.0, 0.4)));
  auto operators =
    std::make_shared<const SmoothOperators>(BuildSmoothOperators(*grid, options.quadratureDegree,
      options.normalStabilization, options.coarsestSize, { threads, progress.Part(0.4, 1.0) }));
  return SmoothSpace(std::move(surface), std::move(grid), std::move(operators));
}

} // namespace gridfem
