#include "Spaces/HatSpace.h"

#include "Algebra/RowBuilder.h"
#include "Base/Errors.h"
#include "Integrals/Evaluation.h"
#include "Multigrid/MatrixOrdering.h"
#include "Spaces/HatLoad.h"

#include <algorithm>
#include <string>

namespace gridfem
{

namespace
{

/// Returns the same grid with functions that are joined where sheets touch at points.
std::shared_ptr<const GridSpace> JoinAtPoints(const TriangleMesh& mesh, const GridFunctions& grid,
  const OperatorOptions& ofGrid, bool weldCoincidentPoints, const Job& job)
{
  GridSpaceOptions options{ ofGrid, {} };
  options.functions.depth = grid.GetGrid().depth;
  options.functions.weldCoincidentPoints = weldCoincidentPoints;
  options.functions.joinAtPoints = true;
  options.functions.connectivityAware = grid.support == FunctionSupport::ConnectivityAware;
  options.functions.threads = job.threads;
  return std::make_shared<const GridSpace>(BuildGridSpace(mesh, options, job.progress));
}

} // namespace

HatLevel BuildHatLevel(const TriangleMesh& mesh, const GridFunctions& grid,
  const OperatorOptions& ofGrid, bool weldCoincidentPoints, HatTransfer transfer, const Job& job)
{
  HatOptions options;
  options.weldCoincidentPoints = weldCoincidentPoints;
  options.unitLength = grid.GetGrid().spacing;
  options.threads = job.threads;
  HatLevel hats;
  hats.functions = NumberHatFunctions(mesh, options);
  if (hats.functions.Count() == 0)
  {
    throw InvalidInput("No triangle has an area, so there are no hat functions.");
  }
  job.Check(0.3);
  hats.matrices = AssembleHatMatrices(mesh, hats.functions, {}, job.threads);
  hats.order = OrderInBlocks(hats.matrices.stiffness);
  job.Check(0.4);
  hats.groups = GroupByCoupling(hats.matrices.stiffness, job.threads);
  job.Check(0.5);
  if (hats.functions.numberOfComponents < grid.numberOfComponents)
  {
    hats.joinedGrid = JoinAtPoints(mesh, grid, ofGrid, weldCoincidentPoints, job.Part(0.5, 0.8));
  }
  hats.prolongation = BuildHatProlongation(hats.functions,
    hats.joinedGrid ? hats.joinedGrid->Functions() : grid, mesh, transfer, job.threads);
  job.Check(0.9);
  hats.restriction = Transpose(hats.prolongation, job.threads);
  job.Check(1.0);
  return hats;
}

HatSpace::HatSpace(std::shared_ptr<const HatLevel> hats, GridSpace grid)
  : hats_(std::move(hats)),
    grid_(hats_->joinedGrid ? GridSpace(*hats_->joinedGrid) : std::move(grid))
{
}

std::size_t HatSpace::NumberOfLevels() const
{
  return 1 + grid_.NumberOfLevels();
}

Index HatSpace::NumberOfFunctions(std::size_t level) const
{
  return level == 0 ? hats_->functions.Count() : grid_.NumberOfFunctions(level - 1);
}

void HatSpace::FillMatrix(
  std::size_t level, double a, double b, SparseMatrix& matrix, const Job& job) const
{
  if (level == 0)
  {
    Combine(a, this->Matrices().mass, b, this->Matrices().stiffness, matrix, job.threads);
  }
  else
  {
    grid_.FillMatrix(level - 1, a, b, matrix, job);
  }
}

SharedMatrix HatSpace::Prolongation(std::size_t level) const
{
  return level == 0 ? hats_->prolongation : grid_.Prolongation(level - 1);
}

SharedMatrix HatSpace::Restriction(std::size_t level) const
{
  return level == 0 ? hats_->restriction : grid_.Restriction(level - 1);
}

LevelRelaxation HatSpace::Relaxation(std::size_t level, const MultigridOptions& options) const
{
  if (level > 0)
  {
    return grid_.Relaxation(level - 1, options);
  }
  LevelSmoothing smoothing;
  smoothing.preSweeps = 2 * options.preSweeps;
  smoothing.postSweeps = 2 * options.postSweeps;
  return { hats_->order, hats_->groups, smoothing };
}

Components HatSpace::ComponentsOf(std::size_t level, const Job& job) const
{
  return level == 0
           ? Components{ hats_->functions.component, hats_->functions.numberOfComponents, {} }
           : grid_.ComponentsOf(level - 1, job);
}

double HatSpace::UnitLength() const
{
  return grid_.UnitLength();
}

Vec3 HatSpace::Origin() const
{
  return grid_.Origin();
}

double HatSpace::Extent() const
{
  return grid_.Extent();
}

const std::vector<double>& HatSpace::Integrals() const
{
  return this->Matrices().integral;
}

MultiVector HatSpace::LoadOfValues(const Field& f, const Job& job) const
{
  return IntegrateValues(
    hats_->functions, grid_.Mesh(), f, job.threads, metric_ ? &metric_->area : nullptr);
}

MultiVector HatSpace::LoadOfWeightedValues(
  const Field& f, const std::vector<double>& weight, const Job& job) const
{
  RequireWeights(weight, grid_.Mesh());
  const std::vector<double> all = metric_ ? ProductOf(weight, metric_->area) : weight;
  return IntegrateValues(hats_->functions, grid_.Mesh(), f, job.threads, &all);
}

MultiVector HatSpace::LoadOfGradients(const Field& s, const Field* scale, const Job& job) const
{
  return IntegrateGradients(hats_->functions, grid_.Mesh(),
    metric_ ? metric_->Transform(grid_.Mesh(), s) : s, scale, job.threads);
}

MultiVector HatSpace::LoadOfTurnedGradients(const Field& s, const Job& job) const
{
  return IntegrateTurnedGradients(hats_->functions, grid_.Mesh(), s, job.threads);
}

MultiVector HatSpace::LoadOfDirections(
  const MultiVector& coefficients, const Field* scale, const Job& job) const
{
  const auto triangles = static_cast<Id>(grid_.Mesh().triangles.size());
  const Field directions{ FieldAssociation::Triangles,
    MeanDirections(grid_.Functions(), triangles, coefficients, job.threads) };
  return IntegrateGradients(hats_->functions, grid_.Mesh(), directions, scale, job.threads);
}

MultiVector HatSpace::LoadOfGradientsOf(const Field& f, const Field* scale, const Job& job) const
{
  return metric_ ? this->LoadOfGradients(GradientsOf(grid_.Mesh(), f), scale, job)
                 : IntegrateGradientsOf(hats_->functions, grid_.Mesh(), f, scale, job.threads);
}

MultiVector HatSpace::LoadOfGradientsOfCoordinates(const Field* scale, const Job& job) const
{
  return this->LoadOfGradientsOf(CoordinatesOf(grid_.Mesh()), scale, job);
}

MultiVector HatSpace::ValuesAtPoints(const MultiVector& coefficients, const Job& job) const
{
  return gridfem::ValuesAtPoints(hats_->functions, coefficients, job.threads);
}

MultiVector HatSpace::GradientsOnTriangles(const MultiVector& coefficients, const Job& job) const
{
  return gridfem::GradientsOnTriangles(hats_->functions, grid_.Mesh(), coefficients, job.threads);
}

Columns HatSpace::SquaredNorms(const MultiVector& u, const Job& job) const
{
  MultiVector product;
  Multiply(this->Matrices().mass, u, product, job.threads);
  return ColumnProducts(u, product, job.threads);
}

SparseMatrix HatSpace::RowsAtPoints(const std::vector<Id>& points) const
{
  const std::vector<Index>& functionOf = hats_->functions.ofPoint;
  RowBuilder rows;
  RowBuilder::Entries entries;
  for (const Id point : points)
  {
    if (point < 0 || point >= static_cast<Id>(functionOf.size()))
    {
      throw InvalidInput("There is no point " + std::to_string(point) + ".");
    }
    entries.clear();
    if (functionOf[point] >= 0)
    {
      entries.emplace_back(functionOf[point], 1.0);
    }
    rows.Append(entries);
  }
  return rows.Finish(hats_->functions.Count());
}

EdgeSamples HatSpace::SamplesOfSegments(const std::vector<TriangleSegment>& segments) const
{
  return SampleSegments(hats_->functions, grid_.Mesh(), segments);
}

SampledFunctions HatSpace::Samples(const Job& /*job*/) const
{
  RowBuilder rows;
  RowBuilder::Entries entries;
  for (Index function = 0; function < hats_->functions.Count(); ++function)
  {
    entries.assign(1, { function, 1.0 });
    rows.Append(entries);
  }
  return { rows.Finish(hats_->functions.Count()), this->Matrices().mass };
}

std::vector<char> HatSpace::PointsWithFunctions() const
{
  const std::vector<Index>& functionOf = hats_->functions.ofPoint;
  std::vector<char> has(functionOf.size());
  std::transform(functionOf.begin(), functionOf.end(), has.begin(),
    [](Index function) { return function >= 0; });
  return has;
}

MultiVector HatSpace::EmbeddingOfMesh(const Job&) const
{
  const std::vector<Vec3>& points = grid_.Mesh().points;
  MultiVector embedding(hats_->functions.Count(), 3);
  for (std::size_t point = 0; point < points.size(); ++point)
  {
    const Index function = hats_->functions.ofPoint[point];
    for (int axis = 0; function >= 0 && axis < 3; ++axis)
    {
      embedding(function, axis) = (points[point][axis] - this->Origin()[axis]) / this->UnitLength();
    }
  }
  return embedding;
}

std::unique_ptr<FiniteElementSpace> HatSpace::Copy() const
{
  return std::make_unique<HatSpace>(*this);
}

/// Assembles the cotangent matrices of the moved points. The grid gets the metric of the moved
/// triangles, so that its cycles precondition the same surface.
Id HatSpace::SetMetric(const MultiVector& embedding, const Job& job, ElementParts parts)
{
  if (embedding.cols() != 3)
  {
    throw InvalidInput("An embedding needs three coefficients for each function of the space.");
  }
  auto mesh = std::make_shared<TriangleMesh>(grid_.Mesh());
  TriangleMesh& moved = *mesh;
  const MultiVector position = this->ValuesAtPoints(embedding, job);
  for (Id point = 0; point < position.rows(); ++point)
  {
    moved.points[point] = position.row(point).transpose() * this->UnitLength();
  }
  auto matrices =
    std::make_shared<HatMatrices>(AssembleHatMatrices(moved, hats_->functions, {}, job.threads));
  if (parts == ElementParts::Mass)
  {
    matrices->stiffness = this->Matrices().stiffness;
  }
  job.Check(0.4);
  own_ = std::move(matrices);
  moved_ = mesh;
  movedParts_ = parts;
  weights_.reset();
  metric_.reset();
  grid_.SetMetricOfMesh(moved, job.Part(0.4, 1.0), parts);
  return CountFlattened(hats_->functions, moved, job.threads);
}

HatWeights HatSpace::Weights() const
{
  return { metric_.get(), weights_.get(), direction_.get() };
}

/// Assembles the matrices on the mesh itself.
void HatSpace::Assemble(const Job& job)
{
  moved_.reset();
  own_ = std::make_shared<const HatMatrices>(
    AssembleHatMatrices(grid_.Mesh(), hats_->functions, this->Weights(), job.threads));
  job.Check(1.0);
}

void HatSpace::SetMetricOnTriangles(std::shared_ptr<const TriangleMetric> metric, const Job& job)
{
  RequireMetric(*metric, grid_.Mesh());
  weights_.reset();
  metric_ = std::move(metric);
  this->Assemble(job.Part(0.0, 0.4));
  grid_.SetMetricOnTriangles(metric_, job.Part(0.4, 1.0));
}

void HatSpace::WeighMass(const std::vector<double>& weight, const Job& job)
{
  RequireWeights(weight, grid_.Mesh());
  auto weights = std::make_shared<std::vector<ElementWeights>>(weight.size());
  for (std::size_t t = 0; t < weight.size(); ++t)
  {
    (*weights)[t].mass = weight[t];
  }
  weights_ = std::move(weights);
  this->Assemble(job.Part(0.0, 0.4));
  grid_.WeighMass(weight, job.Part(0.4, 1.0));
}

void HatSpace::SplitStiffness(const std::vector<Vec3>& direction, const Job& job)
{
  grid_.SplitStiffness(direction, job);
  direction_ = std::make_shared<const std::vector<Vec3>>(direction);
}

MultiVector HatSpace::MeansOnElements(const MultiVector& onTriangles, const Job&) const
{
  return onTriangles;
}

void HatSpace::Weigh(const std::vector<ElementWeights>& weights, const Job& job)
{
  if (!direction_ || weights.size() != grid_.Mesh().triangles.size())
  {
    throw InvalidInput("Weights need a split stiffness, and there has to be one per triangle.");
  }
  metric_.reset();
  weights_ = std::make_shared<const std::vector<ElementWeights>>(weights);
  this->Assemble(job.Part(0.0, 0.4));
  MultiVector columns(static_cast<Id>(weights.size()), 3);
  for (Id t = 0; t < columns.rows(); ++t)
  {
    columns.row(t) << weights[t].mass, weights[t].stiffness[0], weights[t].stiffness[1];
  }
  const MultiVector means = grid_.MeansOnElements(columns, job);
  std::vector<ElementWeights> onPatches(means.rows());
  for (Id p = 0; p < means.rows(); ++p)
  {
    onPatches[p] = { means(p, 0), { means(p, 1), means(p, 2) } };
  }
  grid_.Weigh(onPatches, job);
}

MultiVector HatSpace::StiffnessTimes(
  const MultiVector& u, const std::vector<double>& scale, const Job& job) const
{
  const bool isMoved = moved_ && movedParts_ == ElementParts::Both;
  return MultiplyHats(
    isMoved ? *moved_ : grid_.Mesh(), hats_->functions, this->Weights(), scale, u, job.threads);
}

HatSpace BuildHatSpace(TriangleMesh mesh, const GridSpaceOptions& options, HatTransfer transfer,
  const Progress& progress)
{
  GridSpace grid = BuildGridSpace(std::move(mesh), options, progress.Part(0.0, 0.8));
  auto hats = std::make_shared<const HatLevel>(
    BuildHatLevel(grid.Mesh(), grid.Functions(), options, options.functions.weldCoincidentPoints,
      transfer, { options.functions.threads, progress.Part(0.8, 1.0) }));
  return HatSpace(std::move(hats), std::move(grid));
}

} // namespace gridfem
