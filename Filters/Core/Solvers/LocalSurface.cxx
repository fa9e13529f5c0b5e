#include "Solvers/LocalSurface.h"

#include "Integrals/QuadratureRule.h"

#include <utility>

namespace gridfem
{

LocalSurface::LocalSurface(
  Stages& stages, std::shared_ptr<const TriangleMesh> mesh, const SurfaceOptions& options)
  : Surface(stages), used_(options), mesh_(std::move(mesh)), asked_(options)
{
}

void LocalSurface::Prepare(const Progress& progress)
{
  this->Build(asked_, progress);
}

void LocalSurface::PrepareAtDepth(int depth, const Progress& progress)
{
  SurfaceOptions asked = asked_;
  asked.space.depth = depth;
  asked.functionsPerPoint = AsManyAsWanted;
  this->Build(asked, progress);
}

void LocalSurface::PrepareMesh(const Progress& /*progress*/)
{
  this->GetStages().Run(MeshStage, StageKey(), [&] { RequireSurface(*mesh_); });
}

void LocalSurface::Build(const SurfaceOptions& asked, const Progress& progress)
{
  StageKey key;
  key.Add(asked.space.depth).Add(asked.functionsPerPoint);
  this->GetStages().Run(SpaceStage, key,
    [&]
    {
      TriangleRule(asked.choice.quadratureDegree); // refuses a wrong degree before the long work
      RequireSurface(*mesh_);
      this->FreeBasis(); // frees its memory first
      this->BuildBasis(mesh_, asked, progress.Part(0.0, 0.6));
    });
  this->UpdateSpace({}, progress.Part(0.6, 1.0));
}

void LocalSurface::BuildBasis(const std::shared_ptr<const TriangleMesh>& mesh,
  const SurfaceOptions& asked, const Progress& progress)
{
  used_ = asked;
  used_.space.depth =
    ChooseDepth(*mesh, asked.space.depth, asked.choice.kind, asked.functionsPerPoint);
  RequireMemory(*mesh, used_.space.depth, asked.choice.kind);
  basis_ = MakeSurfaceBasis(
    mesh, BuildGridFunctions(*mesh, used_.space, progress), asked.space.weldCoincidentPoints);
}

void LocalSurface::UpdateSpace(const GivenMetric& metric, const Progress& progress)
{
  Stages& stages = this->GetStages();
  const SpaceChoice& choice = used_.choice;
  StageKey key;
  key.Add(stages.Version(SpaceStage)).Add(choice.quadratureDegree).Add(choice.coarsestSize);
  key.Add(choice.normalStabilization).Add(choice.kind).Add(metric.structure);
  if (key != structureKey_)
  {
    structureKey_ = key;
    ++structure_;
  }
  key.Add(metric.numbers);
  if (stages.IsCurrent(SystemStage, key))
  {
    return;
  }
  metric_ = nullptr;
  space_ = metric.make ? nullptr : FindSpace(basis_, choice);
  if (space_)
  {
    stages.Adopt(SystemStage, key);
    return;
  }
  stages.Run(SystemStage, key,
    [&]
    {
      metric_ = metric.make ? metric.make() : nullptr;
      space_ = MakeSpace(basis_, choice, this->MakeJob(progress.Part(0.0, 0.6)));
      if (metric_)
      {
        std::shared_ptr<FiniteElementSpace> own = space_->Copy();
        own->SetMetricOnTriangles(metric_, this->MakeJob(progress.Part(0.6, 1.0)));
        space_ = own;
      }
    });
}

void LocalSurface::FreeBasis()
{
  basis_ = {};
  space_ = nullptr;
}

double LocalSurface::Area() const
{
  return metric_ ? metric_->AreaOf(this->Mesh()) : SurfaceArea(this->Mesh());
}

double LocalSurface::LongestSide() const
{
  const Grid& grid = basis_.space->GetGrid();
  return grid.spacing * grid.CellsPerSide();
}

HeldValues LocalSurface::Hold(const std::vector<Id>& points, const MultiVector& values) const
{
  RequireFirstDegree(used_.choice.kind, "Values that are held at points");
  return HoldPointsAndEdges(*space_, this->Mesh(), basis_.weldCoincidentPoints, points, values);
}

BoundaryTerms LocalSurface::OnBoundary(const MultiVector* flux, const MultiVector* values) const
{
  if (values)
  {
    RequireFirstDegree(used_.choice.kind, "Values that are held on the boundary");
  }
  return TermsOnBoundary(*space_, this->Mesh(), basis_.weldCoincidentPoints, flux, values);
}

EdgeSamples LocalSurface::SampleBoundary(bool ofNested) const
{
  return gridfem::SampleBoundary(
    ofNested ? *space_->NestedLevels() : *space_, this->Mesh(), basis_.weldCoincidentPoints);
}

std::vector<char> LocalSurface::PointsWithFunctions() const
{
  return space_->PointsWithFunctions();
}

} // namespace gridfem
