// Divides a surface into charts: pieces that can be flattened, because they are disks.
#ifndef GridFEM_OpenedSurface_h
#define GridFEM_OpenedSurface_h

#include "Base/Job.h"
#include "Grid/TriangleMesh.h"
#include "Shape/ConnectedTriangles.h"

#include <array>
#include <vector>

namespace gridfem
{

/// What a connected component of the surface is like.
struct Topology
{
  Id euler = 0; // vertices - edges + triangles
  Id loops = 0; // of the boundary

  /// The number of handles.
  Id Genus() const { return (2 - loops - euler) / 2; }
};

/// A part of a surface that is a disk. Its boundary is one loop.
struct Disk
{
  std::vector<Vec3> points;                    // of vertices, world units
  std::vector<std::array<Index, 3>> triangles; // vertices; all face the same way
  std::vector<Index> loop;                     // vertices of the boundary, in order
  std::vector<Id> pointOf;                     // point of the mesh; -1: middle of a filled hole
  std::vector<Id> triangleOf;                  // triangle of the mesh; -1: of a filled hole
  std::vector<char> isTurned;                  // the triangle faces against the mesh's
  Topology topology;                           // before holes were filled and cuts were made

  Index NumberOfVertices() const { return static_cast<Index>(points.size()); }
};

struct OpeningOptions
{
  /// Loops of the boundary up to this fraction of the longest loop are holes, also up to this
  /// fraction of a tenth of the circle around the area. They are filled. Cuts connect longer ones.
  double holeSize = 0.5;
  /// Cuts that lead to the points farthest from all cuts. A surface that is nearly closed has at
  /// least eight: its loops and other cuts are short for its area.
  int extraCuts = 0;
  bool weldCoincidentPoints = true;
};

/// Divides a surface into disks, one per connected component. Triangles with two equal corners, and
/// triangles with the corners of an earlier one, are left out. Surfaces with one side are cut where
/// triangles face against each other. Handles are cut along shortest loops of edges (Erickson and
/// Whittlesey 2005), which run to the boundary along shortest paths of edges. Same result for any
/// number of threads. Throws InvalidInput if no triangle has three different corners, and Aborted.
std::vector<Disk> OpenToDisks(
  const TriangleMesh& mesh, const OpeningOptions& options, const Job& job = {});

} // namespace gridfem

#endif
