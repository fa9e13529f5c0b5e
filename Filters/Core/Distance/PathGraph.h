// The places, edges and triangles of a surface, for paths along it.
#ifndef GridFEM_PathGraph_h
#define GridFEM_PathGraph_h

#include "Base/Grouping.h"
#include "Distance/EdgeGraph.h"
#include "Grid/TriangleMesh.h"

#include <array>
#include <memory>

namespace gridfem
{

/// Tells which triangles meet at places and edges. A place is the lowest id of points that count as
/// one. Triangles with two corners in one place take no part. Edges may have any number of
/// triangles.
class PathGraph
{
public:
  PathGraph(std::shared_ptr<const TriangleMesh> mesh, bool weldCoincidentPoints, int threads = 0);

  const TriangleMesh& Mesh() const { return *mesh_; }
  const EdgeGraph& Edges() const { return edges_; }
  Id NumberOfPlaces() const { return static_cast<Id>(place_.size()); }
  Index PlaceOf(Id point) const { return place_[point]; }
  const Vec3& At(Index place) const { return mesh_->points[place]; }

  /// The places at the corners of a triangle.
  std::array<Index, 3> CornersOf(Index triangle) const;

  /// The corner of a triangle that is not on one of its edges.
  Index ApexOf(Index triangle, Index edge) const;

  /// The edge of a triangle between two of its corners.
  Index EdgeOf(Index triangle, Index a, Index b) const;

  /// The angle of a triangle at one of its corners, radians.
  double AngleAt(Index triangle, Index place) const;

  /// Calls body(triangle) for every triangle at a place.
  template<class Body>
  void ForTrianglesAt(Index place, Body&& body) const
  {
    for (Index k = corners_.begin[place]; k < corners_.begin[place + 1]; ++k)
    {
      const Index triangle = corners_.item[k] / 3;
      if (edges_.EdgesOf(triangle)[0] != EdgeGraph::None)
      {
        body(triangle);
      }
    }
  }

private:
  std::shared_ptr<const TriangleMesh> mesh_;
  Array<Index> place_; // per point
  EdgeGraph edges_;
  Groups corners_; // of triangles, by place: three per triangle
};

} // namespace gridfem

#endif
