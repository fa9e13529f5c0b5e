// Ways around a place through the triangles that meet there.
#ifndef GridFEM_StarRoute_h
#define GridFEM_StarRoute_h

#include "Distance/PathGraph.h"

#include <array>
#include <limits>
#include <vector>

namespace gridfem
{

/// A direction at a place. It lies in a triangle, between two edges that meet there.
struct StarDirection
{
  struct Spoke
  {
    Index edge;
    double angle; // between the edge and the direction, radians
  };

  Index triangle;
  std::array<Spoke, 2> spokes;
};

/// A way from one triangle to another around their common place.
struct StarRoute
{
  double angle = std::numeric_limits<double>::infinity(); // infinite: there is no way
  std::vector<Index> triangles;                           // between the two triangles
  std::vector<Index> edges; // that are crossed; one more than triangles
};

/// The direction at a place along one of its edges, or within a triangle toward a point of the
/// opposite edge.
/// @param point  in space
StarDirection DirectionToward(
  const PathGraph& graph, Index triangle, Index place, const Vec3& point);

/// Finds the way between two directions with the smallest angle. A way never crosses the triangles
/// of the directions themselves. Edges may have any number of triangles. It finds nothing if both
/// directions are in one triangle.
/// @param below  ways with a larger angle are not of interest
StarRoute RouteAround(const PathGraph& graph, Index place, const StarDirection& from,
  const StarDirection& to, double below = std::numeric_limits<double>::infinity());

} // namespace gridfem

#endif
