// Groups what belongs to the corners of triangles, with coincident points as one.
#ifndef GridFEM_CornerClasses_h
#define GridFEM_CornerClasses_h

#include "Grid/TriangleMesh.h"

#include <algorithm>
#include <array>
#include <vector>

namespace gridfem
{

/// The welded points of triangles. Without welding they are the points themselves.
class CornerClasses
{
public:
  /// @param ofPoint  welded id of each point; empty: every point is its own class
  CornerClasses(const TriangleMesh& mesh, const Array<Index>& ofPoint)
    : mesh_(mesh), ofPoint_(ofPoint)
  {
  }

  std::array<Id, 3> operator()(Id triangle) const
  {
    std::array<Id, 3> corners = mesh_.triangles[triangle];
    for (Id& corner : corners)
    {
      corner = ofPoint_.empty() ? corner : ofPoint_[corner];
    }
    return corners;
  }

private:
  const TriangleMesh& mesh_;
  const Array<Index>& ofPoint_;
};

/// Lists of things by a number each, all in one array. Things keep their order.
template<class Thing>
struct Buckets
{
  std::vector<Id> begin;
  std::vector<Thing> things;

  /// Calls visit(add) twice, the first time to count. `add` takes a bucket and a thing.
  template<class Visit>
  Buckets(std::size_t count, Visit&& visit) : begin(count + 1, 0)
  {
    visit([&](Id bucket, const Thing&) { ++begin[bucket + 1]; });
    for (std::size_t k = 0; k < count; ++k)
    {
      begin[k + 1] += begin[k];
    }
    things.resize(begin.back());
    std::vector<Id> next(begin.begin(), begin.end() - 1);
    visit([&](Id bucket, const Thing& thing) { things[next[bucket]++] = thing; });
  }

  /// Whether a bucket has two equal things.
  bool HasEqual() const
  {
    for (std::size_t k = 0; k + 1 < begin.size(); ++k)
    {
      for (Id i = begin[k]; i < begin[k + 1]; ++i)
      {
        if (std::find(things.begin() + begin[k], things.begin() + i, things[i]) !=
            things.begin() + i)
        {
          return true;
        }
      }
    }
    return false;
  }
};

inline bool IsDegenerate(const std::array<Id, 3>& corners)
{
  return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
}

} // namespace gridfem

#endif
