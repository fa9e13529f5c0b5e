#include "Spaces/GridSpace.h"

#include "Base/Parallel.h"
#include "Integrals/ElementNorms.h"
#include "Integrals/ElementProducts.h"
#include "Integrals/Evaluation.h"
#include "Integrals/LoadVector.h"
#include "Spaces/PatchOrdering.h"

#include <algorithm>

namespace gridfem
{

GridSpace::GridSpace(std::shared_ptr<const TriangleMesh> mesh,
  std::shared_ptr<const GridFunctions> functions, std::shared_ptr<const LevelOperators> operators)
  : mesh_(std::move(mesh)), functions_(std::move(functions)), shared_(std::move(operators))
{
}

std::size_t GridSpace::NumberOfLevels() const
{
  return this->Operators().pattern.size();
}

Index GridSpace::NumberOfFunctions(std::size_t level) const
{
  return functions_->levels.at(level).numberOfFunctions;
}

void GridSpace::FillMatrix(
  std::size_t level, double a, double b, SparseMatrix& matrix, const Job& job) const
{
  if (matrix.rows != this->NumberOfFunctions(level) || matrix.value.empty())
  {
    matrix = this->Operators().pattern.at(level);
  }
  const ElementMatrices& elements = this->Operators().elements[level];
  AssembleValues(functions_->levels[level], this->Operators().places[level], elements.mass, a,
    elements.stiffness, b, matrix, job.threads);
}

SharedMatrix GridSpace::Prolongation(std::size_t level) const
{
  return this->Operators().prolongation.at(level);
}

SharedMatrix GridSpace::Restriction(std::size_t level) const
{
  return this->Operators().restriction.at(level);
}

LevelRelaxation GridSpace::Relaxation(std::size_t level, const MultigridOptions&) const
{
  return { OrderPatches(functions_->levels.at(level)), {}, {} };
}

Components GridSpace::ComponentsOf(std::size_t level, const Job& job) const
{
  if (level == 0)
  {
    return { functions_->component, functions_->numberOfComponents, {} };
  }
  Components components;
  components.ofFunction = FunctionComponents(functions_->levels.at(level), job.threads);
  components.count = NumberOfComponents(components.ofFunction);
  return components;
}

double GridSpace::UnitLength() const
{
  return functions_->GetGrid().spacing;
}

Vec3 GridSpace::Origin() const
{
  return functions_->GetGrid().origin;
}

double GridSpace::Extent() const
{
  return functions_->GetGrid().CellsPerSide();
}

const std::vector<double>& GridSpace::Integrals() const
{
  return this->Operators().integral;
}

const QuadratureRule& GridSpace::Rule() const
{
  return TriangleRule(shared_->quadratureDegree);
}

MultiVector GridSpace::LoadOfValues(const Field& f, const Job& job) const
{
  return IntegrateValues(
    *functions_, *mesh_, f, this->Rule(), job, metric_ ? &metric_->area : nullptr);
}

MultiVector GridSpace::LoadOfWeightedValues(
  const Field& f, const std::vector<double>& weight, const Job& job) const
{
  RequireWeights(weight, *mesh_);
  const std::vector<double> all = metric_ ? ProductOf(weight, metric_->area) : weight;
  return IntegrateValues(*functions_, *mesh_, f, this->Rule(), job, &all);
}

MultiVector GridSpace::LoadOfGradients(const Field& s, const Field* scale, const Job& job) const
{
  return IntegrateGradients(
    *functions_, *mesh_, metric_ ? metric_->Transform(*mesh_, s) : s, scale, this->Rule(), job);
}

MultiVector GridSpace::LoadOfTurnedGradients(const Field& s, const Job& job) const
{
  return IntegrateTurnedGradients(*functions_, *mesh_, s, this->Rule(), job);
}

MultiVector GridSpace::LoadOfDirections(
  const MultiVector& coefficients, const Field* scale, const Job& job) const
{
  return IntegrateDirections(*functions_, *mesh_, coefficients, scale, this->Rule(), job);
}

MultiVector GridSpace::LoadOfGradientsOf(const Field& f, const Field* scale, const Job& job) const
{
  return metric_ ? this->LoadOfGradients(GradientsOf(*mesh_, f), scale, job)
                 : IntegrateGradientsOf(*functions_, *mesh_, f, scale, this->Rule(), job);
}

MultiVector GridSpace::LoadOfGradientsOfCoordinates(const Field* scale, const Job& job) const
{
  if (metric_)
  {
    return scale ? this->LoadOfGradientsOf(CoordinatesOf(*mesh_), scale, job)
                 : this->StiffnessTimes(this->UnitLength() * this->EmbeddingOfMesh(job), {}, job);
  }
  return IntegrateGradientsOfCoordinates(
    *functions_, *mesh_, scale, this->Rule(), shared_->normalStabilization, job);
}

MultiVector GridSpace::ValuesAtPoints(const MultiVector& coefficients, const Job& job) const
{
  return EvaluateAtPoints(*functions_, coefficients, job);
}

MultiVector GridSpace::GradientsOnTriangles(const MultiVector& coefficients, const Job& job) const
{
  return MeanGradients(*functions_, static_cast<Id>(mesh_->triangles.size()), coefficients, job);
}

Columns GridSpace::SquaredNorms(const MultiVector& u, const Job& job) const
{
  return gridfem::SquaredNorms(
    functions_->Finest(), this->Operators().elements.front().mass, u, job.threads);
}

SparseMatrix GridSpace::RowsAtPoints(const std::vector<Id>& points) const
{
  return EvaluationRows(*functions_, points);
}

EdgeSamples GridSpace::SamplesOfSegments(const std::vector<TriangleSegment>& segments) const
{
  return SampleSegments(*functions_, *mesh_, segments);
}

SampledFunctions GridSpace::Samples(const Job& job) const
{
  return SampleFunctions(
    *functions_, functions_->Finest(), this->Rule(), job, metric_ ? &metric_->area : nullptr);
}

std::vector<char> GridSpace::PointsWithFunctions() const
{
  std::vector<char> has(functions_->pointPatch.size());
  std::transform(functions_->pointPatch.begin(), functions_->pointPatch.end(), has.begin(),
    [](Index patch) { return patch >= 0; });
  return has;
}

/// Trilinear functions reproduce coordinates: each coefficient is the position of its function's
/// corner.
MultiVector GridSpace::EmbeddingOfMesh(const Job& job) const
{
  const FunctionPlaces& places = this->Operators().places.front();
  const PatchLevel& finest = functions_->Finest();
  MultiVector embedding(finest.numberOfFunctions, 3);
  ParallelRanges(embedding.rows(), job.threads,
    [&](Id begin, Id end)
    {
      for (Id f = begin; f < end; ++f)
      {
        const Index place = places.item[places.begin[f]];
        const CellIndex cell = MortonDecode(finest.cell[place / FunctionsPerPatch]);
        for (int axis = 0; axis < 3; ++axis)
        {
          embedding(f, axis) = cell[axis] + ((place >> axis) & 1);
        }
      }
    });
  return embedding;
}

std::unique_ptr<FiniteElementSpace> GridSpace::Copy() const
{
  return std::make_unique<GridSpace>(*this);
}

LevelOperators& GridSpace::OwnOperators()
{
  if (!own_)
  {
    own_ = *shared_;
  }
  return *own_;
}

Id GridSpace::SetMetric(const MultiVector& embedding, const Job& job, ElementParts parts)
{
  return this->Integrate(
    MetricOfEmbedding(*functions_, this->Rule(), embedding, job.Part(0.0, 0.3)), job.Part(0.3, 1.0),
    parts);
}

Id GridSpace::SetMetricOfMesh(const TriangleMesh& moved, const Job& job, ElementParts parts)
{
  return this->Integrate(MetricOfMesh(*functions_, this->Rule(), *mesh_, moved, job.Part(0.0, 0.3)),
    job.Part(0.3, 1.0), parts);
}

Id GridSpace::Integrate(const SampleMetric& metric, const Job& job, ElementParts parts)
{
  metric_.reset();
  LevelOperators& operators = this->OwnOperators();
  const Id singular = IntegrateElements(*functions_, this->Rule(), metric,
    operators.elements.front(), job.Part(0.0, 0.7), operators.normalStabilization, parts);
  UpdateOperators(*functions_, operators, job.threads, parts);
  job.Check(1.0);
  return singular;
}

void GridSpace::SetMetricOnTriangles(std::shared_ptr<const TriangleMetric> metric, const Job& job)
{
  RequireMetric(*metric, *mesh_);
  metric_ = std::move(metric);
  this->IntegrateTriangles(metric_->area, job);
}

void GridSpace::WeighMass(const std::vector<double>& weight, const Job& job)
{
  RequireWeights(weight, *mesh_);
  this->IntegrateTriangles(metric_ ? ProductOf(weight, metric_->area) : weight, job);
}

/// @param weight  weight of the mass on each triangle
void GridSpace::IntegrateTriangles(const std::vector<double>& weight, const Job& job)
{
  LevelOperators& operators = this->OwnOperators();
  operators.elements.front() = IntegrateElements(*functions_, this->Rule(), job.Part(0.0, 0.7),
    operators.normalStabilization, &weight, metric_ ? &metric_->tensor : nullptr);
  UpdateOperators(*functions_, operators, job.threads);
  job.Check(1.0);
}

void GridSpace::SplitStiffness(const std::vector<Vec3>& direction, const Job& job)
{
  split_ = std::make_shared<const DirectionalElements>(
    IntegrateElements(*functions_, this->Rule(), direction, job, shared_->normalStabilization));
}

MultiVector GridSpace::MeansOnElements(const MultiVector& onTriangles, const Job& job) const
{
  return MeansOnPatches(*functions_, onTriangles, job.threads);
}

void GridSpace::Weigh(const std::vector<ElementWeights>& weights, const Job& job)
{
  if (!split_)
  {
    throw InvalidInput("Weights need a stiffness that is split by direction.");
  }
  metric_.reset();
  LevelOperators& operators = this->OwnOperators();
  gridfem::Weigh(*split_, weights, operators.elements.front(), job.threads);
  UpdateOperators(*functions_, operators, job.threads);
}

MultiVector GridSpace::StiffnessTimes(
  const MultiVector& u, const std::vector<double>& scale, const Job& job) const
{
  const LevelOperators& operators = this->Operators();
  return MultiplyElements(functions_->Finest(), operators.places.front(),
    operators.elements.front().stiffness, scale, u, job.threads);
}

GridSpace BuildGridSpace(
  TriangleMesh mesh, const GridSpaceOptions& options, const Progress& progress)
{
  const int threads = options.functions.threads;
  auto surface = std::make_shared<const TriangleMesh>(std::move(mesh));
  auto functions = std::make_shared<const GridFunctions>(
    BuildGridFunctions(*surface, options.functions, progress.Part(0.0, 0.7)));
  auto operators = std::make_shared<const LevelOperators>(
    BuildLevelOperators(*functions, TriangleRule(options.quadratureDegree),
      { threads, progress.Part(0.7, 1.0) }, options.coarsestSize, options.normalStabilization));
  return GridSpace(std::move(surface), std::move(functions), std::move(operators));
}

} // namespace gridfem
