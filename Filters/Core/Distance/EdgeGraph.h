// The edges of a mesh between places, and the triangles on them.
#ifndef GridFEM_EdgeGraph_h
#define GridFEM_EdgeGraph_h

#include "Grid/TriangleSides.h"

#include <algorithm>
#include <array>
#include <vector>

namespace gridfem
{

/// Edges of the mesh between places, and the triangles on them.
class EdgeGraph
{
public:
  static constexpr Index None = -1;

  EdgeGraph(const TriangleMesh& mesh, const Array<Index>& place)
    : sides_(SortedSides(mesh, place)), edgeOf_(mesh.triangles.size(), { None, None, None })
  {
    ForEachEdge(sides_,
      [&](const TriangleSide* side, Id count)
      {
        for (Id k = 0; k < count; ++k)
        {
          edgeOf_[side[k].edge.triangle][side[k].edge.corner] = static_cast<Index>(begin_.size());
        }
        begin_.push_back(static_cast<Index>(side - sides_.data()));
      });
    begin_.push_back(static_cast<Index>(sides_.size()));
  }

  Index Count() const { return static_cast<Index>(begin_.size()) - 1; }

  /// The edges of a triangle, from each corner to the next. An edge with equal ends is None.
  const std::array<Index, 3>& EdgesOf(Id triangle) const { return edgeOf_[triangle]; }

  Index Low(Index edge) const { return sides_[begin_[edge]].low; }
  Index High(Index edge) const { return sides_[begin_[edge]].high; }
  bool IsBorder(Index edge) const { return begin_[edge + 1] - begin_[edge] == 1; }

  /// Total number of sides of all edges.
  Index NumberOfSides() const { return static_cast<Index>(sides_.size()); }

  /// Calls body(side, triangle) for every side of an edge.
  template<class Body>
  void ForSides(Index edge, Body&& body) const
  {
    for (Index side = begin_[edge]; side < begin_[edge + 1]; ++side)
    {
      body(side, sides_[side].edge.triangle);
    }
  }

  /// The edge that two triangles share; None if they share none.
  Index EdgeBetween(Id a, Id b) const
  {
    for (const Index edge : edgeOf_[a])
    {
      if (edge != None && std::count(edgeOf_[b].begin(), edgeOf_[b].end(), edge) > 0)
      {
        return edge;
      }
    }
    return None;
  }

private:
  std::vector<TriangleSide> sides_;
  std::vector<std::array<Index, 3>> edgeOf_;
  std::vector<Index> begin_; // first side of each edge
};

} // namespace gridfem

#endif
