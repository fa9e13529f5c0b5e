// Barycentric coordinates of the points of a clipped mesh on their source triangle.
#ifndef GridFEM_SourceTriangle_h
#define GridFEM_SourceTriangle_h

#include "Grid/Clip.h"

namespace gridfem
{

using Barycentric = std::array<double, 3>;

class SourceTriangle
{
public:
  /// Keeps references to both meshes. The clipped mesh must come from `mesh`.
  SourceTriangle(const ClippedMesh& clipped, const TriangleMesh& mesh, Id triangle);

  /// Returns the barycentric coordinates of a point of the clipped mesh on this triangle, exactly
  /// as the clip made them. The point may have been made from another triangle at the same edge. A
  /// point of unknown origin is located by its position.
  Barycentric Locate(Id point) const;

private:
  int CornerAt(Id inputPoint) const;
  Barycentric LocateByPosition(Id point) const;
  Vec3 AreaVector() const;

  const ClippedMesh& clipped_;
  const TriangleMesh& mesh_;
  Id triangle_;
  const std::array<Id, 3>& points_;
};

} // namespace gridfem

#endif
