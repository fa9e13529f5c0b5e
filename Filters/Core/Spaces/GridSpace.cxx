#include "Spaces/GridSpace.h"

#include "Base/Parallel.h"
#include "Integrals/ElementNorms.h"
#include "Integrals/ElementProducts.h"
#include "Integrals/Evaluation.h"

#include <utility>

namespace gridfem
{

void GridSpace::FillMatrix(
  std::size_t level, double a, double b, SparseMatrix& matrix, const Job& job) const
{
  if (matrix.rows != this->NumberOfFunctions(level) || matrix.value.empty())
  {
    matrix = this->Operators().pattern.at(level);
  }
  const ElementMatrices& elements = this->Operators().elements[level];
  AssembleValues(grid_->levels[level], this->Operators().places[level], elements.mass, a,
    elements.stiffness, b, matrix, job.threads);
}

Components GridSpace::FinestComponents() const
{
  return { grid_->component, grid_->numberOfComponents, {} };
}

const std::vector<double>& GridSpace::Integrals() const
{
  return this->Operators().integral;
}

Columns GridSpace::SquaredNorms(const MultiVector& u, const Job& job) const
{
  return gridfem::SquaredNorms(
    grid_->Finest(), this->Operators().elements.front().mass, u, job.threads);
}

/// Trilinear functions reproduce coordinates: each coefficient is the position of its function's
/// corner.
MultiVector GridSpace::EmbeddingOfMesh(const Job& job) const
{
  const FunctionPlaces& places = this->Operators().places.front();
  const PatchLevel& finest = grid_->Finest();
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
    own_ = *operators_;
  }
  return *own_;
}

Id GridSpace::SetMetric(const MultiVector& embedding, const Job& job, ElementParts parts)
{
  return this->Integrate(MetricOfEmbedding(*grid_, this->Rule(), embedding, job.Part(0.0, 0.3)),
    job.Part(0.3, 1.0), parts);
}

Id GridSpace::SetMetricOfMesh(const TriangleMesh& moved, const Job& job, ElementParts parts)
{
  return this->Integrate(MetricOfMesh(*grid_, this->Rule(), *mesh_, moved, job.Part(0.0, 0.3)),
    job.Part(0.3, 1.0), parts);
}

Id GridSpace::Integrate(const SampleMetric& metric, const Job& job, ElementParts parts)
{
  metric_.reset();
  LevelOperators& operators = this->OwnOperators();
  const Id singular = IntegrateElements(*grid_, this->Rule(), metric, operators.elements.front(),
    job.Part(0.0, 0.7), operators.normalStabilization, parts);
  UpdateOperators(*grid_, operators, job.threads, parts);
  job.Check(1.0);
  return singular;
}

void GridSpace::IntegrateTriangles(const std::vector<double>& weight, const Job& job)
{
  LevelOperators& operators = this->OwnOperators();
  operators.elements.front() = IntegrateElements(*grid_, this->Rule(), job.Part(0.0, 0.7),
    operators.normalStabilization, &weight, metric_ ? &metric_->tensor : nullptr);
  UpdateOperators(*grid_, operators, job.threads);
  job.Check(1.0);
}

void GridSpace::SplitStiffness(const std::vector<Vec3>& direction, const Job& job)
{
  split_ = std::make_shared<const DirectionalElements>(
    IntegrateElements(*grid_, this->Rule(), direction, job, operators_->normalStabilization));
}

MultiVector GridSpace::MeansOnElements(const MultiVector& onTriangles, const Job& job) const
{
  return MeansOnPatches(*grid_, onTriangles, job.threads);
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
  UpdateOperators(*grid_, operators, job.threads);
}

MultiVector GridSpace::StiffnessTimes(
  const MultiVector& u, const std::vector<double>& scale, const Job& job) const
{
  const LevelOperators& operators = this->Operators();
  return MultiplyElements(grid_->Finest(), operators.places.front(),
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
