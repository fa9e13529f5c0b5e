#include "IntrinsicHeat.h"

#include "CgalSurface.h"

#include <CGAL/Heat_method_3/Surface_mesh_geodesic_distances_3.h>

#include <optional>

namespace gridfem::benchmarks
{

using HeatMethod = CGAL::Heat_method_3::Surface_mesh_geodesic_distances_3<CgalSurface,
  CGAL::Heat_method_3::Intrinsic_Delaunay>;

struct IntrinsicHeat::Implementation
{
  CgalSurface surface;
  std::vector<CgalSurface::Vertex_index> vertex;
  CgalSurface::Property_map<CgalSurface::Vertex_index, double> distance;
  std::optional<HeatMethod> method;
};

IntrinsicHeat::IntrinsicHeat(const TriangleMesh& mesh)
  : implementation_(std::make_unique<Implementation>())
{
  Implementation& own = *implementation_;
  own.vertex = FillSurface(mesh, own.surface);
  own.distance =
    own.surface.add_property_map<CgalSurface::Vertex_index, double>("v:distance", 0.0).first;
  if (this->IsManifold())
  {
    own.method.emplace(own.surface);
  }
}

IntrinsicHeat::~IntrinsicHeat() = default;

bool IntrinsicHeat::IsManifold() const
{
  return !implementation_->vertex.empty();
}

std::vector<double> IntrinsicHeat::From(Id source)
{
  Implementation& own = *implementation_;
  own.method->add_source(own.vertex.at(source));
  own.method->estimate_geodesic_distances(own.distance);
  own.method->clear_sources();
  std::vector<double> distance;
  for (const auto vertex : own.vertex)
  {
    distance.push_back(own.distance[vertex]);
  }
  return distance;
}

} // namespace gridfem::benchmarks
