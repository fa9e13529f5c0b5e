// Turns the triangles of a mesh so that all triangles of a component face the same way, and leaves
// out copies.
#ifndef GridFEM_OrientedMesh_h
#define GridFEM_OrientedMesh_h

#include "Grid/TriangleMesh.h"

#include <array>
#include <optional>
#include <vector>

namespace gridfem
{

/// A mesh for normals and volumes. Its points are those of the given mesh.
struct OrientedMesh
{
  std::optional<TriangleMesh> mesh; // none if the given one is oriented already
  Id turned = 0;                    // triangles that now face the other way
  Id copies = 0;                    // triangles left out: others have the same corners
  /// For each point, a point at its place with a triangle, if its own triangles were left out; else
  /// itself. Empty without copies.
  std::vector<Id> pointWithTriangle;
  Index oneSided = 0; // components that cannot be oriented, such as a Möbius strip

  /// The triangles for normals and volumes.
  /// @param given  the given mesh
  const std::vector<std::array<Id, 3>>& TrianglesOf(const TriangleMesh& given) const
  {
    return mesh ? mesh->triangles : given.triangles;
  }

  Id PointWithTriangle(Id point) const
  {
    return pointWithTriangle.empty() ? point : pointWithTriangle[point];
  }
};

/// Orients a mesh. A component stays as it is if all its triangles already face the same way.
/// Otherwise, a closed component gets the orientation that makes its volume positive. An open
/// component gets the orientation of most of its area. Cost O(n) for an oriented mesh, otherwise
/// O(n log n). Same result for any number of threads.
/// @param weldCoincidentPoints  coincident points count as one
OrientedMesh Orient(const TriangleMesh& mesh, bool weldCoincidentPoints, int threads = 0);

} // namespace gridfem

#endif
