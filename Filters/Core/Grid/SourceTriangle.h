// A source triangle as its pieces see it: barycentric coordinates of the points of the clipped
// mesh.
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

  /// Barycentric coordinates of a point of the clipped mesh that lies on the triangle: exactly
  /// those the point was made with. A cut point of an edge may have been made from another triangle
  /// at that edge; a point whose origin is not known is located by its position.
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
