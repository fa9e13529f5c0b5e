#include "Held.h"

#include "Base/Errors.h"
#include "Grid/SurfaceEdges.h"

namespace gridfem
{

void RequirePointValues(const std::string& who, const GivenArray* values)
{
  if (values && !values->isOnPoints)
  {
    throw InvalidInput(who + " needs values at points, but 'values' is a cell array.");
  }
}

void CheckHeld(const Given& given, bool holdsBoundary)
{
  const GivenArray* held = given.Find("held");
  if (held && (!held->isOnPoints || held->values.cols() != 1))
  {
    throw InvalidInput("MaskArray 'held' must be a point array with one component.");
  }
  if (held || holdsBoundary)
  {
    RequirePointValues(held ? "ConstraintArray" : "BoundaryValues", given.Find("values"));
  }
}

HeldValues FindHeld(const Given& given, const EngineSurface& surface, const EngineOptions& options,
  const Field& value, bool holdsBoundary, Results& results)
{
  const TriangleMesh& mesh = surface.Mesh();
  KnownRows known;
  known.values.resize(0, value.values.cols());
  if (const GivenArray* mask = given.Find("held"))
  {
    known = given.KnownValues(mask);
  }
  HeldValues held = HoldPoints(surface.Space(), known.points, std::move(known.values));
  if (!holdsBoundary)
  {
    return held;
  }
  const std::vector<TriangleEdge> edges =
    FindSurfaceEdges(mesh, options.functions.weldCoincidentPoints).boundary;
  if (edges.empty())
  {
    results.Warn("The surface has no boundary for BoundaryValues.");
    return held;
  }
  return Join(held, HoldEdges(surface.Space(), mesh, edges, value.values));
}

} // namespace gridfem
