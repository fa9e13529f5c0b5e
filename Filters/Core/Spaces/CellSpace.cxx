#include "Spaces/CellSpace.h"

#include "Integrals/Evaluation.h"
#include "Integrals/LoadVector.h"
#include "Spaces/LevelOperators.h"
#include "Spaces/PatchOrdering.h"
#include "Spaces/SmoothOperators.h"

#include <algorithm>
#include <utility>

namespace gridfem
{

template<class Operators, class Level>
CellSpace<Operators, Level>::CellSpace(std::shared_ptr<const TriangleMesh> mesh,
  std::shared_ptr<const GridFunctions> grid, std::shared_ptr<const Operators> operators)
  : mesh_(std::move(mesh)), grid_(std::move(grid)), operators_(std::move(operators))
{
}

template<class Operators, class Level>
std::size_t CellSpace<Operators, Level>::NumberOfLevels() const
{
  return operators_->pattern.size();
}

template<class Operators, class Level>
Index CellSpace<Operators, Level>::NumberOfFunctions(std::size_t level) const
{
  return this->Levels().at(level).numberOfFunctions;
}

template<class Operators, class Level>
SharedMatrix CellSpace<Operators, Level>::Prolongation(std::size_t level) const
{
  return operators_->prolongation.at(level);
}

template<class Operators, class Level>
SharedMatrix CellSpace<Operators, Level>::Restriction(std::size_t level) const
{
  return operators_->restriction.at(level);
}

template<class Operators, class Level>
LevelRelaxation CellSpace<Operators, Level>::Relaxation(
  std::size_t level, const MultigridOptions&) const
{
  return { OrderPatches(this->Levels().at(level)), {}, {} };
}

template<class Operators, class Level>
Components CellSpace<Operators, Level>::ComponentsOf(std::size_t level, const Job& job) const
{
  if (level == 0)
  {
    return this->FinestComponents();
  }
  Components components;
  components.ofFunction = FunctionComponents(this->Levels().at(level), job.threads);
  components.count = NumberOfComponents(components.ofFunction);
  return components;
}

template<class Operators, class Level>
double CellSpace<Operators, Level>::UnitLength() const
{
  return grid_->GetGrid().spacing;
}

template<class Operators, class Level>
Vec3 CellSpace<Operators, Level>::Origin() const
{
  return grid_->GetGrid().origin;
}

template<class Operators, class Level>
double CellSpace<Operators, Level>::Extent() const
{
  return grid_->GetGrid().CellsPerSide();
}

template<class Operators, class Level>
const QuadratureRule& CellSpace<Operators, Level>::Rule() const
{
  return TriangleRule(operators_->quadratureDegree);
}

template<class Operators, class Level>
MultiVector CellSpace<Operators, Level>::LoadOfValues(const Field& f, const Job& job) const
{
  return IntegrateValues(
    *grid_, this->Finest(), *mesh_, f, this->Rule(), job, metric_ ? &metric_->area : nullptr);
}

template<class Operators, class Level>
MultiVector CellSpace<Operators, Level>::LoadOfWeightedValues(
  const Field& f, const std::vector<double>& weight, const Job& job) const
{
  RequireWeights(weight, *mesh_);
  const std::vector<double> all = metric_ ? ProductOf(weight, metric_->area) : weight;
  return IntegrateValues(*grid_, this->Finest(), *mesh_, f, this->Rule(), job, &all);
}

template<class Operators, class Level>
MultiVector CellSpace<Operators, Level>::LoadOfGradients(
  const Field& s, const Field* scale, const Job& job) const
{
  return IntegrateGradients(*grid_, this->Finest(), *mesh_,
    metric_ ? metric_->Transform(*mesh_, s) : s, scale, this->Rule(), job);
}

template<class Operators, class Level>
MultiVector CellSpace<Operators, Level>::LoadOfTurnedGradients(const Field& s, const Job& job) const
{
  return IntegrateTurnedGradients(*grid_, this->Finest(), *mesh_, s, this->Rule(), job);
}

template<class Operators, class Level>
MultiVector CellSpace<Operators, Level>::LoadOfDirections(
  const MultiVector& coefficients, const Field* scale, const Job& job) const
{
  return IntegrateDirections(
    *grid_, this->Finest(), *mesh_, coefficients, scale, this->Rule(), job);
}

template<class Operators, class Level>
MultiVector CellSpace<Operators, Level>::LoadOfGradientsOf(
  const Field& f, const Field* scale, const Job& job) const
{
  return metric_
           ? this->LoadOfGradients(GradientsOf(*mesh_, f), scale, job)
           : IntegrateGradientsOf(*grid_, this->Finest(), *mesh_, f, scale, this->Rule(), job);
}

template<class Operators, class Level>
MultiVector CellSpace<Operators, Level>::LoadOfGradientsOfCoordinates(
  const Field* scale, const Job& job) const
{
  if (metric_)
  {
    return scale ? this->LoadOfGradientsOf(CoordinatesOf(*mesh_), scale, job)
                 : this->StiffnessTimes(this->UnitLength() * this->EmbeddingOfMesh(job), {}, job);
  }
  return IntegrateGradientsOfCoordinates(
    *grid_, this->Finest(), *mesh_, scale, this->Rule(), operators_->normalStabilization, job);
}

template<class Operators, class Level>
MultiVector CellSpace<Operators, Level>::ValuesAtPoints(
  const MultiVector& coefficients, const Job& job) const
{
  return EvaluateAtPoints(*grid_, this->Finest(), coefficients, job);
}

template<class Operators, class Level>
MultiVector CellSpace<Operators, Level>::GradientsOnTriangles(
  const MultiVector& coefficients, const Job& job) const
{
  return MeanGradients(
    *grid_, this->Finest(), static_cast<Id>(mesh_->triangles.size()), coefficients, job);
}

template<class Operators, class Level>
SparseMatrix CellSpace<Operators, Level>::RowsAtPoints(const std::vector<Id>& points) const
{
  return EvaluationRows(*grid_, this->Finest(), points);
}

template<class Operators, class Level>
EdgeSamples CellSpace<Operators, Level>::SamplesOfSegments(
  const std::vector<TriangleSegment>& segments) const
{
  return SampleSegments(*grid_, this->Finest(), *mesh_, segments);
}

template<class Operators, class Level>
SampledFunctions CellSpace<Operators, Level>::Samples(const Job& job) const
{
  return SampleFunctions(
    *grid_, this->Finest(), this->Rule(), job, metric_ ? &metric_->area : nullptr);
}

template<class Operators, class Level>
std::vector<char> CellSpace<Operators, Level>::PointsWithFunctions() const
{
  std::vector<char> has(grid_->pointPatch.size());
  std::transform(grid_->pointPatch.begin(), grid_->pointPatch.end(), has.begin(),
    [](Index patch) { return patch >= 0; });
  return has;
}

template<class Operators, class Level>
void CellSpace<Operators, Level>::SetMetricOnTriangles(
  std::shared_ptr<const TriangleMetric> metric, const Job& job)
{
  RequireMetric(*metric, *mesh_);
  metric_ = std::move(metric);
  this->IntegrateTriangles(metric_->area, job);
}

template<class Operators, class Level>
void CellSpace<Operators, Level>::WeighMass(const std::vector<double>& weight, const Job& job)
{
  RequireWeights(weight, *mesh_);
  this->IntegrateTriangles(metric_ ? ProductOf(weight, metric_->area) : weight, job);
}

template class CellSpace<LevelOperators, PatchLevel>;
template class CellSpace<SmoothOperators, SmoothLevel>;

} // namespace gridfem
