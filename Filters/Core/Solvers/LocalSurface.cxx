#include "Solvers/LocalSurface.h"

#include "Integrals/QuadratureRule.h"

#include <utility>

namespace gridfem
{

LocalSurface::LocalSurface(
  Stages& stages, std::shared_ptr<const TriangleMesh> mesh, SurfaceOptions options)
  : Surface(stages), mesh_(std::move(mesh)), asked_(options), used_(options)
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
  Stages& stages = this->GetStages();
  stages.Run(SpaceStage, key,
    [&]
    {
      space_ = nullptr;                            // frees its memory first
      TriangleRule(asked.choice.quadratureDegree); // refuses a wrong degree before the long work
      RequireSurface(*mesh_);
      used_ = asked;
      used_.space.depth =
        ChooseDepth(*mesh_, asked.space.depth, asked.choice.kind, asked.functionsPerPoint);
      RequireMemory(*mesh_, used_.space.depth, used_.choice.kind);
      space_ = BuildSpace(*mesh_, used_.space, used_.choice, progress);
      ++structure_;
    });
  key = {};
  key.Add(stages.Version(SpaceStage));
  stages.Run(SystemStage, key, [] {}); // made with the space
}

double LocalSurface::Area() const
{
  return SurfaceArea(*mesh_);
}

double LocalSurface::LongestSide() const
{
  return space_->UnitLength() * space_->Extent();
}

HeldValues LocalSurface::Hold(const std::vector<Id>& points, const MultiVector& values) const
{
  return HoldPointsAndEdges(*space_, *mesh_, used_.space.weldCoincidentPoints, points, values);
}

BoundaryTerms LocalSurface::OnBoundary(const MultiVector* flux, const MultiVector* values) const
{
  return TermsOnBoundary(*space_, *mesh_, used_.space.weldCoincidentPoints, flux, values);
}

std::vector<char> LocalSurface::PointsWithFunctions() const
{
  return space_->PointsWithFunctions();
}

} // namespace gridfem
