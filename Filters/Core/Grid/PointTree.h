// A tree of boxes that finds the points near a segment.
#ifndef GridFEM_PointTree_h
#define GridFEM_PointTree_h

#include "Base/Types.h"

#include <vector>

namespace gridfem
{

class PointTree
{
public:
  /// @param points  finite; must outlive the tree
  explicit PointTree(const std::vector<Vec3>& points);

  /// Calls visit(point) with every point whose distance from the segment is at most `distance`, and
  /// with some others.
  template<class Visit>
  void ForEachNear(const Vec3& from, const Vec3& to, double distance, Visit&& visit) const
  {
    for (std::size_t node = 0; node < nodes_.size();)
    {
      const Node& box = nodes_[node];
      if (!Touches(box, from, to, distance))
      {
        node = box.next;
        continue;
      }
      for (Index k = box.begin; k < box.end; ++k)
      {
        visit(points_[k]);
      }
      ++node;
    }
  }

private:
  /// A box around points. Nodes below it follow it, and `next` is the first node that is not below.
  struct Node
  {
    Vec3 low;
    Vec3 high;
    std::size_t next;
    Index begin; // into points_; the range is empty unless the node is a leaf
    Index end;
  };

  static bool Touches(const Node& box, const Vec3& from, const Vec3& to, double distance);
  void Build(const std::vector<Vec3>& points, Index begin, Index end);

  std::vector<Index> points_;
  std::vector<Node> nodes_;
};

} // namespace gridfem

#endif
