// Straight segments in space, and a tree of boxes that finds those near a place. A single point is
// a segment with equal ends.
#ifndef GridFEM_SegmentTree_h
#define GridFEM_SegmentTree_h

#include "Base/Types.h"

#include <array>
#include <cstddef>
#include <vector>

namespace gridfem
{

/// The two ends of a straight line.
using Segment = std::array<Vec3, 2>;

double DistanceFromSegment(const Segment& segment, const Vec3& place);

/// A query visits the few boxes that are near enough.
class SegmentTree
{
public:
  /// Cost O(n log n).
  /// @param segments  finite
  explicit SegmentTree(std::vector<Segment> segments);

  /// A tree of points.
  explicit SegmentTree(const std::vector<Vec3>& points);

  /// The distance from the nearest segment; infinite if there is none.
  double DistanceFrom(const Vec3& place) const;

  /// Calls visit(index) with every segment whose box has a point within `distance` of a line, and
  /// with some others. Indices count in the order that was given.
  template<class Visit>
  void ForEachNear(const Segment& line, double distance, Visit&& visit) const
  {
    for (std::size_t number = 0; number < boxes_.size();)
    {
      const Box& box = boxes_[number];
      if (!Touches(box, line, distance))
      {
        number = box.next;
        continue;
      }
      for (Index k = box.begin; box.isLeaf && k < box.end; ++k)
      {
        visit(order_[k]);
      }
      ++number;
    }
  }

private:
  /// A box around some segments. The boxes of its two halves follow it, each with its own halves
  /// behind it. `next` is the first box that is not below this one.
  struct Box
  {
    Vec3 low;
    Vec3 high;
    Index begin;
    Index end;
    std::size_t next;
    bool isLeaf;
  };

  static bool Touches(const Box& box, const Segment& line, double distance);
  void Build(Index begin, Index end);

  std::vector<Segment> segments_;
  std::vector<Index> order_; // of the segments in the boxes
  std::vector<Box> boxes_;
};

} // namespace gridfem

#endif
