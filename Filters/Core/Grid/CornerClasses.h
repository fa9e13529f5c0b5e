// The corners of triangles, with coincident points as one.
#ifndef GridFEM_CornerClasses_h
#define GridFEM_CornerClasses_h

#include "Grid/TriangleMesh.h"

#include <array>

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

  std::array<Index, 3> operator()(Id triangle) const
  {
    std::array<Index, 3> corners;
    for (int k = 0; k < 3; ++k)
    {
      const Id own = mesh_.triangles[triangle][k];
      corners[k] = ofPoint_.empty() ? static_cast<Index>(own) : ofPoint_[own];
    }
    return corners;
  }

private:
  const TriangleMesh& mesh_;
  const Array<Index>& ofPoint_;
};

/// Whether two corners are the same.
inline bool IsDegenerate(const std::array<Index, 3>& corners)
{
  return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
}

} // namespace gridfem

#endif
